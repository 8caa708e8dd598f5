//! Slip along a line at even times: the slip contours of an earthquake cycle.

use stickslip::ContactView;

use crate::plot::{DARK, PALE, Panel, Points};

/// Slip of the cells on a line, at even times between events and in events.
pub(super) struct Profiles {
    /// The cells and their positions \[km or m\].
    line: Vec<(usize, f64)>,
    /// The intervals \[s\] between events and in events.
    intervals: [f64; 2],
    profiles: Vec<Profile>,
    next: f64,
}

struct Profile {
    seismic: bool,
    slip: Vec<f64>,
}

impl Profiles {
    pub(super) fn new(line: Vec<(usize, f64)>, intervals: [f64; 2]) -> Self {
        Self {
            line,
            intervals,
            profiles: Vec::new(),
            next: 0.0,
        }
    }

    /// Records a step, in an event or not.
    pub(super) fn record<const C: usize>(
        &mut self,
        time: f64,
        seismic: bool,
        contact: &ContactView<'_, C>,
    ) {
        let begins = seismic && self.profiles.last().is_some_and(|last| !last.seismic);
        if time >= self.next || begins {
            self.next = time + self.intervals[usize::from(seismic)];
            let slip = self.line.iter().map(|&(cell, _)| contact.slip(cell));
            let slip = slip.collect();
            self.profiles.push(Profile { seismic, slip });
        }
    }

    /// Adds the contours to a panel, each a curve of its points: position and slip in the order of the axes.
    pub(super) fn draw<'a>(
        &self,
        mut panel: Panel<'a>,
        labels: [&'a str; 2],
        point: impl Fn(f64, f64) -> Option<(f64, f64)>,
    ) -> Panel<'a> {
        for (seismic, label, color) in [(false, labels[0], DARK), (true, labels[1], PALE)] {
            let profiles = self.profiles.iter();
            let profiles = profiles.filter(|profile| profile.seismic == seismic);
            for (n, profile) in profiles.enumerate() {
                let pairs = self.line.iter().zip(&profile.slip);
                let curve: Points = pairs
                    .filter_map(|(&(_, x), &slip)| point(x, slip))
                    .collect();
                panel = panel.with(if n == 0 { label } else { "" }, color, 2, curve);
            }
        }
        panel
    }
}

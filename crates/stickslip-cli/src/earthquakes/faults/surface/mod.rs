//! Pictures of a surface of triangles: slip rates in space and unrolled, and the slip of events.

mod contours;
mod frames;
mod unrolled;
mod view;

use std::path::Path;

use stickslip::Snapshot;
use stickslip::bie::Triangles;

use super::super::{Failed, YEAR};
use crate::plot::{self, Colors, PatchSheet, Patches, Points};
use frames::{EventSlip, Frame, Frames};
use view::View;

/// The colours of slip rates [m/s].
const RATES: Colors = Colors {
    range: (1e-12, 1.0),
    logarithmic: true,
};
/// The numbers of frames and of events in the pictures.
const SHOTS: usize = 4;
const EVENTS: usize = 6;
const AXES: [&str; 2] = ["along strike [km]", "down dip [km]"];

/// The record of a surface for its pictures.
pub(super) struct SurfaceRecord<'a> {
    cells: &'a Triangles,
    frames: Frames,
    /// The slip rates of the last step [m/s].
    rates: Vec<f64>,
}

impl<'a> SurfaceRecord<'a> {
    /// Of events from a slip rate on [m/s].
    pub(super) fn new(cells: &'a Triangles, threshold: f64) -> Self {
        Self {
            cells,
            frames: Frames::new(threshold, cells.count()),
            rates: Vec::new(),
        }
    }

    pub(super) fn see(&mut self, at: &Snapshot<'_, 1>) {
        let contact = at.contact(0);
        self.frames.record(at.time, &contact);
        self.rates.clear();
        self.rates
            .extend((0..contact.len()).map(|k| contact.slip_rate(k)));
    }

    /// Draws slip rates in the course of the largest event, or of the last step, and the slip of the largest events.
    pub(super) fn draw(self, rates: &Path, slip: &Path) -> Result<(), Failed> {
        let places = unrolled::unrolled(self.cells);
        let (events, frames) = self.frames.finish();
        let shots: Vec<(String, Vec<f64>)> = match frames {
            Some((time, frames)) => chosen(frames)
                .into_iter()
                .map(|(after, rates)| (told(time, after), rates))
                .collect(),
            None => vec![("at the end".to_owned(), self.rates)],
        };
        draw_rates(rates, self.cells, &places, shots)?;
        draw_slip(slip, self.cells, &places, events)
    }
}

/// The title of a frame, by the time of its event and the time since \[s\].
fn told(time: f64, after: f64) -> String {
    let (years, digits) = (time / YEAR, if after < 10.0 { 2 } else { 0 });
    format!("{after:.digits$} s into the event at {years:.2} years")
}

/// Frames from the first to the last one, evenly.
fn chosen(mut frames: Vec<Frame>) -> Vec<Frame> {
    let count = frames.len();
    let wanted: Vec<usize> = (0..SHOTS)
        .map(|n| n * count.saturating_sub(1) / (SHOTS - 1))
        .collect();
    let mut place = 0..;
    frames.retain(|_| place.next().is_some_and(|place| wanted.contains(&place)));
    frames
}

/// Slip rates in space, and unrolled beside it.
fn draw_rates(
    path: &Path,
    cells: &Triangles,
    places: &[[[f64; 2]; 3]],
    shots: Vec<(String, Vec<f64>)>,
) -> Result<(), Failed> {
    let view = View::new(cells);
    let rows = shots.into_iter().map(|(title, rates)| {
        let in_space = Patches {
            title,
            triangles: &view.corners,
            values: view.order.iter().map(|&cell| rates[cell]).collect(),
            behind: view.frame.iter().map(|edge| (1, edge.clone())).collect(),
            above: Vec::new(),
            texts: view.texts.clone(),
            names: None,
        };
        let flat = on_plane("unrolled".to_owned(), places, rates, Vec::new());
        [Some(in_space), Some(flat)]
    });
    let sheet = PatchSheet {
        name: "slip rate [m/s]",
        colors: RATES,
        rows: rows.collect(),
    };
    plot::draw(path, &sheet)
}

/// The slip of the events with the largest mean slip, in their order, with contours.
fn draw_slip(
    path: &Path,
    cells: &Triangles,
    places: &[[[f64; 2]; 3]],
    events: Vec<EventSlip>,
) -> Result<(), Failed> {
    let size = |event: &EventSlip| event.slip.iter().sum::<f64>();
    let mut sizes: Vec<f64> = events.iter().map(size).collect();
    sizes.sort_by(|a, b| b.total_cmp(a));
    let least = sizes.get(EVENTS - 1).copied().unwrap_or(f64::NEG_INFINITY);
    let drawn: Vec<_> = events
        .into_iter()
        .filter(|event| size(event) >= least)
        .collect();
    let largest = drawn.iter().flat_map(|event| &event.slip);
    let largest = largest.copied().fold(0.0, f64::max);
    let step = plot::interval(largest);
    let drawn = drawn.into_iter().map(|event| {
        let title = format!("event at {:.2} years", event.time / YEAR);
        let lines = if step > 0.0 {
            let corners = contours::at_corners(cells, &event.slip);
            plot::contours(places, &corners, step)
        } else {
            Vec::new()
        };
        on_plane(title, places, event.slip, lines)
    });
    let mut drawn: Vec<_> = drawn.collect();
    if drawn.is_empty() {
        let none = vec![0.0; cells.count()];
        drawn.push(on_plane("no event".to_owned(), places, none, Vec::new()));
    }
    let mut rows = Vec::new();
    let mut drawn = drawn.into_iter();
    while let Some(first) = drawn.next() {
        rows.push([Some(first), drawn.next()]);
    }
    let name = if step > 0.0 {
        format!("slip [m], contours at {} m", (step * 1e6).round() / 1e6)
    } else {
        "slip [m]".to_owned()
    };
    let sheet = PatchSheet {
        name: &name,
        colors: Colors {
            range: (0.0, if largest > 0.0 { largest } else { 1.0 }),
            logarithmic: false,
        },
        rows,
    };
    plot::draw(path, &sheet)
}

/// Values of the unrolled surface.
fn on_plane<'a>(
    title: String,
    places: &'a [[[f64; 2]; 3]],
    values: Vec<f64>,
    lines: Vec<Points>,
) -> Patches<'a> {
    Patches {
        title,
        triangles: places,
        values,
        behind: Vec::new(),
        above: lines.into_iter().map(|line| (2, line)).collect(),
        texts: Vec::new(),
        names: Some(AXES),
    }
}

#[cfg(test)]
mod tests {
    use super::chosen;

    #[test]
    fn frames_are_chosen_from_the_first_to_the_last() {
        for (count, expected) in [
            (1, vec![0.0]),
            (3, vec![0.0, 1.0, 2.0]),
            (10, vec![0.0, 3.0, 6.0, 9.0]),
        ] {
            let frames = (0..count).map(|n| (f64::from(n), Vec::new())).collect();
            let times: Vec<f64> = chosen(frames).iter().map(|frame| frame.0).collect();
            assert_eq!(times, expected);
        }
    }
}

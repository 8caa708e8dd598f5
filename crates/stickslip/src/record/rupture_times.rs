//! Rupture times of events.

use std::io;

use super::check::{check_index, positive, require};
use super::seas::{Rows, SeasHeader};
use super::threshold::time_of;
use crate::sums::largest;
use crate::{FileError, SceneError, Snapshot};

/// The time of a vertex that an event does not reach, after its onset \[s\].
const NEVER: f64 = 1e9;

/// The times at which the vertices of a contact rupture in each event: contours of the rupture front.
///
/// A vertex ruptures when its slip rate first exceeds the threshold in an event, its logarithm interpolated within the
/// step. Events are those of an [`EventCatalogue`](super::EventCatalogue) with the same rates, and an event that is in
/// progress at the start, such as the forced first one of BP5.
///
/// ```
/// # #[cfg(feature = "bie")] {
/// use stickslip::bie::{Cells, Fault};
/// use stickslip::problems::bp1;
/// use stickslip::record::{RuptureTimes, SeasHeader, SeasTable};
/// use stickslip::{RungeKutta, Steps};
///
/// let fault = Fault::half_space(Cells::new([0.0, 40e3], 40)?, bp1::MEDIUM)?;
/// let mut cycle = RungeKutta::new(bp1::scene(&fault))?;
/// let mut front = RuptureTimes::new(&cycle.snapshot(), 0, [1.2e-9, 1.1e-9])?;
/// cycle.run(&Steps::adaptive(1e-4).until(3.15576e9), |at| front.record(&at))?;
/// let first = front.events().first().ok_or("no event")?;
/// assert!(first.times.iter().any(|time| *time == 0.0));
/// let mut file = Vec::new();
/// front.write(first, &SeasHeader::new("BP1-QD"), &mut file)?;
/// let read = SeasTable::parse(&file[..], "rupture.dat".as_ref())?;
/// assert_eq!(read.column("t"), Some(&first.times[..]));
/// # }
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[doc(alias("rupture front", "rupture.dat", "contour"))]
pub struct RuptureTimes {
    contact: usize,
    threshold: f64,
    end: f64,
    dimension: usize,
    points: Vec<[f64; 3]>,
    /// The time \[s\] and the slip rates [m/s] of the last step.
    time: f64,
    rates: Vec<f64>,
    /// Those of the step shown, until it is recorded.
    #[cfg_attr(feature = "serde", serde(skip))]
    now: Vec<f64>,
    armed: bool,
    under_way: Option<Rupture>,
    events: Vec<Rupture>,
}

/// The rupture of an event.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct Rupture {
    /// The time at which the first vertex ruptures \[s\].
    pub onset: f64,
    /// The rupture time of each vertex after the onset \[s\], 1e9 if it does not rupture.
    pub times: Vec<f64>,
}

impl RuptureTimes {
    /// Ruptures of contact number `contact`, counted from 0. Events begin and vertices rupture at a slip rate of
    /// `threshold`, and events end when all slip rates are below `end` [m/s], at most the threshold.
    ///
    /// # Errors
    /// [`SceneError::Index`] for a contact that the scene does not have, [`SceneError::Value`] for rates that are not
    /// positive and finite, or an `end` above the threshold.
    pub fn new<const C: usize>(
        at: &Snapshot<'_, C>,
        contact: usize,
        [threshold, end]: [f64; 2],
    ) -> Result<Self, SceneError> {
        check_index("contact", contact, at.contact_count())?;
        positive("threshold", threshold)?;
        let what = "rate that ends an event";
        positive(what, end)?;
        let requirement = "no larger than the threshold";
        require(what, requirement, end, end <= threshold)?;
        let seen = at.contact(contact);
        let mut front = Self {
            contact,
            threshold,
            end,
            dimension: seen.dimension(),
            points: (0..seen.len()).map(|k| seen.point(k)).collect(),
            time: at.time,
            rates: vec![0.0; seen.len()],
            now: Vec::with_capacity(seen.len()),
            armed: true,
            under_way: None,
            events: Vec::new(),
        };
        // Of a vertex that slips at the start, it is the rupture time.
        front.record(at);
        Ok(front)
    }

    /// Records the step shown. Allocates one number per vertex for each event.
    ///
    /// # Panics
    /// For a step of a scene with fewer contacts or vertices than the recorder's own.
    pub fn record<const C: usize>(&mut self, at: &Snapshot<'_, C>) {
        let contact = at.contact(self.contact);
        let vertices = 0..self.rates.len();
        self.now.clear();
        (self.now).extend(vertices.clone().map(|k| contact.slip_rate(k)));
        let largest = largest(self.now.iter().copied());
        let passes = |k: usize| {
            let (from, to) = ((self.time, self.rates[k]), (at.time, self.now[k]));
            (to.1 >= self.threshold).then(|| time_of(self.threshold, from, to))
        };
        if self.under_way.is_none() && self.armed && largest >= self.threshold {
            self.armed = false;
            let first = vertices.filter_map(passes).min_by(f64::total_cmp);
            self.under_way = Some(Rupture {
                onset: first.unwrap_or(at.time),
                times: vec![NEVER; self.rates.len()],
            });
        }
        if let Some(Rupture { onset, times }) = &mut self.under_way {
            for (k, time) in times.iter_mut().enumerate() {
                if *time == NEVER
                    && let Some(passed) = passes(k)
                {
                    *time = passed - *onset;
                }
            }
        }
        std::mem::swap(&mut self.rates, &mut self.now);
        self.time = at.time;
        if largest < self.end {
            self.armed = true;
            self.events.extend(self.under_way.take());
        }
    }

    /// The completed events, in their order.
    pub fn events(&self) -> &[Rupture] {
        &self.events
    }

    /// The event in progress.
    pub fn under_way(&self) -> Option<&Rupture> {
        self.under_way.as_ref()
    }

    /// Hands over the completed events and forgets them, in a run of many events on many vertices.
    pub fn take(&mut self) -> Vec<Rupture> {
        std::mem::take(&mut self.events)
    }

    /// Writes an event in the format of the SEAS benchmarks (`rupture.dat`): rows `x2 x3 t`, the position along strike
    /// and down dip \[m\] and the rupture time after the onset \[s\], 1e9 at cells that do not rupture. On a line the
    /// columns are `z t`, in space `x1 x2 x3 t`.
    ///
    /// # Errors
    /// [`FileError::Write`].
    pub fn write<W: io::Write>(
        &self,
        rupture: &Rupture,
        header: &SeasHeader,
        writer: W,
    ) -> Result<W, FileError> {
        let columns: &[_] = match self.dimension {
            0 | 1 => &[("z", "z (m)")],
            2 => &[("x2", "x2 (m)"), ("x3", "x3 (m)")],
            _ => &[("x1", "x1 (m)"), ("x2", "x2 (m)"), ("x3", "x3 (m)")],
        };
        let count = columns.len();
        let columns = [columns, &[("t", "Rupture time after the onset (s)")]].concat();
        let header = header
            .clone()
            .with("onset", &format!("{:e} s", rupture.onset));
        let mut rows = Rows::new(writer);
        rows.begin(&header, "frictional domain", &columns);
        rows.names(columns.iter().map(|(name, _)| *name));
        for (point, time) in self.points.iter().zip(&rupture.times) {
            rows.row(point.iter().take(count).copied().chain([*time]));
        }
        rows.finish()
    }
}

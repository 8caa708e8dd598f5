//! Slip and stress along a line.

use std::fs::File;
use std::io;
use std::ops::ControlFlow;
use std::path::Path;

use super::place::{Map, Place};
use super::quantity::Quantity;
use super::{Rows, SeasHeader, SeasPoint, log_rate};
use crate::record::check::{check_index, positive, require};
use crate::{FileError, SceneError, Snapshot};

/// Slip or stress along a line of a fault in time, in the format of the SEAS benchmarks (`slip.dat`, `devol.dat`,
/// `slip_2_strike.dat`; `shear_stress.dat`, `stress_2_strike.dat`; `normal_stress.dat`).
///
/// The first row is `0 0` and the positions \[m\]; each other row is the time \[s\], log10 of the largest slip rate
/// [m/s] and the slip \[m\] at each position, or by [`shear_stress`](Self::shear_stress),
/// [`normal_stress`](Self::normal_stress) and [`pore_pressure`](Self::pore_pressure) a stress \[MPa\]. Between cells all
/// are interpolated as by [`SeasStation`](super::SeasStation).
///
/// By default every step shown is a row. With [`at_intervals`](Self::at_intervals) rows are dense in events and sparse
/// between them.
///
/// ```
/// # #[cfg(feature = "bie")] {
/// use stickslip::bie::{Cells, Fault};
/// use stickslip::problems::bp1;
/// use stickslip::record::{SeasHeader, SeasPoint, SeasProfile};
/// use stickslip::{RungeKutta, Steps};
///
/// let fault = Fault::half_space(Cells::new([0.0, 40e3], 40)?, bp1::MEDIUM)?;
/// let mut cycle = RungeKutta::new(bp1::scene(&fault))?;
/// let (at, header, year) = (cycle.snapshot(), SeasHeader::new("BP1-QD"), 3.15576e7);
/// let points = [0.0, 5e3, 10e3].map(SeasPoint::Line);
/// // Every 5 years, and every second while the fault slips faster than 1 mm/s.
/// let mut slip = SeasProfile::new(&at, 0, &points, &header, Vec::new())?
///     .at_intervals(1e-3, [5.0 * year, 1.0])?
///     .with_start(&at);
/// cycle.run(&Steps::adaptive(1e-4).until(20.0 * year), |at| slip.record(&at))?;
/// let text = String::from_utf8(slip.finish()?)?;
/// assert!(text.contains("\nz\nt max_slip_rate slip\n0e0 0e0 0e0 5e3 1e4\n0e0 -"));
/// # }
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
#[doc(alias("devol", "slip.dat", "stress.dat", "snapshot"))]
pub struct SeasProfile<W: io::Write> {
    rows: Rows<W>,
    header: SeasHeader,
    contact: usize,
    points: Vec<SeasPoint>,
    places: Vec<Place>,
    quantity: Quantity,
    component: usize,
    /// The slip rate of events [m/s], and the intervals between rows below and above it \[s\].
    intervals: (f64, [f64; 2]),
    /// The time of the last row \[s\], and whether it was in an event.
    last: Option<(f64, bool)>,
}

impl SeasProfile<File> {
    /// Slip of contact number `contact`, counted from 0, in a new file.
    ///
    /// # Errors
    /// Those of [`new`](Self::new), [`FileError::Write`] for a file that cannot be created.
    pub fn create<const C: usize>(
        at: &Snapshot<'_, C>,
        contact: usize,
        points: &[SeasPoint],
        header: &SeasHeader,
        path: impl AsRef<Path>,
    ) -> Result<Self, FileError> {
        let places = places(at, contact, points)?;
        let rows = Rows::create(path.as_ref())?;
        Ok(Self::of(rows, header, contact, (points, places)))
    }
}

impl<W: io::Write> SeasProfile<W> {
    /// Slip of contact number `contact`, counted from 0, at points on a line; on a plane they have one coordinate in
    /// common. Nothing is written before the first step shown.
    ///
    /// # Errors
    /// [`SceneError::Index`] for a contact that the scene does not have, [`SceneError::Value`] for a contact of another
    /// dimension, no points, and points that are on no line along strike or down dip, [`SceneError::OutsideContact`].
    pub fn new<const C: usize>(
        at: &Snapshot<'_, C>,
        contact: usize,
        points: &[SeasPoint],
        header: &SeasHeader,
        writer: W,
    ) -> Result<Self, FileError> {
        let places = places(at, contact, points)?;
        let rows = Rows::new(writer);
        Ok(Self::of(rows, header, contact, (points, places)))
    }

    fn of(
        rows: Rows<W>,
        header: &SeasHeader,
        contact: usize,
        (points, places): (&[SeasPoint], Vec<Place>),
    ) -> Self {
        Self {
            rows,
            header: header.clone(),
            contact,
            points: points.to_vec(),
            places,
            quantity: Quantity::Slip,
            component: 0,
            intervals: (f64::INFINITY, [0.0; 2]),
            last: None,
        }
    }

    /// Records the shear stress \[MPa\] in the place of slip.
    #[must_use]
    pub fn shear_stress(mut self) -> Self {
        self.quantity = Quantity::ShearStress;
        self
    }

    /// Records the normal stress in the place of slip, positive in compression \[MPa\].
    #[must_use]
    pub fn normal_stress(mut self) -> Self {
        self.quantity = Quantity::NormalStress;
        self
    }

    /// Records the pore pressure in the place of slip \[MPa\]: the change by the [fields](crate::Contact::with_field) of the
    /// contact.
    #[must_use]
    pub fn pore_pressure(mut self) -> Self {
        self.quantity = Quantity::PorePressure;
        self
    }

    /// Records component 3 of slip or shear stress on a plane, down dip: the opposite of the second component of the
    /// contact. By default the first one is recorded, along strike.
    #[must_use]
    pub fn down_dip(mut self) -> Self {
        self.component = 1;
        self
    }

    /// Keeps a step if the last one kept is an interval \[s\] ago, the first one while the largest slip rate is below
    /// `threshold` [m/s] and the second one above it, and the first step on either side of the threshold.
    ///
    /// # Errors
    /// [`SceneError::Value`] for a threshold or intervals that are not positive and finite.
    pub fn at_intervals(mut self, threshold: f64, intervals: [f64; 2]) -> Result<Self, SceneError> {
        positive("threshold", threshold)?;
        for interval in intervals {
            positive("interval between rows", interval)?;
        }
        self.intervals = (threshold, intervals);
        Ok(self)
    }

    /// Records the step shown as the first row: the start of a run. A write error ends the run with its first step.
    #[must_use]
    pub fn with_start<const C: usize>(mut self, at: &Snapshot<'_, C>) -> Self {
        let _ = self.record(at);
        self
    }

    /// Records the step shown, if it is kept; breaks the run on a write error.
    ///
    /// # Panics
    /// For a step of a scene with fewer contacts or vertices than the recorder's own, and for the component down dip of
    /// slip with one component.
    pub fn record<const C: usize>(&mut self, at: &Snapshot<'_, C>) -> ControlFlow<()> {
        let contact = at.contact(self.contact);
        let (threshold, [slow, fast]) = self.intervals;
        let largest = contact.max_slip_rate();
        let seismic = largest >= threshold;
        let interval = if seismic { fast } else { slow };
        let begins = self.last.is_none();
        let keeps = |(time, last): (f64, bool)| last != seismic || at.time - time >= interval;
        if !self.last.is_none_or(keeps) {
            return ControlFlow::Continue(());
        }
        self.last = Some((at.time, seismic));
        if begins {
            self.begin();
        }
        let component = self.is_plane().then_some(self.component);
        let value = |k| self.quantity.at(&contact, k, component);
        let values = self.places.iter().map(|place| place.mean(value));
        let row = [at.time, log_rate(largest)].into_iter().chain(values);
        self.rows.row(row);
        if begins {
            self.rows.write();
        }
        self.rows.flow()
    }

    fn is_plane(&self) -> bool {
        matches!(self.points.first(), Some(SeasPoint::Plane(_)))
    }

    fn begin(&mut self) {
        let axis = varying(&self.points).unwrap_or(0);
        let plane = self.is_plane();
        let position = match (plane, axis) {
            (false, _) => "z",
            (true, 0) => "x2",
            (true, _) => "x3",
        };
        let (name, quantity) = self.quantity.column();
        let name = match (plane && self.quantity.is_vector(), self.component) {
            (false, _) => name.to_owned(),
            (true, component) => format!("{name}_{}", component + 2),
        };
        let quantity = format!("{quantity} at the positions (m) of the first row, and so on");
        let columns = [
            ("t", "Time (s)"),
            ("max_slip_rate", "Max_slip_rate (log10 m/s)"),
            (&name, &quantity),
        ];
        self.rows
            .begin(&self.header, "on fault, along a line", &columns);
        self.rows.names([position]);
        self.rows.names(columns.map(|(name, _)| name));
        let positions = self.points.iter().map(|point| point.coordinates()[axis]);
        self.rows.row([0.0; 2].into_iter().chain(positions));
    }

    /// Writes the buffered rows, and returns the writer.
    ///
    /// # Errors
    /// [`FileError::Write`], also of an earlier row.
    pub fn finish(self) -> Result<W, FileError> {
        self.rows.finish()
    }
}

/// The coordinate along a line of points, none if they are on no line along strike or down dip.
fn varying(points: &[SeasPoint]) -> Option<usize> {
    let first = points.first()?.coordinates();
    let is_common = |c: usize| {
        points
            .iter()
            .all(|p| p.coordinates().get(c) == first.get(c))
    };
    match first.len() {
        1 => Some(0),
        _ if is_common(1) => Some(0),
        _ => is_common(0).then_some(1),
    }
}

fn places<const C: usize>(
    at: &Snapshot<'_, C>,
    contact: usize,
    points: &[SeasPoint],
) -> Result<Vec<Place>, FileError> {
    check_index("contact", contact, at.contact_count())?;
    let requirement = "at least 1, with one coordinate in common on a plane";
    let (count, aligned) = (points.len() as f64, varying(points).is_some());
    require("number of points of a profile", requirement, count, aligned)?;
    let map = match points.first() {
        Some(first) => Map::new(&at.contact(contact), *first)?,
        None => return Ok(Vec::new()),
    };
    let places: Result<_, SceneError> = points.iter().map(|point| map.place(*point)).collect();
    Ok(places?)
}

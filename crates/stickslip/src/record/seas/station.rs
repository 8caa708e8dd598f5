//! Histories at a station.

use std::fmt;
use std::fs::File;
use std::io;
use std::ops::ControlFlow;
use std::path::Path;

use super::columns::{Chosen, columns};
use super::fluid::fluid;
use super::place::{Map, Place};
use super::{Rows, SeasHeader, SeasPoint, log_rate};
#[cfg(doc)]
use crate::SceneError;
use crate::record::check::check_index;
use crate::{ContactView, FileError, Snapshot};

const PA: f64 = 1e-6;

/// The history of a station on a fault, in the format of the SEAS benchmarks (`fltst_dp075`, `fltst_strk+00dp+10`).
///
/// | names on a line | names on a plane | unit |
/// | --- | --- | --- |
/// | `t` | `t` | s |
/// | `slip` | `slip_2 slip_3` | m |
/// | `slip_rate` | `slip_rate_2 slip_rate_3` | log10 of m/s, of the modulus; -20 at rest |
/// | `shear_stress` | `shear_stress_2 shear_stress_3` | MPa |
/// | `normal_stress`, if chosen | likewise | MPa, positive in compression |
/// | `pore_pressure`, if chosen | likewise | MPa |
/// | `darcy_vel`, with it | `darcy_vel_2 darcy_vel_3` | m/s |
/// | `state` | `state` | log10 of theta in s |
///
/// A station between the centres of cells is interpolated linearly, on a plane bilinearly: slip, slip rate, stresses,
/// and the logarithm of the state. Within half a cell of an end of the fault it has the values of the last cell.
/// Component 2 is along strike and component 3 down dip: the opposite of the up-dip component of a plane
/// ([`along`](Self::along)). The slip is that of the contact: of a body that is one of two halves, half of the
/// benchmark's.
///
/// Every step shown is a row. The memory does not grow with the run, and the file of a run that was interrupted ends
/// with a whole row. A write error ends the run, and [`finish`](Self::finish) returns it.
///
/// ```
/// # #[cfg(feature = "bie")] {
/// use stickslip::bie::{Cells, Fault};
/// use stickslip::problems::bp1;
/// use stickslip::record::{SeasHeader, SeasPoint, SeasStation};
/// use stickslip::{RungeKutta, Steps};
///
/// let fault = Fault::half_space(Cells::new([0.0, 40e3], 40)?, bp1::MEDIUM)?;
/// let mut cycle = RungeKutta::new(bp1::scene(&fault))?;
/// let header = SeasHeader::new("SEAS Benchmark BP1-QD").with("element_size", "1000 m");
/// let at = cycle.snapshot();
/// let mut station = SeasStation::new(&at, 0, SeasPoint::Line(7.5e3), &header, Vec::new())?.with_start(&at);
/// cycle.run(&Steps::adaptive(1e-4).until(1e5), |at| station.record(&at))?;
/// let text = String::from_utf8(station.finish()?)?;
/// assert!(text.contains("\nt slip slip_rate shear_stress state\n0e0 0e0 -"));
/// # }
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[doc(alias("fltst", "probe", "time series"))]
pub struct SeasStation<W: io::Write> {
    rows: Rows<W>,
    header: SeasHeader,
    contact: usize,
    point: SeasPoint,
    place: Place,
    /// The parts of the components of slip along strike and up dip.
    directions: Vec<[f64; 2]>,
    chosen: Chosen,
    log10_state: Box<dyn Fn(f64) -> f64 + Send + Sync>,
    begun: bool,
}

impl SeasStation<File> {
    /// A station of contact number `contact`, counted from 0, in a new file.
    ///
    /// # Errors
    /// Those of [`new`](Self::new), [`FileError::Write`] for a file that cannot be created.
    pub fn create<const C: usize>(
        at: &Snapshot<'_, C>,
        contact: usize,
        point: SeasPoint,
        header: &SeasHeader,
        path: impl AsRef<Path>,
    ) -> Result<Self, FileError> {
        // No file for a station that does not exist.
        let place = place(at, contact, point)?;
        let rows = Rows::create(path.as_ref())?;
        Ok(Self::of::<C>(rows, header, contact, (point, place)))
    }
}

impl<W: io::Write> SeasStation<W> {
    /// A station of contact number `contact`, counted from 0. Nothing is written before the first step shown.
    ///
    /// # Errors
    /// [`SceneError::Index`] for a contact that the scene does not have, [`SceneError::Value`] for a contact of another
    /// dimension, [`SceneError::OutsideContact`].
    pub fn new<const C: usize>(
        at: &Snapshot<'_, C>,
        contact: usize,
        point: SeasPoint,
        header: &SeasHeader,
        writer: W,
    ) -> Result<Self, FileError> {
        let place = place(at, contact, point)?;
        Ok(Self::of::<C>(
            Rows::new(writer),
            header,
            contact,
            (point, place),
        ))
    }

    fn of<const C: usize>(
        rows: Rows<W>,
        header: &SeasHeader,
        contact: usize,
        (point, place): (SeasPoint, Place),
    ) -> Self {
        Self {
            rows,
            header: header.clone(),
            contact,
            point,
            place,
            directions: [[1.0, 0.0], [0.0, 1.0]].into_iter().take(C).collect(),
            chosen: Chosen::default(),
            log10_state: Box::new(|alpha| alpha / std::f64::consts::LN_10),
            begun: false,
        }
    }

    /// Adds the normal stress, as in BP3.
    #[must_use]
    pub fn with_normal_stress(mut self) -> Self {
        self.chosen.normal_stress = true;
        self
    }

    /// Adds the pore pressure and the Darcy velocity of the [fields](crate::Contact::with_field), as in BP6 and BP8; the
    /// velocity is no number if no field shows it, as [`Diffusion`](crate::fields::Diffusion) does.
    #[must_use]
    #[doc(alias("darcy velocity"))]
    pub fn with_pore_fluid(mut self) -> Self {
        self.chosen.pore_fluid = true;
        self
    }

    /// The directions of the components of slip on a plane, their parts along strike and up dip: those of
    /// `PlaneFault::directions` for a fault with a fixed rake. By default the first component is along strike and the
    /// second up dip.
    #[must_use]
    pub fn along(mut self, directions: &[[f64; 2]]) -> Self {
        self.directions = directions.to_vec();
        self
    }

    /// The last column as a function of the state law's own variable. By default this is the logarithm of theta, as of
    /// [`LogTheta`](crate::state::LogTheta), and the column its logarithm to base 10.
    #[must_use]
    pub fn with_log10_state(
        mut self,
        log10_state: impl Fn(f64) -> f64 + Send + Sync + 'static,
    ) -> Self {
        self.log10_state = Box::new(log10_state);
        self
    }

    /// Records the step shown as the first row: the start of a run. A write error ends the run with its first step.
    #[must_use]
    pub fn with_start<const C: usize>(mut self, at: &Snapshot<'_, C>) -> Self {
        let _ = self.record(at);
        self
    }

    /// Records the step shown; breaks the run on a write error.
    ///
    /// # Panics
    /// For a step of a scene with fewer contacts or vertices than the recorder's own.
    pub fn record<const C: usize>(&mut self, at: &Snapshot<'_, C>) -> ControlFlow<()> {
        let begins = !std::mem::replace(&mut self.begun, true);
        if begins {
            self.begin();
        }
        let contact = at.contact(self.contact);
        let (slip, rate, stress) = match self.point {
            SeasPoint::Line(_) => {
                let mean = |value: &dyn Fn(usize) -> f64| [self.place.mean(value), f64::NAN];
                // At most one component is tangential to a line along an axis.
                let slip = mean(&|k| contact.slip_vector(k).sum());
                let rate = mean(&|k| contact.slip_velocity(k).sum());
                (slip, rate, mean(&|k| contact.traction(k).sum()))
            }
            SeasPoint::Plane(_) => (
                self.vector(&|k, c| contact.slip_vector(k)[c]),
                self.vector(&|k, c| contact.slip_velocity(k)[c]),
                self.vector(&|k, c| contact.traction(k)[c]),
            ),
        };
        let count = self.components();
        let vectors = [slip, rate.map(log_rate), stress.map(|stress| PA * stress)];
        let vectors = vectors.into_iter().flat_map(|v| v.into_iter().take(count));
        let normal = self.chosen.normal_stress.then(|| {
            let mean = self.place.mean(|k| contact.normal_stress(k));
            PA * mean
        });
        let pore_fluid = self.chosen.pore_fluid;
        let fluid = pore_fluid.then(|| fluid(&contact, (self.point, &self.place)));
        let state = self.state(&contact);
        let numbers = [at.time].into_iter().chain(vectors).chain(normal);
        let numbers = numbers.chain(fluid.into_iter().flatten());
        self.rows.row(numbers.chain([state]));
        if begins {
            self.rows.write();
        }
        self.rows.flow()
    }

    /// The number of components: one on a line, two on a plane.
    fn components(&self) -> usize {
        self.point.coordinates().len()
    }

    /// Components 2 and 3: along strike and down dip.
    fn vector(&self, component: &dyn Fn(usize, usize) -> f64) -> [f64; 2] {
        let mut vector = [0.0; 2];
        for (c, [strike, up]) in self.directions.iter().enumerate() {
            let mean = self.place.mean(|k| component(k, c));
            vector[0] += strike * mean;
            vector[1] -= up * mean;
        }
        vector
    }

    fn state<const C: usize>(&self, contact: &ContactView<'_, C>) -> f64 {
        if contact.has_state() {
            self.place.mean(|k| (self.log10_state)(contact.state(k)))
        } else {
            f64::NAN
        }
    }

    fn begin(&mut self) {
        let columns = columns(self.point, self.chosen);
        let location = self.point.to_string();
        self.rows.begin(&self.header, &location, &columns);
        self.rows.names(columns.iter().map(|(name, _)| *name));
    }

    /// Writes the buffered rows, and returns the writer.
    ///
    /// # Errors
    /// [`FileError::Write`], also of an earlier row.
    pub fn finish(self) -> Result<W, FileError> {
        self.rows.finish()
    }
}

fn place<const C: usize>(
    at: &Snapshot<'_, C>,
    contact: usize,
    point: SeasPoint,
) -> Result<Place, FileError> {
    check_index("contact", contact, at.contact_count())?;
    Ok(Map::new(&at.contact(contact), point)?.place(point)?)
}

impl<W: io::Write> fmt::Debug for SeasStation<W> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut shown = f.debug_struct("SeasStation");
        shown.field("contact", &self.contact);
        shown.field("point", &self.point).finish_non_exhaustive()
    }
}

//! The largest slip rate and the moment rate.

use std::fs::File;
use std::io;
use std::ops::ControlFlow;
use std::path::Path;

use super::{Rows, SeasHeader, log_rate};
#[cfg(doc)]
use crate::SceneError;
use crate::record::check::{check_index, positive};
use crate::{FileError, Snapshot};

/// The largest slip rate and the moment rate of a contact in time, in the format of the SEAS benchmarks (`global.dat`).
///
/// | name | quantity | unit |
/// | --- | --- | --- |
/// | `t` | time | s |
/// | `max_slip_rate` | log10 of the largest slip rate, -20 at rest | log10 of m/s |
/// | `moment_rate` | `G` times the integral of the slip rate | N m/s; N/s in 2D, per metre of depth |
///
/// Every step shown is a row; see [`SeasStation`](super::SeasStation) for the file.
///
/// ```
/// # #[cfg(feature = "bie")] {
/// use stickslip::RungeKutta;
/// use stickslip::bie::{Cells, Fault};
/// use stickslip::problems::bp1;
/// use stickslip::record::{SeasGlobal, SeasHeader};
///
/// let fault = Fault::half_space(Cells::new([0.0, 40e3], 40)?, bp1::MEDIUM)?;
/// let start = RungeKutta::new(bp1::scene(&fault))?;
/// let (at, modulus) = (start.snapshot(), bp1::MEDIUM.shear_modulus);
/// let header = SeasHeader::new("SEAS Benchmark BP1-QD");
/// let global = SeasGlobal::new(&at, 0, modulus, &header, Vec::new())?.with_start(&at);
/// let text = String::from_utf8(global.finish()?)?;
/// let last = text.lines().last().and_then(|row| row.split(' ').next_back()).ok_or("no row")?;
/// assert!((last.parse::<f64>()? / (modulus * bp1::PLATE_RATE * 40e3) - 1.0).abs() < 1e-6);
/// # }
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
#[doc(alias("moment rate", "global.dat"))]
pub struct SeasGlobal<W: io::Write> {
    rows: Rows<W>,
    header: SeasHeader,
    contact: usize,
    /// `G` times the area of each vertex, 0 outside of the chosen region [N; N/m in 2D].
    rigidity: Vec<f64>,
    begun: bool,
}

impl SeasGlobal<File> {
    /// The rates of contact number `contact`, counted from 0, in a new file.
    ///
    /// # Errors
    /// Those of [`new`](Self::new), [`FileError::Write`] for a file that cannot be created.
    pub fn create<const C: usize>(
        at: &Snapshot<'_, C>,
        contact: usize,
        shear_modulus: f64,
        header: &SeasHeader,
        path: impl AsRef<Path>,
    ) -> Result<Self, FileError> {
        let rigidity = rigidity(at, contact, shear_modulus)?;
        let rows = Rows::create(path.as_ref())?;
        Ok(Self::of(rows, header, contact, rigidity))
    }
}

impl<W: io::Write> SeasGlobal<W> {
    /// The rates of contact number `contact`, counted from 0. The shear modulus `G` \[Pa\] is that of the body next to
    /// the contact. Nothing is written before the first step shown.
    ///
    /// # Errors
    /// [`SceneError::Index`] for a contact that the scene does not have, [`SceneError::Value`] for a modulus that is
    /// not positive and finite.
    pub fn new<const C: usize>(
        at: &Snapshot<'_, C>,
        contact: usize,
        shear_modulus: f64,
        header: &SeasHeader,
        writer: W,
    ) -> Result<Self, FileError> {
        let rigidity = rigidity(at, contact, shear_modulus)?;
        Ok(Self::of(Rows::new(writer), header, contact, rigidity))
    }

    fn of(rows: Rows<W>, header: &SeasHeader, contact: usize, rigidity: Vec<f64>) -> Self {
        Self {
            rows,
            header: header.clone(),
            contact,
            rigidity,
            begun: false,
        }
    }

    /// Counts the moment of the vertices inside only, such as those of the velocity-weakening region, by their
    /// positions \[m\]. The largest slip rate stays that of the whole contact.
    #[must_use]
    pub fn moment_within<const C: usize>(
        mut self,
        at: &Snapshot<'_, C>,
        mut inside: impl FnMut([f64; 3]) -> bool,
    ) -> Self {
        let contact = at.contact(self.contact);
        for (k, rigidity) in self.rigidity.iter_mut().enumerate() {
            if !inside(contact.point(k)) {
                *rigidity = 0.0;
            }
        }
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
            let columns = [
                ("t", "Time (s)"),
                ("max_slip_rate", "Max_slip_rate (log10 m/s)"),
                ("moment_rate", "Moment_rate (N-m/s; N/s in 2D)"),
            ];
            self.rows.begin(&self.header, "frictional domain", &columns);
            self.rows.names(columns.map(|(name, _)| name));
        }
        let contact = at.contact(self.contact);
        let (mut largest, mut moment_rate) = (0.0_f64, 0.0);
        for (k, rigidity) in self.rigidity.iter().enumerate() {
            let rate = contact.slip_rate(k);
            largest = largest.max(rate);
            moment_rate += rigidity * rate;
        }
        self.rows.row([at.time, log_rate(largest), moment_rate]);
        if begins {
            self.rows.write();
        }
        self.rows.flow()
    }

    /// Writes the buffered rows, and returns the writer.
    ///
    /// # Errors
    /// [`FileError::Write`], also of an earlier row.
    pub fn finish(self) -> Result<W, FileError> {
        self.rows.finish()
    }
}

fn rigidity<const C: usize>(
    at: &Snapshot<'_, C>,
    contact: usize,
    shear_modulus: f64,
) -> Result<Vec<f64>, FileError> {
    check_index("contact", contact, at.contact_count())?;
    positive("shear modulus", shear_modulus)?;
    let contact = at.contact(contact);
    let vertices = 0..contact.len();
    Ok(vertices
        .map(|k| shear_modulus * contact.weight(k))
        .collect())
}

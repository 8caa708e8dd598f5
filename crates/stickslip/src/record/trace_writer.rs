//! Traces of a contact in space and time, as a table.

use std::io;
use std::ops::ControlFlow;

use super::table::{Entry, Lasting};
use super::tracing::{Sampler, Seen, Tracing, along};
#[cfg(doc)]
use crate::SceneError;
use crate::{FileError, Snapshot};

/// Traces of a contact as comma-separated values: one row per vertex for every step kept, in the order of the vertices
/// along the contact.
///
/// The columns are `time` \[s\], the position along the contact (`along` \[m\] in the plane; `x`, `y`, `z` in space),
/// and the chosen quantities. The memory does not grow with the run. A write error ends the run, and
/// [`finish`](Self::finish) returns it.
///
/// ```
/// use stickslip::fem::{P1, antiplane};
/// use stickslip::friction::Tresca;
/// use stickslip::record::{Quantity, TraceWriter, Tracing};
/// use stickslip::{Components, Condensed, Contact, GeneralizedAlpha, Scene, Simulation, Steps};
///
/// let space = P1::grid([2.0, 1.0], [4, 2])?;
/// let (bottom, top) = (space.trace(|x| x[1] == 0.0)?, space.trace(|x| x[1] == 1.0)?);
/// let scene = Scene::new(antiplane(&space, 1e9)?)
///     .with_contact(Contact::new(&bottom, Tresca { coefficient: 0.6 }, 1e6))
///     .prescribe_velocity(&top, Components::ALL, |_| [1e-3]);
/// let mut layer = Simulation::new(scene, GeneralizedAlpha::default(), Condensed::new())?;
/// let tracing = Tracing::of(0, &[Quantity::Slip, Quantity::Traction]).every(50);
/// let mut trace = TraceWriter::new(&layer.snapshot(), tracing, Vec::new())?;
/// layer.run(&Steps::constant(0.01).count(101), |at| trace.record(&at))?;
/// let text = String::from_utf8(trace.finish()?)?;
/// assert!(text.starts_with("time,along,slip,traction\n1e-2,0e0,0e0,"));
/// assert_eq!(text.lines().count(), 1 + 3 * 5);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
#[doc(alias = "probe")]
pub struct TraceWriter<W> {
    rows: Lasting<W>,
    sampler: Sampler,
    order: Vec<usize>,
    along: Vec<f64>,
    in_space: bool,
}

impl<W: io::Write> TraceWriter<W> {
    /// Writes the names of the columns.
    ///
    /// # Errors
    /// [`SceneError::Index`] for a contact that the scene does not have, [`SceneError::Value`] for numbers out
    /// of range, [`FileError::Write`].
    pub fn new<const C: usize>(
        at: &Snapshot<'_, C>,
        tracing: Tracing,
        writer: W,
    ) -> Result<Self, FileError> {
        let sampler = Sampler::new(at, tracing)?;
        let contact = at.contact(sampler.tracing.contact);
        let (order, along) = along(&contact);
        let in_space = contact.dimension() == 3;
        let mut columns = vec!["time"];
        columns.extend_from_slice(if in_space {
            &["x", "y", "z"]
        } else {
            &["along"]
        });
        columns.extend(sampler.tracing.quantities.iter().map(|q| q.name(&contact)));
        Ok(Self {
            rows: Lasting::new(writer, &columns)?,
            sampler,
            order,
            along,
            in_space,
        })
    }

    /// Records the step shown; breaks the run on a write error.
    ///
    /// # Panics
    /// For a step of a scene with fewer contacts or vertices than the recorder's own.
    pub fn record<const C: usize>(&mut self, at: &Snapshot<'_, C>) -> ControlFlow<()> {
        let Some(contact) = self.sampler.keep(at) else {
            return ControlFlow::Continue(());
        };
        let seen = Seen::new(&contact, &self.sampler.tracing.quantities);
        for (&k, &along) in self.order.iter().zip(&self.along) {
            let (point, places) = if self.in_space {
                (contact.point(k), 3)
            } else {
                ([along, 0.0, 0.0], 1)
            };
            let quantities = &self.sampler.tracing.quantities;
            let values = quantities.iter().map(|quantity| seen.of(*quantity, k));
            let begin = [at.time].into_iter().chain(point.into_iter().take(places));
            self.rows.row(begin.chain(values).map(Entry::Number));
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

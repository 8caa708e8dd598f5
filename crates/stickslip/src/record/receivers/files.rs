//! The files of receivers while a run goes.

use std::fs::File;
use std::ops::ControlFlow;

use nalgebra::SVector;
use stickslip_bie::{ReceiverError, Receivers};

#[cfg(doc)]
use super::ReceiverFolder;
use crate::record::seas::Rows;
use crate::{FileError, Snapshot};

/// The files of receivers of a run, made by [`ReceiverFolder::create`].
#[derive(Debug)]
pub struct ReceiverFiles<const C: usize> {
    pub(super) receivers: Receivers<C>,
    pub(super) axes: Vec<[f64; 3]>,
    pub(super) creep: Option<Vec<[f64; 3]>>,
    /// The time at which creep beyond the cells begins \[s\].
    pub(super) begin: f64,
    pub(super) rows: Vec<Rows<File>>,
    pub(super) error: Option<ReceiverError>,
}

impl<const C: usize> ReceiverFiles<C> {
    /// Records a step; ends the run on a write error, which [`finish`](Self::finish) returns.
    pub fn record(&mut self, at: &Snapshot<'_, C>) -> ControlFlow<()> {
        let moved = match self.moved(at) {
            Ok(moved) => moved,
            Err(error) => {
                self.error = Some(error);
                return ControlFlow::Break(());
            }
        };
        for (rows, both) in self.rows.iter_mut().zip(moved) {
            let along = |vector: [f64; 3]| {
                let axes = self.axes.iter();
                axes.map(move |axis| (0..3).map(|i| axis[i] * vector[i]).sum::<f64>())
            };
            let [displacement, velocity] = both.map(along);
            rows.row([at.time].into_iter().chain(displacement).chain(velocity));
            rows.flow()?;
        }
        ControlFlow::Continue(())
    }

    /// The displacement and the velocity of each receiver.
    fn moved(&self, at: &Snapshot<'_, C>) -> Result<Vec<[[f64; 3]; 2]>, ReceiverError> {
        let of = |slip: &[SVector<f64, C>]| self.receivers.displacement(slip);
        let (displacement, velocity) = (of(at.displacement)?, of(at.velocity)?);
        let mut moved: Vec<_> = displacement.into_iter().zip(velocity).collect();
        let since = at.time - self.begin;
        for ((displacement, velocity), creep) in moved.iter_mut().zip(self.creep.iter().flatten()) {
            for i in 0..3 {
                displacement[i] += creep[i] * since;
                velocity[i] += creep[i];
            }
        }
        Ok(moved.into_iter().map(|(d, v)| [d, v]).collect())
    }

    pub(super) fn write(&mut self) {
        for rows in &mut self.rows {
            rows.write();
        }
    }

    /// Writes the buffered rows.
    ///
    /// # Errors
    /// [`FileError::Write`], also that of a step; [`FileError::Receivers`] for a step of another fault.
    pub fn finish(self) -> Result<(), FileError> {
        if let Some(error) = self.error {
            return Err(error.into());
        }
        for rows in self.rows {
            rows.finish()?;
        }
        Ok(())
    }
}

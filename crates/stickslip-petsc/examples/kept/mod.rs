//! Steps taken in pieces, between which the run is kept in a file.

use std::error::Error;
use std::path::Path;

use serde::{Deserialize, Serialize};
use stickslip::integrate::Stepper;
use stickslip::{Run, Steps};
use stickslip_cli::checkpoints::Checkpoints;
use stickslip_petsc::{DistributedSpace, SharedCheckpoint, SharedHistory};

/// The checkpoint file of a run, its tags and its length.
pub(crate) struct Kept<'a, const D: usize> {
    pub(crate) space: &'a DistributedSpace<D>,
    pub(crate) files: &'a Checkpoints,
    pub(crate) tags: Vec<(&'static str, String)>,
    /// The size of a step \[s\], and how many there are.
    pub(crate) step: f64,
    pub(crate) count: usize,
}

/// The counts beside the history.
#[derive(Default, Serialize, Deserialize)]
pub(crate) struct Record {
    /// The steps of the plan, one that was split counted once.
    pub(crate) planned: usize,
    pub(crate) cycles: usize,
    pub(crate) couplings: usize,
}

impl<const D: usize> Kept<'_, D> {
    /// Takes the steps that are left, and records them behind those of the file that the run goes on from; how many
    /// were taken now, and all that is counted.
    pub(crate) fn take<const C: usize>(
        &self,
        stepper: &mut dyn Stepper<C>,
        history: &mut SharedHistory,
    ) -> Result<(usize, Record), Box<dyn Error>> {
        let at = |path: &Path| {
            let tags = self.tags.iter();
            let file = SharedCheckpoint::at(self.space, path);
            tags.fold(file, |file, (name, value)| file.tagged(*name, value))
        };
        let mut record = Record::default();
        if let Some(file) = self.files.origin().map(at) {
            let (before, rows) = file.restore::<(Record, _), C>(stepper)?;
            record = before;
            history.go_on_from(rows);
        }
        let (planned, count) = (record.planned, self.count);
        let Some(left) = count.checked_sub(planned) else {
            return Err(format!("the checkpoint is at step {planned}, --until at {count}").into());
        };
        let plan = Steps::constant(self.step);
        loop {
            if let Some(file) = self.files.file().map(at) {
                file.save(&stepper.snapshot(), &(&record, history.rows()))?;
            }
            let piece = self.files.every().min(count - record.planned);
            if piece == 0 {
                return Ok((left, record));
            }
            stepper.run(&plan.clone().count(piece), |at| {
                history.record(&at);
                record.cycles += at.report.solver_iterations;
                record.couplings += at.report.coupling_iterations;
            })?;
            record.planned += piece;
        }
    }
}

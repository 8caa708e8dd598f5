//! Checkpoints and restarts of a run, from the command line.

use std::num::NonZeroUsize;
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};

use clap::Args;
use stickslip::integrate::Stepper;
use stickslip::{Checkpoint, Snapshot, Steps};

use crate::cli::{Problem, count};
use crate::progress::Progress;
use crate::record::{Record, Recording};

/// The checkpoint file of a run, and the file of its restart.
#[derive(Debug, Clone, Default, PartialEq, Eq, Args)]
pub struct Checkpoints {
    /// Keep the run in this checkpoint file for --restart; written at the start, from time to time and at the end,
    /// where it stays
    #[arg(long, value_name = "FILE")]
    checkpoint: Option<PathBuf>,
    /// Write the checkpoint every K steps [default: 1000]
    #[arg(long, value_name = "K", value_parser = count)]
    checkpoint_every: Option<NonZeroUsize>,
    /// Restart from a checkpoint of the same run, as if it had not ended; the files written are the same but for run
    /// times
    #[arg(long, value_name = "FILE")]
    restart: Option<PathBuf>,
}

/// Steps between two checkpoints.
const EVERY: usize = 1000;

/// Names and values that identify a run.
pub type Tags = Vec<(String, String)>;

impl Checkpoints {
    /// The checkpoint file.
    pub fn file(&self) -> Option<&Path> {
        self.checkpoint.as_deref()
    }

    /// The number of steps between two checkpoints.
    pub fn every(&self) -> usize {
        match (&self.checkpoint, self.checkpoint_every) {
            (None, _) => usize::MAX,
            (_, every) => every.map_or(EVERY, NonZeroUsize::get),
        }
    }

    /// The file of the restart.
    pub fn origin(&self) -> Option<&Path> {
        self.restart.as_deref()
    }

    /// The file to restart from, of a run with these tags.
    pub fn restarted(&self, tags: &Tags) -> Option<Checkpoint> {
        self.restart.as_deref().map(|path| tagged(path, tags))
    }

    /// The file to write, for a run with these tags.
    pub fn kept(&self, tags: &Tags) -> Option<Checkpoint> {
        self.checkpoint.as_deref().map(|path| tagged(path, tags))
    }

    /// Takes the steps of a plan and records them, from the start or from a checkpoint; `plan` gives the remaining
    /// steps after so many.
    pub fn take<const C: usize>(
        &self,
        recording: Recording,
        simulation: &mut dyn Stepper<C>,
        tags: &Tags,
        plan: impl Fn(usize) -> Result<Steps, Problem>,
    ) -> Result<Record, Problem> {
        let mut record = match self.restarted(tags) {
            Some(file) => file.restore::<Record, C>(simulation)?.until(recording.end),
            None => Record::new(recording, &simulation.snapshot())?,
        };
        let mut rest = plan(record.planned)?;
        let kept = self.kept(tags);
        let every = self.every();
        // A controller that plans ahead sees the whole run; a step that is split counts as one between pieces.
        let (piece, within) = if recording.adaptive {
            (usize::MAX, every)
        } else {
            (every, usize::MAX)
        };
        let mut saved = Ok(());
        let mut keep = |record: &Record, at: &Snapshot<'_, C>| {
            if let (Some(file), true) = (&kept, at.step.is_multiple_of(within)) {
                saved = file.save(at, record);
                if saved.is_err() {
                    return ControlFlow::Break(());
                }
            }
            ControlFlow::Continue(())
        };
        let mut progress = Progress::default();
        loop {
            if let Some(file) = &kept {
                file.save(&simulation.snapshot(), &record)?;
            }
            // None are left, or one has failed.
            let steps = rest.count(piece);
            if record.go_on(simulation, &steps, &mut progress, &mut keep) == 0 {
                break;
            }
            rest = plan(record.planned)?;
        }
        saved?;
        record.finish(&simulation.snapshot());
        Ok(record)
    }
}

fn tagged(path: &Path, tags: &Tags) -> Checkpoint {
    tags.iter()
        .fold(Checkpoint::at(path), |file, (name, value)| {
            file.tagged(name, value)
        })
}

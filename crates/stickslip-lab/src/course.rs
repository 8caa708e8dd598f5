//! The work of a fit, and whether to go on with it.

use std::fmt;

use crate::curve::Work;
use crate::error::LabError;

/// The number of steps between two questions whether to stop: some ten microseconds.
const STEPS: usize = 32;

/// A function that is true once a fit should stop.
#[derive(Clone, Copy)]
pub(crate) struct Interrupt<'a>(pub(crate) &'a (dyn Fn() -> bool + Sync));

impl fmt::Debug for Interrupt<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Interrupt")
    }
}

/// The work so far. Once it is interrupted all curves fail, until it is resumed.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Course<'a> {
    pub(crate) work: Work,
    interrupt: Option<Interrupt<'a>>,
    interrupted: bool,
}

impl<'a> Course<'a> {
    pub(crate) fn new(interrupt: Option<Interrupt<'a>>) -> Self {
        Self {
            interrupt,
            ..Self::default()
        }
    }

    /// Counts a curve.
    ///
    /// # Errors
    /// [`LabError::Interrupted`].
    pub(crate) fn begin_curve(&mut self) -> Result<(), LabError> {
        self.ask()?;
        self.work.integrations += 1;
        Ok(())
    }

    /// Counts a step of a curve.
    ///
    /// # Errors
    /// [`LabError::Interrupted`].
    pub(crate) fn count_step(&mut self) -> Result<(), LabError> {
        self.work.steps += 1;
        if self.work.steps.is_multiple_of(STEPS) {
            self.ask()
        } else {
            Ok(())
        }
    }

    fn ask(&mut self) -> Result<(), LabError> {
        let Some(Interrupt(interrupt)) = self.interrupt else {
            return Ok(());
        };
        self.interrupted = self.interrupted || interrupt();
        if self.interrupted {
            return Err(LabError::Interrupted);
        }
        Ok(())
    }

    /// Takes over the work of a search that went on from here.
    pub(crate) fn rejoin(&mut self, other: &Course<'_>) {
        (self.work, self.interrupted) = (other.work, other.interrupted);
    }

    pub(crate) fn is_interrupted(&self) -> bool {
        self.interrupted
    }

    /// Goes on, for the result of what there is, whether it was interrupted or not.
    pub(crate) fn resume(&mut self) {
        self.interrupt = None;
    }
}

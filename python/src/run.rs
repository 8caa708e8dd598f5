//! A run without the interpreter's lock: it looks for signals and asks observers between steps.

use std::ops::ControlFlow;
use std::time::{Duration, Instant};

use pyo3::prelude::*;
use stickslip::integrate::{RunReport, Stepper};
use stickslip::{Run, Snapshot, StepFailure, Steps};

use crate::exit::{Call, attached, leaving, thread_ends};
use crate::raised::Raised;

/// The time between looks for signals, short for a hand at the keyboard.
const PATIENCE: Duration = Duration::from_millis(50);

/// The end of a run before its time.
pub(crate) enum Ended {
    /// A step failed.
    Failed(StepFailure),
    /// An exception: of an observer, of a law, a keyboard interrupt, or the end of the interpreter.
    Raised(PyErr),
}

/// Takes the steps of a plan and shows each to `observe`, whose exception ends the run, as a signal does and an exception
/// in `raised`. The last accepted step stays in place.
pub(crate) fn run<const C: usize>(
    (py, call, raised): (Python<'_>, &Call, &Raised),
    stepper: &mut dyn Stepper<C>,
    steps: &Steps,
    mut observe: impl FnMut(&Snapshot<'_, C>) -> PyResult<ControlFlow<()>> + Send,
) -> Result<RunReport, Ended> {
    call.detach(py, || {
        let mut ended = None;
        let mut looked = Instant::now();
        let report = stepper.run(steps, |at| {
            let mut look = || {
                if let Some(error) = raised.take() {
                    return Err(error);
                }
                let flow = observe(&at)?;
                if looked.elapsed() >= PATIENCE {
                    looked = Instant::now();
                    attached(|py| py.check_signals())?;
                }
                if leaving() {
                    return Err(thread_ends());
                }
                Ok(flow)
            };
            look().unwrap_or_else(|error| {
                ended = Some(error);
                ControlFlow::Break(())
            })
        });
        // The exception of a function first, whose value has failed the step.
        match raised.take().or(ended) {
            // A function that was not called any more fails its step.
            None if leaving() => Err(Ended::Raised(thread_ends())),
            Some(error) => Err(Ended::Raised(error)),
            None => report.map_err(Ended::Failed),
        }
    })
}

//! Runs that free the interpreter's lock, obey signals and ask observers between steps.

use std::ops::ControlFlow;
use std::time::{Duration, Instant};

use pyo3::prelude::*;
use stickslip::integrate::{RunReport, Stepper};
use stickslip::{Run, Snapshot, StepFailure, Steps};

use crate::exit::{Call, attached, leaving, thread_ends};
use crate::progress::Progress;
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

/// The steps of a run, and the times \[s\] at which it is sampled beside them.
pub(crate) struct Course<'a> {
    pub(crate) steps: &'a Steps,
    pub(crate) times: &'a [f64],
    pub(crate) progress: Option<&'a mut Progress>,
}

/// Takes the steps of a course and shows each to `observe`, whose exception ends the run, as a signal does and an
/// exception in `raised`; the times of the course are shown to `sample`. The last accepted step stays in place.
pub(crate) fn run<const C: usize>(
    (py, call, raised): (Python<'_>, &Call, &Raised),
    stepper: &mut dyn Stepper<C>,
    mut course: Course<'_>,
    mut sample: impl FnMut(&Snapshot<'_, C>) + Send,
    mut observe: impl FnMut(&Snapshot<'_, C>) -> PyResult<ControlFlow<()>> + Send,
) -> Result<RunReport, Ended> {
    let progress = &mut course.progress;
    let (ended, report) = call.detach(py, || {
        let mut ended = None;
        let mut looked = Instant::now();
        let look = |at: Snapshot<'_, C>| {
            let mut look = || {
                if let Some(error) = raised.take() {
                    return Err(error);
                }
                let flow = observe(&at)?;
                if let Some(progress) = progress {
                    progress.update(at.time)?;
                }
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
        };
        let report = stepper.run_sampled(course.steps, course.times, |at| sample(&at), look);
        (ended, report)
    });
    if let Some(progress) = course.progress {
        let reached = stepper.snapshot().time;
        progress.finish(py, reached).map_err(Ended::Raised)?;
    }
    // The exception of a function first, whose value has failed the step.
    match raised.take().or(ended) {
        // A function that was not called any more fails its step.
        None if leaving() => Err(Ended::Raised(thread_ends())),
        Some(error) => Err(Ended::Raised(error)),
        None => report.map_err(Ended::Failed),
    }
}

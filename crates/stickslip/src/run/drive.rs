//! The loop over steps.

use std::ops::ControlFlow;

use super::controller::Controller;
use super::crossing::Crossing;
use super::pace::{Hopeless, Pace};
use super::steps::{Adaptive, StepSize};
use super::{Ended, RunReport, Stepper, Steps};
use crate::{ControlState, Failure, Snapshot, StepError};

/// The part of the distance to a stop that rounding may take.
const SLACK: f64 = 1e-9;

/// Shows an accepted step; ends the run on a break.
type Observer<'a, const C: usize> = dyn FnMut(Snapshot<'_, C>) -> ControlFlow<()> + 'a;

/// Takes the steps of a plan.
pub(super) fn drive<S: Stepper<C> + ?Sized, const C: usize>(
    stepper: &mut S,
    steps: &Steps,
    mut crossing: Option<Crossing<'_, C>>,
    observe: &mut Observer<'_, C>,
) -> Result<RunReport, Failure> {
    let at = stepper.snapshot();
    let refused = |cause| Failure {
        step: at.step + 1,
        time: at.time,
        cause,
    };
    steps.validate(at.time).map_err(refused)?;
    if let StepSize::Adaptive(adaptive) = &steps.size {
        stepper.check_control(&adaptive.control).map_err(refused)?;
    }
    if let Some(crossing) = &crossing {
        crossing.validate().map_err(refused)?;
    }
    let mut progress = Progress::new(steps);
    // A size, or what finds it.
    let (constant, mut adapting) = match &steps.size {
        StepSize::Constant(dt) => (*dt, None),
        StepSize::Adaptive(adaptive) => {
            let first = 1e-6 * progress.span(at.time);
            let order = stepper.error_order(&adaptive.control);
            let remembered = at.state().control;
            let adapting = Adapting {
                adaptive,
                controller: Controller::new(adaptive, remembered, first, order),
                pace: Pace::new(adaptive.max_steps),
                end: match steps.until {
                    Some(end) if crossing.is_none() => end,
                    _ => f64::NAN,
                },
            };
            (f64::NAN, Some(adapting))
        }
    };
    if let Some(crossing) = &mut crossing {
        crossing.start(stepper);
    }
    loop {
        let at = stepper.snapshot();
        let left = match progress.ahead(&at) {
            Ok(left) => left,
            Err(ended) => return Ok(progress.finish(ended)),
        };
        if let Some(crossing) = &mut crossing {
            crossing.keep(at.state());
        }
        let taken = match &mut adapting {
            None => {
                let taken = if constant >= left * (1.0 - SLACK) {
                    left.min(constant)
                } else {
                    constant
                };
                if let Err(failure) = stepper.step(taken) {
                    if !steps.bridging || crossing.is_some() {
                        return Err(failure);
                    }
                    progress.report.bridged += 1;
                    if bridge(stepper, taken, observe)?.is_break() {
                        progress.accept(taken);
                        return Ok(progress.finish(Ended::Observer));
                    }
                }
                stepper.remember(ControlState::default());
                taken
            }
            Some(adapting) => match adapting.step(stepper, &mut progress.report, left)? {
                Some(taken) => taken,
                None => continue,
            },
        };
        progress.accept(taken);
        if let Some(crossing) = &mut crossing
            && crossing.is_passed(stepper)
        {
            crossing.locate(stepper, taken, &steps.size)?;
            let _ = observe(stepper.snapshot());
            return Ok(progress.finish(Ended::Crossing));
        }
        if observe(stepper.snapshot()).is_break() {
            return Ok(progress.finish(Ended::Observer));
        }
    }
}

/// The smallest part of a step that bridges it.
const SMALLEST_PART: f64 = 1.0 / 1024.0;

/// Takes a step that failed in parts: halves of what failed, doubled again where two in a row succeed. All parts
/// but the last are shown.
fn bridge<S: Stepper<C> + ?Sized, const C: usize>(
    stepper: &mut S,
    dt: f64,
    observe: &mut Observer<'_, C>,
) -> Result<ControlFlow<()>, Failure> {
    let until = stepper.snapshot().state().clock.after(dt).time();
    let (mut part, mut in_a_row) = (0.5 * dt, 0);
    loop {
        let left = stepper.snapshot().state().clock.left(until);
        let last = part >= left * (1.0 - SLACK);
        match stepper.step(if last { left } else { part }) {
            Ok(_) if last => return Ok(ControlFlow::Continue(())),
            Ok(_) => {
                if observe(stepper.snapshot()).is_break() {
                    return Ok(ControlFlow::Break(()));
                }
                in_a_row += 1;
                if in_a_row % 2 == 0 {
                    part *= 2.0;
                }
            }
            Err(failure) => {
                (part, in_a_row) = (0.5 * part.min(left), 0);
                if part < SMALLEST_PART * dt {
                    return Err(failure);
                }
            }
        }
    }
}

/// Adaptive steps under way.
struct Adapting<'a> {
    adaptive: &'a Adaptive,
    controller: Controller<'a>,
    pace: Pace,
    /// The end that is to be reached \[s\]; not a number if the run may well end before.
    end: f64,
}

impl Adapting<'_> {
    /// One step of at most `left`; none if it was taken back.
    fn step<S: Stepper<C> + ?Sized, const C: usize>(
        &mut self,
        stepper: &mut S,
        report: &mut RunReport,
        left: f64,
    ) -> Result<Option<f64>, Failure> {
        let at = stepper.snapshot();
        let (step, time) = (at.step + 1, at.time);
        let taken = report.accepted + report.rejected + report.failed;
        self.go_on(taken, time)
            .map_err(|cause| Failure { step, time, cause })?;
        let Self {
            adaptive,
            controller,
            pace,
            ..
        } = self;
        let dt = controller.planned();
        // Neither beyond a stop nor to a sliver before it.
        let taken = if dt >= left * (1.0 - SLACK) {
            left
        } else if 2.0 * dt > left {
            0.5 * left
        } else {
            dt
        };
        let local = match stepper.step_estimated(taken, &adaptive.control) {
            Ok(local) => local,
            Err(failure) => {
                report.failed += 1;
                controller.fail(taken, &failure.cause);
                if controller.is_too_small(time) {
                    return Err(failure);
                }
                if pace.has_failed(report.failed) {
                    let cause = StepError::TooManyFailures {
                        failed: report.failed,
                        steps: report.accepted + report.rejected + report.failed,
                        cause: Box::new(failure.cause),
                    };
                    return Err(Failure { step, time, cause });
                }
                pace.fail(failure.cause);
                return Ok(None);
            }
        };
        let error = local.largest() / adaptive.tolerance;
        if error <= 1.0 {
            pace.step(taken, local);
            let control = controller.accept(taken, error);
            stepper.remember(control);
            return Ok(Some(taken));
        }
        stepper.undo();
        report.rejected += 1;
        pace.step(0.0, local);
        controller.reject(taken, error);
        if controller.is_too_small(time) {
            let dt = controller.planned();
            let cause = StepError::StepTooSmall {
                dt,
                error: local,
                tolerance: adaptive.tolerance,
                resisted: stepper.is_resisted(),
            };
            let time = time + dt;
            return Err(Failure { step, time, cause });
        }
        Ok(None)
    }

    /// Gives a run up that has taken all its steps, or will have before its end.
    fn go_on(&mut self, steps: usize, time: f64) -> Result<(), StepError> {
        let max_steps = self.adaptive.max_steps;
        if steps >= max_steps {
            return Err(StepError::TooManySteps {
                steps,
                dt: self.controller.planned(),
                limit: self.pace.limit(&self.controller),
            });
        }
        match self.pace.judge(steps, self.end - time) {
            Some(Hopeless { dt, needed }) => Err(StepError::TooSlow {
                steps,
                dt,
                end: self.end,
                needed,
                max_steps,
                limit: self.pace.limit(&self.controller),
            }),
            None => Ok(()),
        }
    }
}

/// How far a run has come.
struct Progress<'a> {
    steps: &'a Steps,
    /// The first stop that is not yet reached.
    stop: usize,
    report: RunReport,
}

impl<'a> Progress<'a> {
    fn new(steps: &'a Steps) -> Self {
        Self {
            steps,
            stop: 0,
            report: RunReport {
                ended: Ended::Time,
                accepted: 0,
                rejected: 0,
                failed: 0,
                bridged: 0,
                step_range: [f64::INFINITY, 0.0],
            },
        }
    }

    /// The time that a run takes, or something like it.
    fn span(&self, time: f64) -> f64 {
        let stop = self.steps.stops.iter().find(|&&stop| stop > time);
        match (self.steps.until, stop) {
            (Some(end), _) => end - time,
            (_, Some(stop)) => stop - time,
            _ => 1.0,
        }
    }

    /// The time left to the next stop or to the end \[s\], or that the end is reached.
    fn ahead<const C: usize>(&mut self, at: &Snapshot<'_, C>) -> Result<f64, Ended> {
        let time = at.time;
        if (self.steps.count).is_some_and(|count| self.report.accepted >= count) {
            return Err(Ended::Count);
        }
        let reached = |stop: f64| stop <= time + f64::EPSILON * time.abs();
        while (self.steps.stops.get(self.stop)).is_some_and(|&stop| reached(stop)) {
            self.stop += 1;
        }
        let end = self.steps.until.unwrap_or(f64::INFINITY);
        let target = self
            .steps
            .stops
            .get(self.stop)
            .map_or(end, |stop| stop.min(end));
        if target.is_infinite() {
            return Ok(f64::INFINITY);
        }
        let left = at.state().clock.left(target);
        // What rounding leaves of the way to the end is none.
        let resolution = f64::EPSILON * time.abs().max(target.abs());
        let sliver = match self.steps.size {
            StepSize::Constant(dt) => SLACK * dt,
            StepSize::Adaptive(_) => SLACK * left.abs(),
        };
        if time >= end || target == end && left <= sliver.max(resolution) {
            return Err(Ended::Time);
        }
        Ok(left)
    }

    fn accept(&mut self, taken: f64) {
        self.report.accepted += 1;
        let [smallest, largest] = self.report.step_range;
        self.report.step_range = [smallest.min(taken), largest.max(taken)];
    }

    fn finish(mut self, ended: Ended) -> RunReport {
        self.report.ended = ended;
        self.report
    }
}

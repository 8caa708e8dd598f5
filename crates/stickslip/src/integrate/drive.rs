//! The loop over steps.

use std::ops::ControlFlow;

use stickslip_core::compiled;

use super::controller::Controller;
use super::crossing::Crossing;
use super::progress::Progress;
use super::sampling::Sampling;
use super::steps::{Adaptive, Constant, StepSize};
use super::{RunReport, Stepper, Steps, StopReason};
use crate::numerics::NUMERICS;
use crate::{ControlState, LocalError, Snapshot, StepError, StepFailure};

/// Shows an accepted step; a break ends the run.
type Observer<'a, const C: usize> = dyn FnMut(Snapshot<'_, C>) -> ControlFlow<()> + 'a;

/// What a run looks for between the ends of its steps.
type Between<'a, const C: usize> = (Option<Crossing<'a, C>>, Option<Sampling<'a, C>>);

compiled! {
    /// Takes the steps of a plan; a failure has its place.
    pub(super) fn drive<C>(
        stepper: &mut dyn Stepper<C>,
        steps: &Steps,
        between: Between<'_, C>,
        observe: &mut Observer<'_, C>,
    ) -> Result<RunReport, StepFailure> {
        let driven = take(stepper, steps, between, observe);
        driven.map_err(|failure| failure.placed(|vertex| stepper.snapshot().place_of(vertex)))
    }
}

fn take<const C: usize>(
    stepper: &mut dyn Stepper<C>,
    steps: &Steps,
    (mut crossing, mut sampling): Between<'_, C>,
    observe: &mut Observer<'_, C>,
) -> Result<RunReport, StepFailure> {
    let known = stepper.snapshot().field_stops();
    let with_known;
    let steps = if known.is_empty() {
        steps
    } else {
        with_known = steps.clone().stopping_at(known);
        &with_known
    };
    stepper.set_stops(&steps.stops);
    let at = stepper.snapshot();
    let refused = |cause| StepFailure::new(at.step + 1, at.time, cause);
    steps.validate(at.time).map_err(refused)?;
    if let StepSize::Adaptive(adaptive) = &steps.size {
        stepper.check_control(&adaptive.control).map_err(refused)?;
    }
    if let Some(crossing) = &crossing {
        crossing.validate().map_err(refused)?;
    }
    if let Some(sampling) = &sampling {
        sampling.validate(at.time).map_err(refused)?;
    }
    let mut progress = Progress::new(steps, at.time);
    let (constant, mut adapting) = match &steps.size {
        StepSize::Constant(constant) => (Some(*constant), None),
        StepSize::Adaptive(adaptive) => {
            let first = 1e-6 * progress.span(at.time);
            let order = stepper.error_order(&adaptive.control);
            let remembered = at.state().control;
            let adapting = Adapting {
                adaptive,
                controller: Controller::new(adaptive, remembered, first, order),
                error: LocalError::default(),
            };
            (None, Some(adapting))
        }
    };
    if let Some(crossing) = &mut crossing {
        crossing.start(stepper)?;
    }
    if let Some(sampling) = &mut sampling {
        sampling.advance(stepper)?;
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
        let taken = match (&mut adapting, constant) {
            (Some(adapting), _) => match adapting.step(stepper, &mut progress.report, left)? {
                Some(taken) => taken,
                None => continue,
            },
            (None, constant) => {
                let Constant { dt, substeps } = constant.unwrap_or_default();
                let taken = if dt >= left * (1.0 - NUMERICS.slack) {
                    left.min(dt)
                } else {
                    dt
                };
                if let Err(failure) = stepper.step(taken) {
                    if !substeps || crossing.is_some() || !failure.cause.may_pass() {
                        return Err(failure);
                    }
                    progress.report.substepped += 1;
                    let count = &mut progress.report.substeps;
                    if split(stepper, (taken, count), sampling.as_mut(), observe)?.is_break() {
                        progress.accept(taken);
                        return Ok(progress.finish(StopReason::Observer));
                    }
                }
                stepper.remember(ControlState::default());
                taken
            }
        };
        progress.accept(taken);
        if let Some(crossing) = &mut crossing
            && crossing.is_passed(stepper)?
        {
            crossing.locate(stepper, taken, &steps.size)?;
            let _ = observe(stepper.snapshot());
            return Ok(progress.finish(StopReason::Crossing));
        }
        if let Some(sampling) = &mut sampling {
            sampling.advance(stepper)?;
        }
        if observe(stepper.snapshot()).is_break() {
            return Ok(progress.finish(StopReason::Observer));
        }
    }
}

/// Takes a failed step in substeps: halves of the failed size, doubled again after two successes in a row. All but the
/// last are shown.
fn split<const C: usize>(
    stepper: &mut dyn Stepper<C>,
    (dt, count): (f64, &mut usize),
    mut sampling: Option<&mut Sampling<'_, C>>,
    observe: &mut Observer<'_, C>,
) -> Result<ControlFlow<()>, StepFailure> {
    let until = stepper.state().clock.after(dt).time();
    let (mut part, mut in_a_row) = (0.5 * dt, 0);
    loop {
        let left = stepper.state().clock.left(until);
        let last = part >= left * (1.0 - NUMERICS.slack);
        match stepper.step(if last { left } else { part }) {
            Ok(_) => {
                *count += 1;
                if last {
                    return Ok(ControlFlow::Continue(()));
                }
                if let Some(sampling) = &mut sampling {
                    sampling.advance(stepper)?;
                }
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
                if part < NUMERICS.smallest_substep * dt {
                    return Err(failure);
                }
            }
        }
    }
}

/// A run with adaptive steps.
struct Adapting<'a> {
    adaptive: &'a Adaptive,
    controller: Controller<'a>,
    /// The error of the last step.
    error: LocalError,
}

impl Adapting<'_> {
    /// One step of at most `left`; none if it was rejected.
    fn step<const C: usize>(
        &mut self,
        stepper: &mut dyn Stepper<C>,
        report: &mut RunReport,
        left: f64,
    ) -> Result<Option<f64>, StepFailure> {
        let Self {
            adaptive,
            controller,
            error,
        } = self;
        let clock = stepper.state().clock;
        let dt = controller.planned();
        let refused = |cause| StepFailure::of(&clock.after(dt), cause);
        let steps = report.accepted + report.rejected + report.failed;
        if steps >= adaptive.max_steps {
            let limit = controller.limit(*error, stepper.stable_step());
            return Err(refused(StepError::TooManySteps { steps, dt, limit }));
        }
        if controller.is_too_small(&clock) {
            let limits = (stepper.stable_step(), stepper.is_resisted());
            return Err(refused(controller.too_small(*error, limits)));
        }
        // Neither beyond a stop nor to a sliver before it.
        let taken = if dt >= left * (1.0 - NUMERICS.slack) {
            left
        } else if 2.0 * dt > left {
            0.5 * left
        } else {
            dt
        };
        match stepper.step_estimated(taken, &adaptive.control) {
            Ok(found) => *error = found,
            Err(failure) => {
                report.failed += 1;
                controller.fail(taken, &failure.cause);
                let over = controller.is_too_small(&clock) || !failure.cause.may_pass();
                return if over { Err(failure) } else { Ok(None) };
            }
        }
        let size = error.largest() / adaptive.tolerance;
        if size <= 1.0 {
            stepper.remember(controller.accept(taken, size));
            return Ok(Some(taken));
        }
        stepper.undo();
        report.rejected += 1;
        controller.reject(taken, size);
        if controller.is_too_small(&clock) {
            let limits = (stepper.stable_step(), stepper.is_resisted());
            return Err(refused(controller.too_small(*error, limits)));
        }
        Ok(None)
    }
}

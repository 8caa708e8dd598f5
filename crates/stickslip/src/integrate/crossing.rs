//! Event location: the time of a zero crossing, found by repeated steps of other sizes.

use super::Stepper;
use super::steps::StepSize;
use crate::{Snapshot, StepError, StepFailure, StepState};

/// A value of an accepted step.
type Value<'a, const C: usize> = dyn FnMut(Snapshot<'_, C>) -> f64 + 'a;

/// The upward zero crossing of a value, to a tolerance in time \[s\].
pub(super) struct Crossing<'a, const C: usize> {
    pub(super) tolerance: f64,
    pub(super) value: &'a mut Value<'a, C>,
    pub(super) last: f64,
    /// The state at the start of the current step; allocated on first use.
    pub(super) before: Option<StepState<C>>,
}

/// The maximum number of trials: more bracket a crossing below the resolution of time.
const MAX_TRIALS: usize = 100;

impl<const C: usize> Crossing<'_, C> {
    pub(super) fn validate(&self) -> Result<(), StepError> {
        if self.tolerance > 0.0 {
            return Ok(());
        }
        Err(StepError::Control {
            what: "tolerance of a crossing",
            requirement: "positive",
            value: self.tolerance,
        })
    }

    /// Evaluates the value at the start of the run.
    pub(super) fn start(&mut self, stepper: &dyn Stepper<C>) -> Result<(), StepFailure> {
        self.last = self.evaluate(stepper)?;
        Ok(())
    }

    /// The value of the last accepted step; refused if it is not a number, which no crossing could be seen by.
    fn evaluate(&mut self, stepper: &dyn Stepper<C>) -> Result<f64, StepFailure> {
        let value = (self.value)(stepper.snapshot());
        if value.is_nan() {
            let cause = StepError::Control {
                what: "value of a crossing",
                requirement: "a number",
                value,
            };
            return Err(StepFailure::of(&stepper.state().clock, cause));
        }
        Ok(value)
    }

    /// Stores the state at the start of the next step.
    pub(super) fn keep(&mut self, state: &StepState<C>) {
        match &mut self.before {
            Some(before) => before.copy_from(state),
            None => self.before = Some(state.clone()),
        }
    }

    /// Whether the value passed zero from below in the last step.
    pub(super) fn is_passed(&mut self, stepper: &dyn Stepper<C>) -> Result<bool, StepFailure> {
        let now = self.evaluate(stepper)?;
        let passed = self.last < 0.0 && now >= 0.0;
        if !passed {
            self.last = now;
        }
        Ok(passed)
    }

    /// Shortens the last step, of `taken`, to end at the crossing, by the Illinois variant of the secant method, which
    /// preserves the bracket.
    pub(super) fn locate(
        &mut self,
        stepper: &mut dyn Stepper<C>,
        taken: f64,
        size: &StepSize,
    ) -> Result<(), StepFailure> {
        let control = stepper.snapshot().state().control;
        let (mut low, mut low_value) = (0.0, self.last);
        let (mut high, mut high_value) = (taken, self.evaluate(stepper)?);
        let mut reached = taken;
        for trial in 0..MAX_TRIALS {
            if high - low <= self.tolerance {
                break;
            }
            let secant = low + (high - low) * low_value / (low_value - high_value);
            let margin = 0.5 * self.tolerance.min(0.5 * (high - low));
            let dt = if trial % 4 == 3 || !secant.is_finite() {
                0.5 * (low + high)
            } else {
                secant.clamp(low + margin, high - margin)
            };
            if !(low < dt && dt < high) {
                break;
            }
            self.retake(stepper, dt, size)?;
            reached = dt;
            let value = self.evaluate(stepper)?;
            if value < 0.0 {
                (low, low_value) = (dt, value);
                high_value *= 0.5;
            } else {
                (high, high_value) = (dt, value);
                low_value *= 0.5;
            }
        }
        if reached != high {
            self.retake(stepper, high, size)?;
        }
        // The run goes on with the step it had planned.
        stepper.remember(control);
        Ok(())
    }

    fn retake(
        &self,
        stepper: &mut dyn Stepper<C>,
        dt: f64,
        size: &StepSize,
    ) -> Result<(), StepFailure> {
        if let Some(before) = &self.before {
            // A state of this very stepper fits.
            let _ = stepper.restore(before);
        }
        match size {
            StepSize::Constant(_) => stepper.step(dt).map(|_| ()),
            StepSize::Adaptive(adaptive) => {
                stepper.step_estimated(dt, &adaptive.control).map(|_| ())
            }
        }
    }
}

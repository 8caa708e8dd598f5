//! Times between the ends of steps at which a run is shown.

use super::Stepper;
use crate::{Snapshot, StepError, StepFailure};

/// Times \[s\] in increasing order, and the function that sees the motion there.
pub(super) struct Sampling<'a, const C: usize> {
    pub(super) times: &'a [f64],
    pub(super) show: &'a mut (dyn FnMut(Snapshot<'_, C>) + 'a),
}

impl<const C: usize> Sampling<'_, C> {
    /// Refuses times that are not numbers, decrease, or lie before the present time.
    pub(super) fn validate(&self, now: f64) -> Result<(), StepError> {
        let mut last = now;
        for &value in self.times {
            if !(value >= last && value.is_finite()) {
                return Err(StepError::Control {
                    what: "time of a sample",
                    requirement: "finite, and not before the present time or the one before it",
                    value,
                });
            }
            last = value;
        }
        Ok(())
    }

    /// Shows the times up to the present one: those at the end of a step by it, others inside of the last step. A method
    /// without an extension into its steps ends them there.
    pub(super) fn advance(&mut self, stepper: &mut dyn Stepper<C>) -> Result<(), StepFailure> {
        let now = stepper.state().clock.time();
        let reached = now + f64::EPSILON * now.abs();
        let count = self.times.partition_point(|&time| time <= reached);
        let (passed, ahead) = self.times.split_at(count);
        self.times = ahead;
        let inside = if stepper.is_dense() {
            let inside = passed.partition_point(|&time| time < now);
            if inside > 0 {
                stepper.show_inside(&passed[..inside], &mut *self.show)?;
            }
            inside
        } else {
            0
        };
        for _ in &passed[inside..] {
            (self.show)(stepper.snapshot());
        }
        Ok(())
    }
}

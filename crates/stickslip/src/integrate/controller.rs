//! Step-size control by the errors of the last steps.

use super::steps::Adaptive;
use crate::numerics::NUMERICS;
use crate::{Clock, ControlState, Limit, LocalError, StepError};

/// A proportional-integral controller that remembers a trend.
pub(super) struct Controller<'a> {
    adaptive: &'a Adaptive,
    /// The planned step, the last one and its error over the tolerance.
    state: ControlState,
    exponent: f64,
    /// The error estimate has already computed the first half of a step.
    halves: bool,
    /// The largest stable step of the scheme \[s\], as reported by a failed one.
    stable: f64,
}

impl<'a> Controller<'a> {
    /// Continues from the memory of an earlier run, or begins with `first`.
    pub(super) fn new(
        adaptive: &'a Adaptive,
        remembered: ControlState,
        first: f64,
        error_order: usize,
    ) -> Self {
        let mut state = remembered;
        if state.next_step <= 0.0 {
            state = ControlState {
                next_step: adaptive.first_step.unwrap_or(first),
                last_step: f64::NAN,
                last_error: NUMERICS.safety,
                ..state
            };
        }
        state.next_step = state.next_step.clamp(adaptive.min_step, adaptive.max_step);
        Self {
            adaptive,
            state,
            exponent: 1.0 / error_order as f64,
            halves: error_order <= 3,
            stable: f64::INFINITY,
        }
    }

    /// The planned step \[s\].
    pub(super) fn planned(&self) -> f64 {
        self.state.next_step
    }

    /// Plans the step after one of `taken` with an error of at most the tolerance; `error` is over it.
    pub(super) fn accept(&mut self, taken: f64, error: f64) -> ControlState {
        let ControlState {
            next_step,
            last_step,
            last_error,
            ..
        } = self.state;
        let size = leading(error.max(1e-8));
        let power = |ratio: f64, share: f64| ratio.powf(share * self.exponent);
        // Steps that have to shrink again and again, as before an event: the trend goes on.
        let trend = (taken / last_step) * power(NUMERICS.safety * last_error / (size * size), 1.0);
        let ratio = if !self.adaptive.quantised {
            let damped =
                power(NUMERICS.safety / size, 0.7) * power(last_error / NUMERICS.safety, 0.4);
            damped.min(trend.max(NUMERICS.shrink))
        } else if trend < 1.0 {
            trend
        } else {
            // A step that keeps its size has no part of its growth behind it: the whole of it counts.
            let whole = power(NUMERICS.safety_of_twice / size, 1.0);
            whole.min(trend).max(1.0)
        };
        let next = self.quantise(taken * ratio.clamp(NUMERICS.shrink, NUMERICS.growth), taken);
        // A step cut short by a stop says nothing against the size that was planned.
        let planned = if taken < next_step {
            // Nor is its size one of those that go on.
            let quantised = self.adaptive.quantised;
            if quantised {
                next_step
            } else {
                next.max(next_step)
            }
        } else {
            next
        };
        // A step that has grown as much as it may has an error that says nothing of a trend.
        let least = NUMERICS.safety * NUMERICS.growth.powf(-self.exponent.recip());
        let remembered = if self.adaptive.quantised {
            size.max(least)
        } else {
            size
        };
        self.state = ControlState {
            next_step: self.bounded(planned, taken).max(self.adaptive.min_step),
            last_step: taken,
            last_error: remembered,
            ..self.state
        };
        self.state
    }

    /// Plans a smaller step after one of `taken` whose error exceeds the tolerance.
    pub(super) fn reject(&mut self, taken: f64, error: f64) {
        let ratio = (NUMERICS.safety / leading(error)).powf(self.exponent);
        let ratio = if ratio.is_finite() {
            ratio
        } else {
            NUMERICS.shrink
        };
        // Of a step taken in two halves the first is known, and is the step to try next.
        let shorter = if self.halves && ratio > 0.25 {
            0.5
        } else {
            ratio.clamp(NUMERICS.shrink, NUMERICS.safety)
        };
        self.state.next_step = self.quantise(taken * shorter, self.base(taken));
    }

    /// Plans a step of half the size after one of `taken` that failed, or the largest stable one.
    pub(super) fn fail(&mut self, taken: f64, cause: &StepError) {
        if let &StepError::Unstable { limit, .. } = cause {
            self.stable = limit;
            self.state.next_step = self.bounded(taken, taken);
        } else {
            self.state.next_step = self.quantise(0.5 * taken, self.base(taken));
        }
    }

    /// The size from which the steps after one of `taken` differ by powers of two; not that of a shortened step.
    fn base(&self, taken: f64) -> f64 {
        self.state.next_step.max(taken)
    }

    /// A step of `dt` within the bounds of plan and scheme.
    fn bounded(&self, dt: f64, base: f64) -> f64 {
        let dt = dt.min(self.adaptive.max_step);
        if dt > self.stable {
            self.quantise(self.stable, base)
        } else {
            dt
        }
    }

    /// The limit of the planned step: a bound, or the last error. The error keeps an explicit method at its largest stable
    /// step, if it has one, to the share that the control aims at.
    pub(super) fn limit(&self, error: LocalError, stable: Option<f64>) -> Limit {
        let Adaptive {
            max_step,
            quantised,
            ..
        } = *self.adaptive;
        let next = if quantised { 2.0 } else { 1.0 } * self.state.next_step;
        let reached = next.max(self.state.last_step);
        if self.state.next_step >= max_step {
            Limit::LargestStep(max_step)
        } else if next >= self.stable {
            Limit::Stability(self.stable)
        } else if let Some(stable) = stable.filter(|stable| reached >= NUMERICS.safety * stable) {
            Limit::Stability(stable)
        } else {
            Limit::Error(error)
        }
    }

    /// Whether the planned step is below the bound, its square underflows, or it does not advance the clock.
    pub(super) fn is_too_small(&self, clock: &Clock) -> bool {
        let dt = self.state.next_step;
        dt < self.adaptive.min_step.max(f64::MIN_POSITIVE.sqrt())
            || clock.after(dt).time() == clock.time()
    }

    /// The error of a planned step that is too small, by the largest stable step, if any, and whether the scene is resisted.
    pub(super) fn too_small(
        &self,
        error: LocalError,
        (stable, resisted): (Option<f64>, bool),
    ) -> StepError {
        let dt = self.adaptive.min_step;
        if let Some(limit) = stable.filter(|&stable| stable < dt) {
            return StepError::Unstable { dt, limit };
        }
        StepError::StepTooSmall {
            dt: self.state.next_step,
            error,
            tolerance: self.adaptive.tolerance,
            resisted,
        }
    }

    /// The largest size below `dt` that is a power of two times `base`, if requested.
    fn quantise(&self, dt: f64, base: f64) -> f64 {
        if self.adaptive.quantised {
            base * (dt / base).log2().floor().exp2()
        } else {
            dt
        }
    }
}

/// The ten leading bits of an error: the estimate is truncated so that rounding cannot change dt, also in other units.
fn leading(error: f64) -> f64 {
    f64::from_bits(error.to_bits() & (!0 << 42))
}

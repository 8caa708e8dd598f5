//! The next step by the errors of the last ones.

use super::limit::Limit;
use super::steps::Adaptive;
use crate::{ControlState, StepError};

/// The share of the tolerance that a step aims at.
const SAFETY: f64 = 0.8;
/// The same for a step that grows to twice the size at once.
const SAFETY_OF_TWICE: f64 = 0.5;
/// The smallest step, at the start of time, too \[s\]: accelerations are divided by its square.
const SMALLEST: f64 = 1e-150;
/// The largest and the smallest ratio of successive steps.
const GROWTH: f64 = 4.0;
const SHRINK: f64 = 0.1;
/// What is left of a step that failed.
const AFTER_FAILURE: f64 = 0.25;

/// A proportional-integral controller with a memory for a trend.
pub(super) struct Controller<'a> {
    adaptive: &'a Adaptive,
    /// The planned step, the last one and its error over the tolerance.
    state: ControlState,
    exponent: f64,
    /// The first half of a step is known from the error estimate.
    halves: bool,
    /// The largest step that the scheme bears \[s\], as far as one that failed has told.
    stable: f64,
}

impl<'a> Controller<'a> {
    /// Goes on from what an earlier run remembers, or begins with `first`.
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
                last_error: SAFETY,
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

    /// The step that is planned \[s\].
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
        let trend = (taken / last_step) * power(SAFETY * last_error / (size * size), 1.0);
        let ratio = if !self.adaptive.quantised {
            let damped = power(SAFETY / size, 0.7) * power(last_error / SAFETY, 0.4);
            damped.min(trend.max(SHRINK))
        } else if trend < 1.0 {
            trend
        } else {
            // A step that keeps its size has no part of its growth behind it: the whole of it counts.
            let whole = power(SAFETY_OF_TWICE / size, 1.0);
            whole.min(trend).max(1.0)
        };
        let next = self.quantise(taken * ratio.clamp(SHRINK, GROWTH), taken);
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
        let least = SAFETY * GROWTH.powf(-self.exponent.recip());
        let remembered = if self.adaptive.quantised {
            size.max(least)
        } else {
            size
        };
        self.state = ControlState {
            next_step: self.bounded(planned, taken),
            last_step: taken,
            last_error: remembered,
            ..self.state
        };
        self.state
    }

    /// Plans a smaller step after one of `taken` with too large an error.
    pub(super) fn reject(&mut self, taken: f64, error: f64) {
        let ratio = (SAFETY / leading(error)).powf(self.exponent);
        let ratio = if ratio.is_finite() { ratio } else { SHRINK };
        // Of a step taken in two halves the first is known, and is the step to try next.
        let shorter = if self.halves && ratio > 0.25 {
            0.5
        } else {
            ratio.clamp(SHRINK, SAFETY)
        };
        self.state.next_step = self.quantise(taken * shorter, self.base(taken));
    }

    /// Plans a smaller step after one of `taken` that failed.
    pub(super) fn fail(&mut self, taken: f64, cause: &StepError) {
        if let &StepError::Unstable { limit, .. } = cause {
            self.stable = limit;
            self.state.next_step = self.bounded(taken, taken);
        } else {
            self.state.next_step = self.quantise(AFTER_FAILURE * taken, self.base(taken));
        }
    }

    /// The size that those after one of `taken` are to differ from by powers of two: not that of a step cut short.
    fn base(&self, taken: f64) -> f64 {
        self.state.next_step.max(taken)
    }

    /// What the plan and the scheme bear of a step of `dt`.
    fn bounded(&self, dt: f64, base: f64) -> f64 {
        let dt = dt.min(self.adaptive.max_step);
        if dt > self.stable {
            self.quantise(self.stable, base)
        } else {
            dt
        }
    }

    /// What bounds the planned step, if the error does not.
    pub(super) fn bound(&self) -> Option<Limit> {
        let Adaptive {
            max_step,
            quantised,
            ..
        } = *self.adaptive;
        let next = if quantised { 2.0 } else { 1.0 } * self.state.next_step;
        if self.state.next_step >= max_step {
            Some(Limit::LargestStep(max_step))
        } else if next >= self.stable {
            Some(Limit::Stability(self.stable))
        } else {
            None
        }
    }

    /// Whether the planned step is below the bound, or below what the time or forces of inertia resolve.
    pub(super) fn is_too_small(&self, time: f64) -> bool {
        let dt = self.state.next_step;
        dt < self.adaptive.min_step.max(SMALLEST) || dt <= 16.0 * f64::EPSILON * time.abs()
    }

    /// The largest size below `dt` that is a power of two times `base`, if asked for.
    fn quantise(&self, dt: f64, base: f64) -> f64 {
        if self.adaptive.quantised {
            base * (dt / base).log2().floor().exp2()
        } else {
            dt
        }
    }
}

/// The ten leading bits of an error: its rounding moves no step, and a run in other units takes the same ones.
fn leading(error: f64) -> f64 {
    f64::from_bits(error.to_bits() & (!0 << 42))
}

//! What several tests use.

use proptest::prelude::*;
use stickslip_state::{StateError, StateLaw, Theta};

/// A user's law, `theta' = 1 - (V theta / 2L)^2`, without closed forms.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PerrinRiceZheng {
    pub(crate) slip_distance: f64,
}

impl StateLaw for PerrinRiceZheng {
    type State = Theta;

    fn evolution(&self, Theta(theta): Theta, slip_rate: f64) -> f64 {
        let x = slip_rate * theta / (2.0 * self.slip_distance);
        1.0 - x * x.abs()
    }

    fn evolution_slope(&self, Theta(theta): Theta, slip_rate: f64) -> f64 {
        let rate = slip_rate / (2.0 * self.slip_distance);
        -2.0 * theta.abs() * rate * rate
    }

    fn validate(&self) -> Result<(), StateError> {
        StateError::check_positive("slip_distance", self.slip_distance)
    }
}

/// A positive number with uniform exponent.
pub(crate) fn decades(range: std::ops::Range<f64>) -> impl Strategy<Value = f64> {
    range.prop_map(|e| 10f64.powf(e))
}

/// A logarithm of the state, ordinary or extreme.
pub(crate) fn log_theta() -> impl Strategy<Value = f64> {
    prop_oneof![-800.0..800.0, -20.0..20.0]
}

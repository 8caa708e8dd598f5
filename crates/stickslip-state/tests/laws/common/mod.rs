//! The helpers of several tests.

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

    fn evolution_state_slope(&self, Theta(theta): Theta, slip_rate: f64) -> f64 {
        let rate = slip_rate / (2.0 * self.slip_distance);
        -2.0 * theta.abs() * rate * rate
    }

    fn validate(&self) -> Result<(), StateError> {
        StateError::check_positive("slip_distance", self.slip_distance)
    }
}

/// The law without its closed forms.
#[derive(Clone, Copy, Debug)]
pub(crate) struct WithoutExact<T>(pub(crate) T);

impl<T: StateLaw> StateLaw for WithoutExact<T> {
    type State = T::State;

    fn evolution(&self, state: T::State, slip_rate: f64) -> f64 {
        self.0.evolution(state, slip_rate)
    }

    fn evolution_state_slope(&self, state: T::State, slip_rate: f64) -> f64 {
        self.0.evolution_state_slope(state, slip_rate)
    }
}

/// So many random cases, unless `PROPTEST_CASES` asks for another number.
pub(crate) fn cases(cases: u32) -> ProptestConfig {
    let asked = ProptestConfig::default();
    if std::env::var_os("PROPTEST_CASES").is_some() {
        return asked;
    }
    ProptestConfig { cases, ..asked }
}

/// A positive number with uniform exponent.
pub(crate) fn decades(range: std::ops::Range<f64>) -> impl Strategy<Value = f64> {
    range.prop_map(|e| 10f64.powf(e))
}

/// A logarithm of the state, ordinary or extreme.
pub(crate) fn log_theta() -> impl Strategy<Value = f64> {
    prop_oneof![-800.0..800.0, -20.0..20.0]
}

//! The helpers of several tests.

use proptest::prelude::*;
use stickslip_friction::{DieterichRuina, FrictionLaw};

/// The parameters of the paper's slider.
pub(crate) const SLIDER: DieterichRuina = DieterichRuina {
    a: 0.010,
    b: 0.015,
    reference_friction: 0.6,
    reference_velocity: 1e-6,
    slip_distance: 1e-5,
};

/// The law with the defaults of the trait in place of its closed forms.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Generic<T>(pub(crate) T);

impl<T: FrictionLaw> FrictionLaw for Generic<T> {
    type State = T::State;

    fn coefficient(&self, slip_rate: f64, state: Self::State) -> f64 {
        self.0.coefficient(slip_rate, state)
    }

    fn coefficient_rate_slope(&self, slip_rate: f64, state: Self::State) -> f64 {
        self.0.coefficient_rate_slope(slip_rate, state)
    }

    fn potential(&self, slip_rate: f64, state: Self::State) -> f64 {
        self.0.potential(slip_rate, state)
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

/// The admissible error of the default of `coefficient_state_slope` at a state with this slope and coefficient, if the
/// coefficient is known up to `noise`.
///
/// The difference has a step `h` of at least 6e-6 times the size of the state, or of 1 if that is less. It is
/// returned once the coefficient answers by `2 h slope >= 1e-7 coefficient - 2 noise`, or at a step of at least 6e-6.
pub(crate) fn default_slope_error(state: f64, (slope, coefficient): (f64, f64), noise: f64) -> f64 {
    let smallest = 6e-6
        * if state == 0.0 {
            1.0
        } else {
            state.abs().min(1.0)
        };
    let answer = 1e-7 * coefficient - 2.0 * noise;
    let answered = if answer > 0.0 {
        2.0 * noise * slope / answer
    } else {
        f64::INFINITY
    };
    (noise / smallest).min(answered).max(noise / 6e-6) + 4.0 * f64::EPSILON * slope
}

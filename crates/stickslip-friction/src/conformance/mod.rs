//! The contracts of friction laws and potentials, as checks of any implementation.

mod coefficient;
mod many_nodes;
mod minimizer;
mod potential;
mod sample;
mod samples;
mod slip_rate;
mod violation;
mod worst;

use stickslip_state::StateVariable;

use crate::{ConvexPotential, FrictionError, FrictionLaw};

pub use many_nodes::check_slip_rates;
pub use sample::sample_friction_law;
pub use violation::FrictionViolation;

/// The slip rates of the checks \[m/s\]: rates of motion, rest, and numbers next to it.
///
/// Those of the laboratory come first: a violation quotes one of them if possible.
const SLIP_RATES: [f64; 14] = [
    1e-6, 1e-4, 1e-2, 1.0, 1e-9, 1e-12, 1e-16, 1e-20, 1e3, 1e6, 1e10, 0.0, 1e-300, 5e-324,
];

/// The number of laboratory rates.
const LABORATORY: usize = 4;

/// Checks a friction law against its contract, at the given states.
///
/// The parameters must be valid; over slip rates from 0 to 1e10 m/s:
///
/// | method | must |
/// | --- | --- |
/// | `coefficient` | be finite, at least 0, and not decrease with the rate |
/// | `coefficient_rate_slope` | be at least 0, agree with differences where those exist |
/// | `coefficient_and_rate_slope`, `response` | agree with each alone, to rounding |
/// | `potential` | be 0 at rest, convex, and the integral of the coefficient |
/// | `coefficient_state_slope` | agree with differences where those exist |
/// | `slip_rate` | be 0 while the contact sticks, and else balance the forces to 4 roundings |
///
/// The unit of the last is the largest force, friction's own terms included: the rounding error of the coefficient from
/// the state and the logarithm of the rate.
///
/// ```
/// use stickslip_friction::{FrictionViolation, Tresca, check_friction_law};
///
/// check_friction_law(&Tresca { coefficient: 0.6 }, &[()])?;
/// # Ok::<(), FrictionViolation>(())
/// ```
///
/// # Errors
///
/// A violation, with the numbers that show it. A wrong sign found by [`sample_friction_law`] comes first. Otherwise it
/// is the first kind of the rest, of the coefficient before that of the potential and of the slip rate, at its worst
/// relative to its size, and at a slip rate of the laboratory if possible.
pub fn check_friction_law<L: FrictionLaw + ?Sized>(
    law: &L,
    states: &[L::State],
) -> Result<(), FrictionViolation> {
    law.validate()?;
    if states.is_empty() {
        let what = "number of states to check the law at";
        FrictionError::check(what, "at least 1", 0.0, false)?;
    }
    sample::check_signs(law, states)?;
    for &state in states {
        coefficient::check_growth(law, state)?;
        potential::check_rest(law, state)?;
    }
    let (laboratory, beyond) = SLIP_RATES.split_at(LABORATORY);
    for check in [coefficient::check, potential::check] {
        check_at(law, states, laboratory, check)?;
        check_at(law, states, beyond, check)?;
    }
    check_at(law, states, laboratory, slip_rate::check)?;
    for &state in states {
        slip_rate::check_drives(law, state)?;
    }
    check_at(law, states, beyond, slip_rate::check)
}

/// The worst violation of a check.
fn check_at<L: FrictionLaw + ?Sized>(
    law: &L,
    states: &[L::State],
    rates: &[f64],
    check: impl Fn(&L, L::State, f64) -> Result<(), FrictionViolation>,
) -> Result<(), FrictionViolation> {
    let at = |&rate: &f64| states.iter().map(move |&state| (state, rate));
    let cases = rates.iter().flat_map(at);
    worst::of(cases.map(|(state, rate)| check(law, state, rate)))
}

/// Checks a convex potential against its contract, at points with speeds 24 decades around
/// `speed` \[m/s\] and against forces 12 decades around `force` \[N\].
///
/// | method | must |
/// | --- | --- |
/// | `value` | be convex along segments |
/// | `slope_along` | bound the value from below, as a subgradient |
/// | `local_model` | have the slopes and, where smooth, the derivatives of the gradient; a symmetric positive semidefinite Hessian |
/// | `minimize` | be optimal to rounding against blocks with a condition number up to 1e3, and beat its neighbours |
/// | `keep_smooth` | shorten a correction, without turning a component around |
///
/// ```
/// use stickslip_friction::{FrictionViolation, Radial, Tresca, check_convex_potential};
///
/// let potential = Radial { law: Tresca { coefficient: 0.6 }, force: 100.0, state: () };
/// check_convex_potential::<_, 2>(&potential, 1e-6, 60.0)?;
/// # Ok::<(), FrictionViolation>(())
/// ```
///
/// # Errors
///
/// The first violation, with the numbers that show it.
pub fn check_convex_potential<P: ConvexPotential<C> + ?Sized, const C: usize>(
    potential: &P,
    speed: f64,
    force: f64,
) -> Result<(), FrictionViolation> {
    samples::check_convexity(potential, speed)?;
    samples::check_local_models(potential, speed)?;
    minimizer::check(potential, speed, force)
}

/// The rounding errors of a coefficient from the state, the logarithm of the rate (up to 30 more for a reference rate)
/// and the result, in units of the precision.
fn coefficient_terms<L: FrictionLaw + ?Sized>(law: &L, slip_rate: f64, state: L::State) -> f64 {
    let by_state = law.coefficient_state_slope(slip_rate, state).abs() * state.value().abs();
    let by_rate = if slip_rate > f64::MIN_POSITIVE {
        slip_rate * law.coefficient_rate_slope(slip_rate, state) * (slip_rate.ln().abs() + 30.0)
    } else {
        0.0
    };
    law.coefficient(slip_rate, state) + by_state + by_rate
}

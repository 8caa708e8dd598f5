//! The contract of a state law, as a check of any law.

mod difference;
mod evolution;
mod exact;
mod many_nodes;
mod sample;
mod step;
mod violation;
mod worst;

use crate::{StateError, StateLaw, StateVariable};

pub use many_nodes::check_evolutions;
pub use sample::sample_state_law;
pub use violation::{StateLawViolation, Step};

/// The slip rates of the checks \[m/s\]: rest, numbers next to it, and rates of motion. They are not round, so laws
/// that jump at round places are not evaluated on the jump itself.
///
/// Those of the laboratory come first: a violation quotes one of them if possible.
const SLIP_RATES: [f64; 15] = [
    1.3e-6, 1.3e-4, 1.3e-2, 1.3, 1.3e-8, 1.3e-10, 1.3e-12, 1.3e-16, 1e-20, 1.3e3, 1.3e6, 1e10, 0.0,
    1e-300, 5e-324,
];

/// The number of laboratory rates.
const LABORATORY: usize = 4;

/// The name of a change by evolution in violations: it concerns steps about a rate, which has no scale of its own.
const CHANGE: &str = "change by evolution";
const SLOPES: [&str; 2] = ["advance_rate_slope", "advance_at_constant_rate_rate_slope"];

/// The time steps of the checks \[s\].
const TIME_STEPS: [f64; 9] = [1e-12, 1e-9, 1e-6, 1e-4, 1e-2, 1.0, 1e2, 1e4, 1e6];

/// Checks a state law against its contract, at the given states and between them.
///
/// The parameters and states must be valid; over slip rates from 0 to 1e10 m/s and time steps from
/// 1e-12 to 1e6 s:
///
/// | method | must |
/// | --- | --- |
/// | `evolution` | be a number, not increase with the state |
/// | `evolution_state_slope` | be at most 0, agree with differences where those exist |
/// | `advance` | succeed, solve backward Euler, preserve order, stand still for `dt = 0`, refuse negative and NaN input |
/// | `advance_exact` | be `None` or finite, compose, follow `evolution`, be the limit of small steps |
/// | `advance_at_constant_rate` | succeed with a finite state |
/// | both slopes of steps | agree with differences of the step where those exist |
///
/// It evaluates a law without closed forms up to 100 000 times per state.
///
/// ```
/// use stickslip_state::{Dieterich, LogTheta, StateLawViolation, check_state_law};
///
/// let states = [LogTheta(-10.0), LogTheta(0.0), LogTheta(10.0)];
/// check_state_law(&Dieterich { slip_distance: 1e-5 }, &states)?;
/// # Ok::<(), StateLawViolation>(())
/// ```
///
/// # Errors
///
/// A violation, with the numbers that show it. A growth found by [`sample_state_law`] comes first. Otherwise it is the
/// first kind of the rest, of the evolution before that of steps, at its worst relative to its size, and at a slip rate
/// of the laboratory if possible.
pub fn check_state_law<T: StateLaw + ?Sized>(
    law: &T,
    states: &[T::State],
) -> Result<(), StateLawViolation> {
    law.validate()?;
    if states.is_empty() {
        let none = StateError::Value {
            what: "number of states to check the law at",
            requirement: "at least 1",
            value: 0.0,
        };
        return Err(none.into());
    }
    for &state in states {
        law.validate_state(state)?;
    }
    sample::check_growth(law, states)?;
    let mut given: Vec<f64> = states.iter().map(|state| state.value()).collect();
    given.sort_by(f64::total_cmp);
    given.dedup();
    let mut dense = given.clone();
    dense.extend(given.windows(2).map(|pair| f64::midpoint(pair[0], pair[1])));
    dense.sort_by(f64::total_cmp);

    step::check_refusals(law, given[0])?;
    let (laboratory, beyond) = SLIP_RATES.split_at(LABORATORY);
    for rates in [laboratory, beyond] {
        worst::of(
            rates
                .iter()
                .map(|&rate| evolution::check(law, &dense, rate)),
        )?;
    }
    for rates in [laboratory, beyond] {
        let steps = rates
            .iter()
            .flat_map(|&rate| TIME_STEPS.map(|dt| (rate, dt)));
        worst::of(steps.map(|(rate, dt)| {
            step::check(law, &given, rate, dt)?;
            exact::check(law, &given, rate, dt)
        }))?;
    }
    Ok(())
}

/// The resolution of a state between `from` and `to`: a few roundings of either, or of 1, the scale of a logarithmic
/// state.
fn resolution(from: f64, to: f64) -> f64 {
    16.0 * f64::EPSILON * (from.abs() + to.abs() + 1.0)
}

/// The rate of a state given by its value.
fn evolution_at<T: StateLaw + ?Sized>(law: &T, value: f64, slip_rate: f64) -> f64 {
    law.evolution(T::State::from_value(value), slip_rate)
}

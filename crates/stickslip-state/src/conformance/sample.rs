//! A quick check: some dozens of evaluations at the slip rates of experiments and faults.

use super::evolution::QUOTIENT;
use super::{StateLawViolation, difference, evolution_at};
use crate::{StateLaw, StateVariable};

/// Rest, creep, laboratory and earthquake rates \[m/s\]. They are not round, so laws that jump at round places are not
/// evaluated on the jump itself.
const SLIP_RATES: [f64; 11] = [
    0.0, 1.3e-20, 1.3e-16, 1.3e-12, 1.3e-10, 1.3e-8, 1.3e-6, 1.3e-4, 1.3e-2, 1.3, 1.3e2,
];

/// The relative rounding error of a rate of the state.
const ROUNDING: f64 = 1e-9;

/// Slip rates for the comparison of the slope with the evolution \[m/s\].
const COMPARED: [f64; 4] = [1.3e-6, 1.3e-2, 1.3e-9, 1.3];

/// The largest relative difference of the slope: rough differences stay below it, a wrong sign, power or unit does not.
const ROUGH: f64 = 0.1;

/// Evaluates a state law at the given states, half and one and a half times their values, and at a dozen slip rates
/// from 0 to 130 m/s, and reports the worst violation of its contract.
///
/// It takes microseconds, and finds the defects that would mislead a simulation: an evolution that is not a number or
/// increases with the state, and, at four of the rates, a slope that differs by a tenth or more from that of the
/// evolution. States that the law refuses are left out. [`check_state_law`](crate::check_state_law) is the whole
/// contract.
///
/// ```
/// use stickslip_state::{Dieterich, LogTheta, StateLawViolation, sample_state_law};
///
/// sample_state_law(&Dieterich { slip_distance: 1e-5 }, &[LogTheta(-10.0)])?;
/// let violation = sample_state_law(&Dieterich { slip_distance: f64::NAN }, &[LogTheta(-10.0)]);
/// assert!(matches!(violation, Err(StateLawViolation::EvolutionNotANumber { .. })));
/// # Ok::<(), StateLawViolation>(())
/// ```
///
/// # Errors
///
/// [`EvolutionNotANumber`](StateLawViolation::EvolutionNotANumber), else
/// [`EvolutionIncreases`](StateLawViolation::EvolutionIncreases) at the largest increase, relative to its size, else
/// [`Slope`](StateLawViolation::Slope).
pub fn sample_state_law<T: StateLaw + ?Sized>(
    law: &T,
    states: &[T::State],
) -> Result<(), StateLawViolation> {
    check_growth(law, states)?;
    let at = |&slip_rate: &f64| states.iter().map(move |state| (state.value(), slip_rate));
    (COMPARED.iter().flat_map(at)).try_for_each(|(state, rate)| compare(law, state, rate))
}

/// The first part of the check, of the evolution alone.
pub(super) fn check_growth<T: StateLaw + ?Sized>(
    law: &T,
    states: &[T::State],
) -> Result<(), StateLawViolation> {
    let mut worst: Option<(f64, StateLawViolation)> = None;
    for &state in states {
        let mut around = [0.5, 1.0, 1.5].map(|factor| factor * state.value());
        around.sort_by(f64::total_cmp);
        for slip_rate in SLIP_RATES {
            let mut previous: Option<(f64, f64)> = None;
            for value in around {
                if law.validate_state(T::State::from_value(value)).is_err() {
                    continue;
                }
                let rate = evolution_at(law, value, slip_rate);
                if rate.is_nan() {
                    return Err(StateLawViolation::EvolutionNotANumber {
                        state: value,
                        slip_rate,
                    });
                }
                if let Some((lower, at_lower)) = previous
                    && rate > at_lower
                {
                    // Infinite rates increase by all they can.
                    let increase = ((rate - at_lower) / (rate.abs() + at_lower.abs())).min(2.0);
                    let size = if increase.is_nan() { 2.0 } else { increase };
                    if size > worst.map_or(ROUNDING, |(largest, _)| largest) {
                        let violation = StateLawViolation::EvolutionIncreases {
                            lower,
                            upper: value,
                            slip_rate,
                            at_lower,
                            at_upper: rate,
                        };
                        worst = Some((size, violation));
                    }
                }
                previous = Some((value, rate));
            }
        }
    }
    worst.map_or(Ok(()), |(_, violation)| Err(violation))
}

/// Compares the slope with the evolution, roughly; not where the law jumps.
fn compare<T: StateLaw + ?Sized>(
    law: &T,
    state: f64,
    slip_rate: f64,
) -> Result<(), StateLawViolation> {
    let evolution = |state| evolution_at(law, state, slip_rate);
    let slope = law.evolution_state_slope(T::State::from_value(state), slip_rate);
    let rate = evolution(state);
    let scale = if state == 0.0 { 1.0 } else { state.abs() };
    let noise = 16.0 * f64::EPSILON * (rate.abs() + slope.abs() * (state.abs() + 1.0));
    let Some((difference, uncertainty)) = difference::smooth(evolution, state, 1e-5 * scale, noise)
    else {
        return Ok(());
    };
    // Not NaN either.
    let agrees = (slope - difference).abs() <= ROUGH * difference.abs() + uncertainty;
    if !agrees {
        return Err(StateLawViolation::Slope {
            requirement: QUOTIENT,
            state,
            slip_rate,
            slope,
            bound: difference,
        });
    }
    Ok(())
}

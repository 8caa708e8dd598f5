//! Monotony and slope of the right-hand side.

use super::{StateLawViolation, difference, evolution_at};
use crate::{StateLaw, StateVariable};

const SIGN: &str = "at most";
pub(super) const QUOTIENT: &str = "the difference quotient";

/// `states` in increasing order.
pub(super) fn check<T: StateLaw + ?Sized>(
    law: &T,
    states: &[f64],
    slip_rate: f64,
) -> Result<(), StateLawViolation> {
    let evolution = |state| evolution_at(law, state, slip_rate);
    let slope_at = |state| law.evolution_state_slope(T::State::from_value(state), slip_rate);
    // The rounding of the state and of the rate, whose terms may cancel, and that of tiny rates.
    let noise = |state: f64, rate: f64, slope: f64| {
        let terms = rate.abs() + slope.abs() * (state.abs() + 1.0);
        16.0 * f64::EPSILON * terms + f64::MIN_POSITIVE
    };
    let mut previous: Option<(f64, f64, f64)> = None;
    for &state in states {
        let (rate, slope) = (evolution(state), slope_at(state));
        if rate.is_nan() {
            return Err(StateLawViolation::EvolutionNotANumber { state, slip_rate });
        }
        if slope.is_nan() || slope > 0.0 {
            return Err(StateLawViolation::Slope {
                requirement: SIGN,
                state,
                slip_rate,
                slope,
                bound: 0.0,
            });
        }
        let noise = noise(state, rate, slope);
        if let Some((lower, at_lower, noise_there)) = previous
            && rate > at_lower + noise + noise_there
        {
            return Err(StateLawViolation::EvolutionIncreases {
                lower,
                upper: state,
                slip_rate,
                at_lower,
                at_upper: rate,
            });
        }
        previous = Some((state, rate, noise));
    }
    for &state in states {
        let (rate, slope) = (evolution(state), slope_at(state));
        let noise = noise(state, rate, slope);
        // A step relative to a state much smaller than 1 would vanish beside a logarithm.
        let relative = if state.abs() >= 1e-3 {
            state.abs()
        } else {
            1.0
        };
        for h in [1e-5, 1e-5 * relative] {
            if let Some((difference, uncertainty)) = difference::smooth(evolution, state, h, noise)
                && (slope - difference).abs() > uncertainty
            {
                return Err(StateLawViolation::Slope {
                    requirement: QUOTIENT,
                    state,
                    slip_rate,
                    slope,
                    bound: difference,
                });
            }
        }
    }
    Ok(())
}

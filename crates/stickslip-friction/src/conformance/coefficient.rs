//! Sign, monotony and slopes of the coefficient.

use stickslip_state::StateVariable;

use super::{FrictionLawViolation, SLIP_RATES, coefficient_terms};
use crate::{FrictionLaw, difference::smooth};

/// Over all rates of the checks.
pub(super) fn check_growth<L: FrictionLaw + ?Sized>(
    law: &L,
    state: L::State,
) -> Result<(), FrictionLawViolation> {
    let value = state.value();
    let mut previous: Option<(f64, f64)> = None;
    let mut increasing = SLIP_RATES;
    increasing.sort_by(f64::total_cmp);
    for slip_rate in increasing {
        let coefficient = law.coefficient(slip_rate, state);
        if !(coefficient.is_finite() && coefficient >= 0.0) {
            return Err(FrictionLawViolation::Coefficient {
                state: value,
                slip_rate,
                coefficient,
            });
        }
        if let Some((slower, at_slower)) = previous
            && coefficient < at_slower * (1.0 - 16.0 * f64::EPSILON)
        {
            return Err(FrictionLawViolation::CoefficientDecreases {
                state: value,
                slower,
                faster: slip_rate,
                at_slower,
                at_faster: coefficient,
            });
        }
        previous = Some((slip_rate, coefficient));
    }
    Ok(())
}

/// Slopes at one rate.
pub(super) fn check<L: FrictionLaw + ?Sized>(
    law: &L,
    state: L::State,
    slip_rate: f64,
) -> Result<(), FrictionLawViolation> {
    let value = state.value();
    let coefficient = law.coefficient(slip_rate, state);
    let slope = law.coefficient_rate_slope(slip_rate, state);
    if slope.is_nan() || slope < 0.0 {
        return Err(FrictionLawViolation::SlopeSign {
            state: value,
            slip_rate,
            slope,
        });
    }
    check_together(law, state, slip_rate, (coefficient, slope))?;
    let noise = 16.0 * f64::EPSILON * coefficient_terms(law, slip_rate, state) + f64::MIN_POSITIVE;
    // In units of the rate; the smallest ones have no digits to spare for a difference.
    if slip_rate >= 1e-300 {
        let along = |ratio: f64| law.coefficient(ratio * slip_rate, state);
        if let Some((difference, uncertainty)) = smooth(along, 1.0, 1e-5, noise)
            && (slope * slip_rate - difference).abs() > uncertainty
        {
            return Err(FrictionLawViolation::Slope {
                state: value,
                slip_rate,
                slope,
                difference: difference / slip_rate,
            });
        }
    }
    let slope = law.coefficient_state_slope(slip_rate, state);
    if slope.is_nan() {
        return Err(FrictionLawViolation::StateSlope {
            state: value,
            slip_rate,
            slope,
            difference: f64::NAN,
        });
    }
    let along = |x| law.coefficient(slip_rate, L::State::from_value(x));
    let relative = if value.abs() >= 1e-3 {
        value.abs()
    } else {
        1.0
    };
    for h in [1e-5, 1e-5 * relative] {
        if let Some((difference, uncertainty)) = smooth(along, value, h, noise)
            && (slope - difference).abs() > uncertainty
        {
            return Err(FrictionLawViolation::StateSlope {
                state: value,
                slip_rate,
                slope,
                difference,
            });
        }
    }
    Ok(())
}

/// Both at once are what each is alone, but for rounding.
fn check_together<L: FrictionLaw + ?Sized>(
    law: &L,
    state: L::State,
    slip_rate: f64,
    alone: (f64, f64),
) -> Result<(), FrictionLawViolation> {
    let pair = law.coefficient_and_rate_slope(slip_rate, state);
    let response = law.response(slip_rate, state);
    let state_slope = law.coefficient_state_slope(slip_rate, state);
    let rounding = 16.0 * f64::EPSILON * coefficient_terms(law, slip_rate, state);
    let near = |a: f64, b: f64, rounding: f64| a == b || (a - b).abs() <= rounding;
    let relative = |a: f64, b: f64| near(a, b, 16.0 * f64::EPSILON * b.abs());
    let triple = (response.coefficient, response.rate_slope);
    let is_off = |together: &(f64, f64)| {
        !(near(together.0, alone.0, rounding) && relative(together.1, alone.1))
    };
    if !relative(response.state_slope, state_slope) {
        return Err(FrictionLawViolation::StateSlope {
            state: state.value(),
            slip_rate,
            slope: response.state_slope,
            difference: state_slope,
        });
    }
    let Some(together) = [pair, triple].into_iter().find(is_off) else {
        return Ok(());
    };
    Err(FrictionLawViolation::Together {
        state: state.value(),
        slip_rate,
        coefficient: together.0,
        slope: together.1,
        coefficient_alone: alone.0,
        slope_alone: alone.1,
    })
}

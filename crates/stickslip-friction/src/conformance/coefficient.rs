//! Sign, monotony and slopes of the coefficient.

use stickslip_state::StateVariable;

use super::{FrictionViolation, SLIP_RATES, coefficient_terms};
use crate::{FrictionLaw, difference::smooth};

pub(super) const QUOTIENT: &str = "the difference quotient";
pub(super) const ALONE: &str = "that alone";

/// Checks sign and growth over all rates.
pub(super) fn check_growth<L: FrictionLaw + ?Sized>(
    law: &L,
    state: L::State,
) -> Result<(), FrictionViolation> {
    let value = state.value();
    let mut previous: Option<(f64, f64)> = None;
    let mut increasing = SLIP_RATES;
    increasing.sort_by(f64::total_cmp);
    for slip_rate in increasing {
        let coefficient = law.coefficient(slip_rate, state);
        if !(coefficient.is_finite() && coefficient >= 0.0) {
            return Err(FrictionViolation::value(
                "coefficient",
                "finite and non-negative",
                [value, slip_rate],
                coefficient,
            ));
        }
        if let Some((slower, at_slower)) = previous
            && coefficient < at_slower * (1.0 - 16.0 * f64::EPSILON)
        {
            return Err(FrictionViolation::CoefficientDecreases {
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

/// Checks the slopes at one rate.
pub(super) fn check<L: FrictionLaw + ?Sized>(
    law: &L,
    state: L::State,
    slip_rate: f64,
) -> Result<(), FrictionViolation> {
    let value = state.value();
    let coefficient = law.coefficient(slip_rate, state);
    let slope = law.coefficient_rate_slope(slip_rate, state);
    if slope.is_nan() || slope < 0.0 {
        return Err(FrictionViolation::value(
            "coefficient_rate_slope",
            "non-negative",
            [value, slip_rate],
            slope,
        ));
    }
    check_together(law, state, slip_rate, (coefficient, slope))?;
    let noise = 16.0 * f64::EPSILON * coefficient_terms(law, slip_rate, state) + f64::MIN_POSITIVE;
    // In units of the rate; the smallest ones have no digits to spare for a difference.
    if slip_rate >= 1e-300 {
        let along = |ratio: f64| law.coefficient(ratio * slip_rate, state);
        if let Some((difference, uncertainty)) = smooth(along, 1.0, 1e-5, noise)
            && (slope * slip_rate - difference).abs() > uncertainty
        {
            return Err(FrictionViolation::differs(
                "coefficient_rate_slope",
                QUOTIENT,
                [value, slip_rate],
                [slope, difference / slip_rate],
            ));
        }
    }
    let slope = law.coefficient_state_slope(slip_rate, state);
    if slope.is_nan() {
        return Err(FrictionViolation::differs(
            "coefficient_state_slope",
            QUOTIENT,
            [value, slip_rate],
            [slope, f64::NAN],
        ));
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
            return Err(FrictionViolation::differs(
                "coefficient_state_slope",
                QUOTIENT,
                [value, slip_rate],
                [slope, difference],
            ));
        }
    }
    Ok(())
}

/// Checks that joint evaluations equal separate ones, but for rounding.
fn check_together<L: FrictionLaw + ?Sized>(
    law: &L,
    state: L::State,
    slip_rate: f64,
    alone: (f64, f64),
) -> Result<(), FrictionViolation> {
    let pair = law.coefficient_and_rate_slope(slip_rate, state);
    let response = law.response(slip_rate, state);
    let state_slope = law.coefficient_state_slope(slip_rate, state);
    let rounding = 16.0 * f64::EPSILON * coefficient_terms(law, slip_rate, state);
    let near = |a: f64, b: f64, rounding: f64| a == b || (a - b).abs() <= rounding;
    let relative = |a: f64, b: f64| near(a, b, 16.0 * f64::EPSILON * b.abs());
    let triple = (response.coefficient, response.rate_slope);
    let at = [state.value(), slip_rate];
    // A slope that is not a number by itself is reported by the check of that slope.
    if !(state_slope.is_nan() || relative(response.state_slope, state_slope)) {
        return Err(FrictionViolation::differs(
            "coefficient_state_slope together",
            ALONE,
            at,
            [response.state_slope, state_slope],
        ));
    }
    for (coefficient, slope) in [pair, triple] {
        let (what, found, expected) = if !near(coefficient, alone.0, rounding) {
            ("coefficient together", coefficient, alone.0)
        } else if !relative(slope, alone.1) {
            ("coefficient_rate_slope together", slope, alone.1)
        } else {
            continue;
        };
        return Err(FrictionViolation::differs(
            what,
            ALONE,
            at,
            [found, expected],
        ));
    }
    Ok(())
}

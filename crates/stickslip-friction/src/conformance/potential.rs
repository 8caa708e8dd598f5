//! The potential as the integral of the coefficient.

use stickslip_state::StateVariable;

use super::{FrictionViolation, coefficient_terms};
use crate::FrictionLaw;

pub(super) const INTEGRAL: &str = "the integral";

/// The intervals `[V/2, V], [V/4, V/2], ...` of the quadrature; the remainder is below rounding.
const HALVINGS: i32 = 50;

/// The number of parts of each of those intervals.
const PARTS: u32 = 16;

pub(super) fn check_rest<L: FrictionLaw + ?Sized>(
    law: &L,
    state: L::State,
) -> Result<(), FrictionViolation> {
    let at_rest = law.potential(0.0, state);
    if at_rest != 0.0 {
        return Err(FrictionViolation::value(
            "potential",
            "0 at rest",
            [state.value(), 0.0],
            at_rest,
        ));
    }
    Ok(())
}

/// Convexity and the integral at one rate.
pub(super) fn check<L: FrictionLaw + ?Sized>(
    law: &L,
    state: L::State,
    slip_rate: f64,
) -> Result<(), FrictionViolation> {
    let value = state.value();
    let potential = law.potential(slip_rate, state);
    let noise = 64.0 * f64::EPSILON * slip_rate * coefficient_terms(law, slip_rate, state)
        + f64::MIN_POSITIVE;
    let chord = 0.5 * law.potential(2.0 * slip_rate, state);
    if potential.is_nan() || potential > chord + noise {
        return Err(FrictionViolation::differs(
            "potential",
            "at most the chord",
            [value, slip_rate],
            [potential, chord],
        ));
    }
    // The smallest rates cannot be halved often enough.
    if slip_rate < 1e-280 {
        return Ok(());
    }
    let (integral, at_kink) = integrated(law, state, slip_rate);
    let uncertainty = at_kink + 1e-9 * integral + noise;
    if (potential - integral).abs() > uncertainty {
        return Err(FrictionViolation::differs(
            "potential",
            INTEGRAL,
            [value, slip_rate],
            [potential, integral],
        ));
    }
    Ok(())
}

/// Gauss' rule with three points on `PARTS` parts of each halving, and the error of a kink in one of them: at most the
/// largest difference from the trapezoidal rule.
fn integrated<L: FrictionLaw + ?Sized>(law: &L, state: L::State, end: f64) -> (f64, f64) {
    let offset = 0.5 * 0.6f64.sqrt();
    let (mut sum, mut at_kink) = (0.0, 0.0f64);
    for halving in 0..HALVINGS {
        let width = end * 0.5f64.powi(halving + 1) / f64::from(PARTS);
        for part in 0..PARTS {
            let start = width * f64::from(PARTS + part);
            let at = |position: f64| width * law.coefficient(start + position * width, state);
            let outer = at(0.5 - offset) + at(0.5 + offset);
            let gauss = (5.0 * outer + 8.0 * at(0.5)) / 18.0;
            sum += gauss;
            at_kink = at_kink.max((gauss - 0.5 * (at(0.0) + at(1.0))).abs());
        }
    }
    (sum, at_kink)
}

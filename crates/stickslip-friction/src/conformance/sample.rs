//! A quick check: some dozens of evaluations at the slip rates of experiments and faults.

use stickslip_state::StateVariable;

use super::coefficient::{ALONE, QUOTIENT};
use super::potential::INTEGRAL;
use super::{FrictionViolation, coefficient_terms};
use crate::{FrictionLaw, difference::smooth};

/// Rest, creep, laboratory and earthquake rates \[m/s\].
const SLIP_RATES: [f64; 12] = [
    0.0, 1e-20, 1e-16, 1e-14, 1e-12, 1e-10, 1e-8, 1e-6, 1e-4, 1e-2, 1.0, 1e2,
];

/// Slip rate from which on a violation is quoted before one nearer to rest \[m/s\].
const CREEP: f64 = 1e-12;

/// The relative rounding error of a coefficient.
const ROUNDING: f64 = 1e-9;

/// Creep, laboratory and earthquake rates \[m/s\] for the comparison of slopes and potential with the coefficient.
const COMPARED: [f64; 4] = [1e-6, 1e-2, 1e-9, 1.0];

/// The largest relative difference: rough differences and interpolated tables stay below it, a wrong sign, power or
/// unit does not.
const ROUGH: f64 = 0.1;

/// A change of the coefficient that no experiment resolves; smaller ones are not compared.
const NEGLIGIBLE: f64 = 1e-6;

/// Evaluates a friction law at the given states and a dozen slip rates from 0 to 100 m/s, and reports the worst
/// violation of its contract, from 1e-12 m/s on if possible.
///
/// It takes microseconds, and finds the defects that would mislead a simulation: a coefficient that is negative, not
/// finite or decreases with the slip rate, a slope of the wrong sign, and, at four of the rates, slopes and a potential
/// that differ by a tenth or more from those of the coefficient. [`check_friction_law`](crate::check_friction_law) is
/// the whole contract.
///
/// ```
/// use stickslip_friction::{FrictionViolation, Tresca, sample_friction_law};
///
/// sample_friction_law(&Tresca { coefficient: 0.6 }, &[()])?;
/// let violation = sample_friction_law(&Tresca { coefficient: -0.6 }, &[()]);
/// assert!(matches!(violation, Err(FrictionViolation::Value { what: "coefficient", value: -0.6, .. })));
/// # Ok::<(), FrictionViolation>(())
/// ```
///
/// # Errors
///
/// [`Value`](FrictionViolation::Value) of the coefficient if it is not a number or negative, else
/// [`CoefficientDecreases`](FrictionViolation::CoefficientDecreases) at the largest decrease, else
/// [`Value`](FrictionViolation::Value) of its slope at the steepest wrong one, else
/// [`Differs`](FrictionViolation::Differs) of a slope or of the potential.
pub fn sample_friction_law<L: FrictionLaw + ?Sized>(
    law: &L,
    states: &[L::State],
) -> Result<(), FrictionViolation> {
    check_signs(law, states)?;
    let at = |&slip_rate: &f64| states.iter().map(move |&state| (state, slip_rate));
    (COMPARED.iter().flat_map(at)).try_for_each(|(state, rate)| compare(law, state, rate))
}

/// The first part of the check, without comparisons of two functions of a law.
pub(super) fn check_signs<L: FrictionLaw + ?Sized>(
    law: &L,
    states: &[L::State],
) -> Result<(), FrictionViolation> {
    let (mut illegal, mut decrease, mut slope_sign) = (Worst(None), Worst(None), Worst(None));
    for &state in states {
        let value = state.value();
        let (mut slower, mut at_slower) = (0.0, f64::NEG_INFINITY);
        for slip_rate in SLIP_RATES {
            let coefficient = law.coefficient(slip_rate, state);
            if !(coefficient.is_finite() && coefficient >= 0.0) {
                let violation = FrictionViolation::value(
                    "coefficient",
                    "finite and non-negative",
                    [value, slip_rate],
                    coefficient,
                );
                let size = if coefficient.is_finite() {
                    -coefficient
                } else {
                    f64::INFINITY
                };
                illegal.add(slip_rate, size, violation);
                continue;
            }
            if coefficient < at_slower * (1.0 - ROUNDING) {
                let violation = FrictionViolation::CoefficientDecreases {
                    state: value,
                    slower,
                    faster: slip_rate,
                    at_slower,
                    at_faster: coefficient,
                };
                decrease.add(slip_rate, at_slower - coefficient, violation);
            } else {
                (slower, at_slower) = (slip_rate, coefficient);
            }
            let slope = law.coefficient_rate_slope(slip_rate, state);
            // At rest it may be the product of zero and infinity; that does no harm to a run.
            if slip_rate > 0.0 && (slope.is_nan() || slope < 0.0) {
                let violation = FrictionViolation::value(
                    "coefficient_rate_slope",
                    "non-negative",
                    [value, slip_rate],
                    slope,
                );
                // What a rate twice as large would change.
                let size = if slope.is_nan() {
                    f64::INFINITY
                } else {
                    -slope * slip_rate
                };
                slope_sign.add(slip_rate, size, violation);
            }
        }
    }
    [illegal, decrease, slope_sign]
        .into_iter()
        .find_map(|Worst(worst)| worst)
        .map_or(Ok(()), |(_, violation)| Err(violation))
}

/// Compares slopes and potential with the coefficient, roughly.
fn compare<L: FrictionLaw + ?Sized>(
    law: &L,
    state: L::State,
    slip_rate: f64,
) -> Result<(), FrictionViolation> {
    let value = state.value();
    // Not NaN either; `scale` makes a change of the coefficient of it.
    let agree = |found: f64, expected: f64, scale: f64| {
        (found - expected).abs() * scale <= ROUGH * expected.abs() * scale + NEGLIGIBLE
    };
    let differs = |what, requirement, numbers| {
        FrictionViolation::differs(what, requirement, [value, slip_rate], numbers)
    };
    let noise = 16.0 * f64::EPSILON * coefficient_terms(law, slip_rate, state);
    let rate_slope = law.coefficient_rate_slope(slip_rate, state);
    let along = |ratio: f64| law.coefficient(ratio * slip_rate, state);
    if let Some((difference, _)) = smooth(along, 1.0, 1e-5, noise)
        && !agree(rate_slope * slip_rate, difference, 1.0)
    {
        let numbers = [rate_slope, difference / slip_rate];
        return Err(differs("coefficient_rate_slope", QUOTIENT, numbers));
    }
    // The scale of a time is its size; that of a logarithm, 1, is not much smaller.
    let scale = if value == 0.0 { 1.0 } else { value.abs() };
    let state_slope = law.coefficient_state_slope(slip_rate, state);
    let along = |x| law.coefficient(slip_rate, L::State::from_value(x));
    if let Some((difference, _)) = smooth(along, value, 1e-5 * scale, noise)
        && !agree(state_slope, difference, scale)
    {
        let numbers = [state_slope, difference];
        return Err(differs("coefficient_state_slope", QUOTIENT, numbers));
    }
    let together = law.response(slip_rate, state);
    let pair = law.coefficient_and_rate_slope(slip_rate, state);
    let coefficient = law.coefficient(slip_rate, state);
    for (what, found, alone, scale) in [
        (
            "coefficient together",
            together.coefficient,
            coefficient,
            1.0,
        ),
        ("coefficient together", pair.0, coefficient, 1.0),
        (
            "coefficient_rate_slope together",
            together.rate_slope,
            rate_slope,
            slip_rate,
        ),
        (
            "coefficient_rate_slope together",
            pair.1,
            rate_slope,
            slip_rate,
        ),
        (
            "coefficient_state_slope together",
            together.state_slope,
            state_slope,
            scale,
        ),
    ] {
        if !(found == alone || alone.is_nan() || agree(found, alone, scale)) {
            return Err(differs(what, ALONE, [found, alone]));
        }
    }
    // The mean slope between two rates lies between the coefficients there, which do not decrease.
    let faster = 2.0 * slip_rate;
    let [at_slower, potential] = [slip_rate, faster].map(|rate| law.potential(rate, state));
    let tolerance = slip_rate * (ROUGH * coefficient + NEGLIGIBLE);
    let least = at_slower + slip_rate * coefficient;
    let most = at_slower + slip_rate * law.coefficient(faster, state);
    // Not NaN either.
    let between = least - tolerance <= potential && potential <= most + tolerance;
    if !between {
        let bound = if potential < least { least } else { most };
        return Err(FrictionViolation::differs(
            "potential",
            INTEGRAL,
            [value, faster],
            [potential, bound],
        ));
    }
    Ok(())
}

/// The worst of some violations, with whether the contact slips there and its size.
struct Worst(Option<((bool, f64), FrictionViolation)>);

impl Worst {
    fn add(&mut self, slip_rate: f64, size: f64, violation: FrictionViolation) {
        let rank = (slip_rate >= CREEP, size);
        if self.0.is_none_or(|(highest, _)| rank > highest) {
            self.0 = Some((rank, violation));
        }
    }
}

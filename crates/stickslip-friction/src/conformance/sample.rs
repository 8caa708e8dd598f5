//! A few evaluations at the slip rates of experiments and faults.

use stickslip_state::StateVariable;

use super::FrictionViolation;
use crate::FrictionLaw;

/// Rest, creep, the laboratory, earthquakes \[m/s\].
const SLIP_RATES: [f64; 12] = [
    0.0, 1e-20, 1e-16, 1e-14, 1e-12, 1e-10, 1e-8, 1e-6, 1e-4, 1e-2, 1.0, 1e2,
];

/// From here on \[m/s\] a violation is told before it is told nearer to rest.
const CREEP: f64 = 1e-12;

/// The share of a coefficient that may be lost to rounding.
const ROUNDING: f64 = 1e-9;

/// Evaluates a friction law at the given states and a dozen slip rates from 0 to 100 m/s, and tells where it breaks
/// its contract most, from 1e-12 m/s on if it does there.
///
/// It takes microseconds, and looks at what a run would go astray by: a coefficient that is negative, not finite or
/// decreases with the slip rate, and a slope of the wrong sign. [`check_friction_law`](crate::check_friction_law) is
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
/// [`Value`](FrictionViolation::Value) of the coefficient where it is not a number or most negative, else
/// [`CoefficientDecreases`](FrictionViolation::CoefficientDecreases) where it falls most, else
/// [`Value`](FrictionViolation::Value) of its slope where that is steepest.
pub fn sample_friction_law<L: FrictionLaw + ?Sized>(
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

/// The worst of some violations, with whether something slips there and its size.
struct Worst(Option<((bool, f64), FrictionViolation)>);

impl Worst {
    fn add(&mut self, slip_rate: f64, size: f64, violation: FrictionViolation) {
        let rank = (slip_rate >= CREEP, size);
        if self.0.is_none_or(|(highest, _)| rank > highest) {
            self.0 = Some((rank, violation));
        }
    }
}

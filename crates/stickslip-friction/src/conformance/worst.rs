//! Which of several violations to quote.

use std::mem::discriminant;

use super::FrictionLawViolation;

/// By how much one is worse than another: less is what rounding makes of equals.
const MORE: f64 = 1.01;

/// The worst of the kind that comes first; others may follow from it. Of equals it is the first.
pub(super) fn of(
    checks: impl Iterator<Item = Result<(), FrictionLawViolation>>,
) -> Result<(), FrictionLawViolation> {
    let mut violations = checks.filter_map(Result::err);
    let Some(mut worst) = violations.next() else {
        return Ok(());
    };
    let kind = discriminant(&worst);
    for violation in violations.filter(|violation| discriminant(violation) == kind) {
        if violation.size() > MORE * worst.size() {
            worst = violation;
        }
    }
    Err(worst)
}

impl FrictionLawViolation {
    /// How far two numbers that should agree are apart, relative to their size; infinite where there is nothing to
    /// compare.
    fn size(&self) -> f64 {
        match *self {
            Self::CoefficientDecreases {
                at_slower,
                at_faster,
                ..
            } => apart(at_slower, at_faster),
            // Of the wrong sign altogether.
            Self::SlopeSign { slope, .. } => apart(slope, 0.0),
            Self::Slope {
                slope, difference, ..
            }
            | Self::StateSlope {
                slope, difference, ..
            } => apart(slope, difference),
            Self::Together {
                coefficient,
                slope,
                coefficient_alone,
                slope_alone,
                ..
            } => apart(coefficient, coefficient_alone).max(apart(slope, slope_alone)),
            Self::NotConvex {
                potential, chord, ..
            } => apart(potential, chord),
            Self::NotTheIntegral {
                potential,
                integral,
                ..
            } => apart(potential, integral),
            Self::NotBalanced {
                slip_rate, root, ..
            } => apart(slip_rate, root),
            Self::NoStates
            | Self::Refused(_)
            | Self::Coefficient { .. }
            | Self::PotentialAtRest { .. }
            | Self::DoesNotStick { .. } => f64::INFINITY,
        }
    }
}

fn apart(a: f64, b: f64) -> f64 {
    if a == b {
        return 0.0;
    }
    let share = (a - b).abs() / (a.abs() + b.abs());
    if share.is_nan() { f64::INFINITY } else { share }
}

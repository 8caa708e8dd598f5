//! Which of several violations to quote.

use std::mem::discriminant;

use super::StateLawViolation;

/// By how much one is worse than another: less is what rounding makes of equals.
const MORE: f64 = 1.01;

/// The worst of the kind that comes first; others may follow from it. Of equals it is the first.
pub(super) fn of(
    checks: impl Iterator<Item = Result<(), StateLawViolation>>,
) -> Result<(), StateLawViolation> {
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

impl StateLawViolation {
    /// How far two numbers that should agree are apart, relative to their size; infinite where there is nothing to
    /// compare.
    fn size(&self) -> f64 {
        match *self {
            Self::EvolutionIncreases {
                at_lower, at_upper, ..
            } => apart(at_lower, at_upper, 0.0),
            // Of the wrong sign altogether.
            Self::SlopeSign { slope, .. } => apart(slope, 0.0, 0.0),
            Self::Slope {
                slope, difference, ..
            }
            | Self::AdvanceSlope {
                slope, difference, ..
            }
            | Self::ConstantRateSlope {
                slope, difference, ..
            } => apart(slope, difference, 0.0),
            Self::NotTheEvolution {
                moved, expected, ..
            } => apart(moved, expected, 0.0),
            // States may be logarithms, whose scale is 1.
            Self::MovesInNoTime { step, to } => apart(step.from, to, 1.0),
            Self::NotBackwardEuler { to, root, .. } => apart(to, root, 1.0),
            Self::Order { to, to_upper, .. } => apart(to, to_upper, 1.0),
            Self::Composition { to, in_parts, .. } => apart(to, in_parts, 1.0),
            Self::NotTheLimit { to, limit, .. } => apart(to, limit, 1.0),
            Self::NoStates
            | Self::Refused(_)
            | Self::EvolutionNotANumber { .. }
            | Self::Accepts { .. }
            | Self::NotFinite { .. } => f64::INFINITY,
        }
    }
}

fn apart(a: f64, b: f64, scale: f64) -> f64 {
    let share = (a - b).abs() / (a.abs() + b.abs() + scale);
    if share.is_nan() { f64::INFINITY } else { share }
}

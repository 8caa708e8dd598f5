//! The choice of the violation to quote.

use std::mem::{Discriminant, discriminant};

use super::FrictionViolation;

/// The factor by which one must be worse than another: rounding may change equals by less.
const MORE: f64 = 1.01;

/// The worst of the kind that comes first, since others may follow from it; the first of equals.
pub(super) fn of(
    checks: impl Iterator<Item = Result<(), FrictionViolation>>,
) -> Result<(), FrictionViolation> {
    let mut violations = checks.filter_map(Result::err);
    let Some(mut worst) = violations.next() else {
        return Ok(());
    };
    let kind = worst.kind();
    for violation in violations.filter(|violation| violation.kind() == kind) {
        if violation.size() > MORE * worst.size() {
            worst = violation;
        }
    }
    Err(worst)
}

impl FrictionViolation {
    /// The kind of the violation.
    fn kind(&self) -> (Discriminant<Self>, [&'static str; 2]) {
        let parts = match *self {
            Self::Value {
                what, requirement, ..
            }
            | Self::Differs {
                what, requirement, ..
            } => [what, requirement],
            Self::SlipRate { expected: 0.0, .. } => ["rest", ""],
            _ => ["", ""],
        };
        (discriminant(self), parts)
    }

    /// The relative distance of two numbers that should agree; infinite without a reference.
    fn size(&self) -> f64 {
        match *self {
            Self::CoefficientDecreases {
                at_slower: found,
                at_faster: expected,
                ..
            }
            | Self::Differs {
                found, expected, ..
            } => apart(found, expected),
            // Of the wrong sign altogether.
            Self::Value { value, .. } => apart(value, 0.0),
            Self::SlipRate {
                slip_rate: found,
                expected,
                ..
            } if expected != 0.0 => apart(found, expected),
            _ => f64::INFINITY,
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

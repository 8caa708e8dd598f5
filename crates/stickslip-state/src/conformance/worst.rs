//! The choice of the violation to quote.

use std::mem::{Discriminant, discriminant};

use super::{CHANGE, SLOPES, StateLawViolation};

/// The factor by which one must be worse than another: rounding may change equals by less.
const MORE: f64 = 1.01;

/// The worst of the kind that comes first, since others may follow from it; the first of equals.
pub(super) fn of(
    checks: impl Iterator<Item = Result<(), StateLawViolation>>,
) -> Result<(), StateLawViolation> {
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

impl StateLawViolation {
    /// The kind of the violation.
    fn kind(&self) -> (Discriminant<Self>, &'static str) {
        let part = match *self {
            Self::Slope { requirement, .. } => requirement,
            Self::Step { property, .. } => property,
            _ => "",
        };
        (discriminant(self), part)
    }

    /// The relative distance of two numbers that should agree; infinite without a reference.
    fn size(&self) -> f64 {
        match *self {
            Self::EvolutionIncreases {
                at_lower, at_upper, ..
            } => apart(at_lower, at_upper, 0.0),
            Self::ManyNodes {
                found, expected, ..
            } => apart(found, expected, 0.0),
            // Beside a bound of 0 of the wrong sign altogether.
            Self::Slope { slope, bound, .. } => apart(slope, bound, 0.0),
            // States may be logarithms, whose scale is 1.
            Self::Order { to, to_upper, .. } => apart(to, to_upper, 1.0),
            Self::Step {
                property,
                found,
                expected,
                ..
            } => {
                let rate = property == CHANGE || SLOPES.contains(&property);
                apart(found, expected, if rate { 0.0 } else { 1.0 })
            }
            Self::Refused(_)
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

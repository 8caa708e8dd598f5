//! Sums and maxima over vertices, the only global operations of a step beside the norms of operators; and a field with
//! components in all directions.

use nalgebra::SVector;
use stickslip_solvers::Ranks;

use crate::StepError;

/// The sum of the terms of all vertices.
pub(crate) fn sum(terms: impl Iterator<Item = f64>) -> f64 {
    terms.sum()
}

/// The largest of the values of all vertices, at least zero; NaN if one of them is NaN.
pub(crate) fn largest(values: impl Iterator<Item = f64>) -> f64 {
    values.fold(0.0, |largest: f64, value| {
        if value.is_nan() || largest.is_nan() {
            f64::NAN
        } else {
            largest.max(value)
        }
    })
}

/// The result of this process, or the error that another one has failed.
pub(crate) fn agreed<T>(ranks: &Ranks, result: Result<T, StepError>) -> Result<T, StepError> {
    let all = ranks.all(result.is_ok());
    result.and_then(|value| {
        if all {
            Ok(value)
        } else {
            Err(StepError::Elsewhere)
        }
    })
}

/// Fills the free components with a field that has a component in every direction: digits of the golden ratio. Fixed
/// components are zero.
pub(crate) fn all_directions<const C: usize>(field: &mut [SVector<f64, C>], fixed: &[[bool; C]]) {
    let mut digit: f64 = 0.5;
    for (value, fixed) in field.iter_mut().zip(fixed) {
        *value = SVector::zeros();
        for c in (0..C).filter(|&c| !fixed[c]) {
            digit = (digit + 0.618_033_988_749_894_9).fract();
            value[c] = digit - 0.5;
        }
    }
}

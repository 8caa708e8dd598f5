//! Sums and maxima over vertices: all that a step asks of a body as a whole, beside the norms of operators.

/// The sum of the terms of all vertices.
pub(crate) fn sum(terms: impl Iterator<Item = f64>) -> f64 {
    terms.sum()
}

/// The largest of the values of all vertices, not below zero; not a number where one of them is none.
pub(crate) fn largest(values: impl Iterator<Item = f64>) -> f64 {
    values.fold(0.0, |largest: f64, value| {
        if value.is_nan() || largest.is_nan() {
            f64::NAN
        } else {
            largest.max(value)
        }
    })
}

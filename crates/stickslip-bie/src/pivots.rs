//! Steps of cross approximations.

/// `from - factor values`.
pub(crate) fn subtract(from: &mut [f64], factor: f64, values: &[f64]) {
    for (from, value) in from.iter_mut().zip(values) {
        *from -= factor * value;
    }
}

/// The place of the entry of the largest modulus among those allowed.
pub(crate) fn largest(values: &[f64], allowed: impl Fn(usize) -> bool) -> Option<usize> {
    let places = (0..values.len()).filter(|&place| allowed(place));
    places.max_by(|&a, &b| values[a].abs().total_cmp(&values[b].abs()))
}

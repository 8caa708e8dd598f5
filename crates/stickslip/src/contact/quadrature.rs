//! The potential of friction with a condensed state.

/// The integral of `coefficient` over slip rates from 0 on: Gauss's rule of three points on 256 panels that shrink
/// towards zero slip rate.
pub(crate) fn integral(slip_rate: f64, coefficient: impl Fn(f64) -> f64) -> f64 {
    const PANELS: usize = 256;
    const SHRINK: f64 = 0.75;
    let (mut right, mut sum) = (slip_rate, 0.0);
    for panel in 1..=PANELS {
        let left = if panel < PANELS { right * SHRINK } else { 0.0 };
        let (middle, half) = (0.5 * (left + right), 0.5 * (right - left));
        let offset = half * 0.6_f64.sqrt();
        let outer = coefficient(middle - offset) + coefficient(middle + offset);
        sum += half * (5.0 * outer + 8.0 * coefficient(middle)) / 9.0;
        right = left;
    }
    sum
}

//! Derivatives by finite differences at smooth points.

/// The central difference of `f` at `x` with step `h`, if `f`, known up to `noise`, is smooth on that
/// scale: differences to either side, with the whole and with half the step, agree to a hundredth.
/// Returned with its uncertainty.
pub(crate) fn smooth(f: impl Fn(f64) -> f64, x: f64, h: f64, noise: f64) -> Option<(f64, f64)> {
    let at = f(x);
    let quotient = |h: f64| (f(x + h) - at) / ((x + h) - x);
    let all = [
        quotient(h),
        quotient(-h),
        quotient(0.5 * h),
        quotient(-0.5 * h),
    ];
    let smallest = all.iter().copied().fold(f64::INFINITY, f64::min);
    let largest = all.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let size = smallest.abs().max(largest.abs());
    let uncertainty = 4.0 * noise / h;
    let known = all.iter().all(|q| q.is_finite()) && uncertainty.is_finite();
    (known && largest - smallest <= 0.01 * size + uncertainty)
        .then(|| (0.5 * (all[0] + all[1]), 1e-3 * size + uncertainty))
}

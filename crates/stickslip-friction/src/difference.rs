//! Slopes by finite differences, for laws without slopes and for laws under test.

use stickslip_state::StateVariable;

/// The cube root of the machine precision, the best relative step of a central difference.
const CENTRAL: f64 = 6e-6;

/// `df/dalpha` by a central difference.
///
/// The scale of a state is its own size if it is a time, and 1 if it is a logarithm. The step therefore begins at the
/// smaller of the two and grows, at most up to the larger, until `f` changes.
pub(crate) fn slope_in_state<S: StateVariable>(state: S, f: impl Fn(S) -> f64) -> f64 {
    let x = state.value();
    let f = |x| f(S::from_value(x));
    let answer = 1e-7 * f(x).abs();
    let largest = CENTRAL * x.abs().max(1.0);
    let mut h = CENTRAL * if x == 0.0 { 1.0 } else { x.abs().min(1.0) };
    let mut slope = 0.0;
    loop {
        let (low, high) = (x - h, x + h);
        let change = f(high) - f(low);
        // The step has left the range of the state.
        if change.is_nan() {
            return slope;
        }
        slope = change / (high - low);
        if change.abs() >= answer && change != 0.0 || h >= largest {
            return slope;
        }
        h = (8.0 * h).min(largest);
    }
}

/// The central difference of `f` at `x` with step `h`, if `f`, known up to `noise`, is smooth on that
/// scale: differences to either side, with the whole and with half the step, agree to a hundredth.
/// Returned with its uncertainty.
pub(crate) fn smooth(f: impl Fn(f64) -> f64, x: f64, h: f64, noise: f64) -> Option<(f64, f64)> {
    let at = f(x);
    let quotient = |h: f64| (f(x + h) - at) / ((x + h) - x);
    let all = [h, -h, 0.5 * h, -0.5 * h].map(quotient);
    let smallest = all.iter().copied().fold(f64::INFINITY, f64::min);
    let largest = all.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let size = smallest.abs().max(largest.abs());
    let uncertainty = 4.0 * noise / h;
    let known = all.iter().all(|q| q.is_finite()) && uncertainty.is_finite();
    (known && largest - smallest <= 0.01 * size + uncertainty)
        .then(|| (0.5 * (all[0] + all[1]), 1e-3 * size + uncertainty))
}

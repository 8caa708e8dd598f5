//! Slopes of laws that give none.

use stickslip_state::StateVariable;

/// The cube root of the machine precision, the best relative step of a central difference.
const CENTRAL: f64 = 6e-6;

/// `df/dalpha` by a central difference.
///
/// The scale of a state is its own size if it is a time, and 1 if it is a logarithm. So the step
/// begins at the smaller of the two and grows, at most up to the larger, until `f` answers.
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

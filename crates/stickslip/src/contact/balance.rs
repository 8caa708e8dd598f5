//! The slip rate at which friction balances a drive.

use crate::numerics::NUMERICS;

/// The slip rate at which `friction`, a value and its slope, balances `drive`: Newton's method in `ln V` inside a
/// bracket, from `guess`. Friction need not grow with the rate.
///
/// Where the left-hand side is not monotone, the result is one of its upward crossings of `drive`. It is NaN where
/// friction is.
pub(crate) fn balance(
    viscosity: f64,
    drive: f64,
    guess: f64,
    friction: impl Fn(f64) -> (f64, f64),
) -> f64 {
    let (mut lower, mut upper) = (0.0, drive / viscosity);
    let mut rate = guess.min(upper).max(lower);
    let sticks = || drive <= friction(0.0).0;
    if rate == 0.0 {
        if sticks() {
            return 0.0;
        }
        rate = upper.min(f64::MIN_POSITIVE);
    }
    for _ in 0..NUMERICS.evaluations {
        let (resistance, slope) = friction(rate);
        let excess = viscosity * rate + resistance - drive;
        if excess < 0.0 {
            lower = rate;
        } else if excess > 0.0 {
            upper = rate;
        } else {
            // Balanced, or not a number.
            return if excess == 0.0 { rate } else { f64::NAN };
        }
        let step = -excess / (rate * (viscosity + slope));
        let newton = rate * step.exp();
        let inside = lower < newton && newton < upper;
        if inside && step.abs() <= NUMERICS.last_step && viscosity + slope > 0.0 {
            return newton;
        }
        // A step against the bracket's sense starts where the left-hand side falls.
        let next = if inside && (step < 0.0) == (excess > 0.0) {
            newton
        } else if lower > 0.0 {
            lower.sqrt() * upper.min(f64::MAX).sqrt()
        } else if sticks() {
            return 0.0;
        } else {
            upper.min(f64::MAX).sqrt() * f64::MIN_POSITIVE.sqrt()
        };
        if !(lower < next && next < upper) || (upper - lower) <= 2.0 * f64::EPSILON * upper {
            return if upper <= f64::MIN_POSITIVE {
                0.0
            } else {
                upper
            };
        }
        rate = next;
    }
    rate
}

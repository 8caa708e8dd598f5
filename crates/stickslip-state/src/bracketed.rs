//! The scalar solver for laws without closed form.

use crate::StateError;

/// Number of evaluations after which the bracket is halved in the order of floating point numbers: 64 times at most.
const NEWTON_EVALUATIONS: usize = 100;

/// The root of a strictly increasing function `h`, to a few units in the last place.
///
/// `function` returns `h(x)` and its slope. The search begins at `start` and finds its own bracket. At a jump of `h`
/// across 0 the result is the jump. Values may be infinite. The slope only proposes Newton steps: a wrong, infinite or
/// NaN slope costs evaluations but not the result. The number of evaluations is bounded, about 10 for a smooth function
/// and 170 at worst once the root is bracketed.
///
/// ```
/// # use stickslip_state::increasing_root;
/// let root = increasing_root(5.0, |x| (x.exp() - 2.0, x.exp()))?;
/// assert!((root - 2f64.ln()).abs() < 1e-15);
/// # Ok::<(), stickslip_state::StateError>(())
/// ```
///
/// # Errors
///
/// [`StateError::NoRoot`] if `h` is NaN at a tried point, if `start` is not finite, or if `h` has the same sign up to
/// the largest `f64`.
pub fn increasing_root(
    start: f64,
    mut function: impl FnMut(f64) -> (f64, f64),
) -> Result<f64, StateError> {
    if !start.is_finite() {
        return Err(StateError::NoRoot {
            start,
            argument: start,
            value: f64::NAN,
        });
    }
    let (mut lower, mut lower_value) = (f64::NEG_INFINITY, f64::NEG_INFINITY);
    let (mut upper, mut upper_value) = (f64::INFINITY, f64::INFINITY);
    let mut x = start;
    let (mut last_step, mut last_newton) = (f64::INFINITY, f64::INFINITY);
    let mut evaluations = 0;
    loop {
        let (value, slope) = function(x);
        evaluations += 1;
        let failed = StateError::NoRoot {
            start,
            argument: x,
            value,
        };
        if value.is_nan() {
            return Err(failed);
        } else if value == 0.0 {
            return Ok(x);
        } else if value < 0.0 {
            (lower, lower_value) = (x, value);
        } else {
            (upper, upper_value) = (x, value);
        }
        let resolution = 2.0 * f64::EPSILON * x.abs();
        if upper - lower <= 2.0 * resolution || lower.next_up() >= upper {
            return Ok(if -lower_value < upper_value {
                lower
            } else {
                upper
            });
        }

        let towards = -value.signum();
        let newton = (-value / slope * towards).max(resolution);
        let trusted =
            newton.is_finite() && slope > 0.0 && newton > 0.0 && evaluations < NEWTON_EVALUATIONS;
        let next = if lower.is_finite() && upper.is_finite() {
            let proposal = x + towards * newton;
            // Steps that do not contract are the slow approach along an exponential, or a jump.
            if trusted && newton <= 0.5 * last_step && lower < proposal && proposal < upper {
                proposal
            } else if evaluations < NEWTON_EVALUATIONS {
                f64::midpoint(lower, upper)
            } else {
                middle_float(lower, upper)
            }
        } else {
            let stride = if last_step.is_infinite() {
                if trusted { newton } else { x.abs().max(1.0) }
            } else if trusted && newton <= 0.25 * last_newton {
                2.0 * newton
            } else {
                4.0 * last_step
            };
            x + towards * stride
        };
        if !next.is_finite() {
            return Err(failed);
        }
        (last_step, last_newton) = ((next - x).abs(), newton);
        x = next;
    }
}

/// The number half way between two others, counted in representable numbers.
fn middle_float(lower: f64, upper: f64) -> f64 {
    // The map between a float and its rank is its own inverse on the bit patterns.
    let flip = |bits: i64| {
        if bits < 0 {
            i64::MIN.wrapping_sub(bits)
        } else {
            bits
        }
    };
    let rank = |x: f64| flip(x.to_bits().cast_signed());
    f64::from_bits(flip(i64::midpoint(rank(lower), rank(upper))).cast_unsigned())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn counted(start: f64, h: impl Fn(f64) -> (f64, f64)) -> (f64, usize) {
        let mut count = 0;
        let root = increasing_root(start, |x| {
            count += 1;
            h(x)
        });
        (root.expect("a root"), count)
    }

    #[test]
    fn smooth_functions_cost_few_evaluations() {
        let (root, count) = counted(0.0, |x| (x - 3.5, 1.0));
        assert_eq!((root, count), (3.5, 2));
        let (root, count) = counted(1.0, |x| (x * x * x - 8.0, 3.0 * x * x));
        assert!((root - 2.0).abs() < 1e-15 && count <= 14, "{root} {count}");
        let (root, count) = counted(-700.0, |x| (1.0 - (-x).exp(), (-x).exp()));
        assert!(root.abs() < 1e-15 && count <= 40, "{root} {count}");
    }

    #[test]
    fn jumps_are_located() {
        for jump in [-1e200, -3.0, -1e-300, 0.0, 1e-310, 1e-5, 7.0, 1e300] {
            let (root, count) = counted(2.0, |x| (if x < jump { -1.0 } else { 1.0 }, 0.0));
            assert!((root - jump).abs() <= 1e-15 * jump.abs(), "{root} {jump}");
            assert!(count < 700, "{count}");
        }
    }

    #[test]
    fn infinities_and_useless_slopes_do_no_harm() {
        for slope in [0.0, -1.0, 1e300, 1e-300, f64::INFINITY, f64::NAN] {
            let (root, count) = counted(-900.0, |x| (x.exp() - (-x).exp(), slope));
            assert!(root.abs() < 1e-15 && count < 250, "{root} {count} {slope}");
        }
    }

    #[test]
    fn failures_carry_numbers() {
        assert!(matches!(
            increasing_root(f64::NAN, |x| (x, 1.0)),
            Err(StateError::NoRoot { start, .. }) if start.is_nan()
        ));
        assert!(matches!(
            increasing_root(1.0, |_| (f64::NAN, 1.0)),
            Err(StateError::NoRoot { start: 1.0, argument: 1.0, value }) if value.is_nan()
        ));
        assert!(matches!(
            increasing_root(1.0, |x| (-(-x).exp() - 1.0, (-x).exp())),
            Err(StateError::NoRoot { start: 1.0, argument, value: -1.0 }) if argument > 1e300
        ));
    }

    #[test]
    fn middle_float_halves_the_count() {
        assert_eq!(
            middle_float(1.0, 1.0f64.next_up().next_up()),
            1.0f64.next_up()
        );
        assert_eq!(middle_float(-2.0, 2.0), 0.0);
        assert_eq!(middle_float(-4.0, -1.0), -2.0);
    }
}

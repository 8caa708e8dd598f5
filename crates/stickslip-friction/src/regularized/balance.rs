//! The local problem of regularised friction, without a branch, of some nodes.

use stickslip_core::lanes::elementary::{cosh_sinh, exp, exp_m1, rough_exp, rough_ln};

/// The `ln(c/2)` from which on friction is less than rounding of the traction: `y/t = c/(1 + c)`.
const VISCOUS: f64 = 40.0;
/// The `t/(1 + c)` below which the guess is that for small `s`.
const NEAR: f64 = 2.4;
/// The `t + ln(c/2)` below which `y` is nearly zero.
const LOCKED: f64 = -4.0;

/// `y = c sinh(s) >= 0` with `s + c sinh(s) = t`, for `t >= 0` and `l = ln(c/2)`, of each cell.
///
/// A [`guess`] that is off by less than 0.05, a step of Halley's method to `1e-5`, and one of Chebyshev's, also of third
/// order, to rounding. Both move `y = c sinh(s)` and `w = c cosh(s)` by the addition theorems: `exp` enters twice.
/// Sums are of numbers of the size of `y`, `s - t` and not `s`, so `ln y` inherits the rounding of `l + s` alone.
///
/// `y` below `exp(-708)` is 0. NaN and an infinite `t` give NaN.
///
/// Each stage is a loop of its own: operations of one cell wait for each other, and a processor sees too few of the next
/// cells if all stages are in one loop. It took 20 ns per cell with AVX2, and takes 12.
#[inline(always)]
pub(super) fn balance<const N: usize>(t: &[f64; N], l: &[f64; N]) -> [f64; N] {
    let (mut s, mut y, mut w) = ([0.0; N], [0.0; N], [0.0; N]);
    for i in 0..N {
        s[i] = guess(t[i], bounded(l[i]));
    }
    // c exp(s)/2, then exp(-2 s) - 1.
    for i in 0..N {
        w[i] = exp(bounded(l[i]) + s[i]);
    }
    for i in 0..N {
        y[i] = exp_m1(-2.0 * s[i]);
    }
    for i in 0..N {
        let (upper, difference) = (w[i], y[i]);
        [y[i], w[i]] = [-upper * difference, upper * (2.0 + difference)];
        // F = s + y - t, F' = 1 + w, F'' = y.
        let apart = s[i] - t[i];
        let inverse = 1.0 / (1.0 + w[i]);
        let newton = (apart + y[i]) * inverse;
        let curved = 0.5 * newton * (y[i] * inverse);
        // Halley's 1/(1 - curved), to curved^3 < 2e-5.
        let step = -newton * (1.0 + curved * (1.0 + curved));
        [y[i], w[i]] = moved([y[i], w[i]], cosh_sinh(step));
        // s - t after the step.
        s[i] = apart + step;
    }
    for i in 0..N {
        let inverse = 1.0 / (1.0 + w[i]);
        let newton = (s[i] + y[i]) * inverse;
        let step = -newton * (1.0 + 0.5 * newton * (y[i] * inverse));
        let square = step * step;
        // step^4/24 is below rounding.
        let moves = [1.0 + 0.5 * square, step * (1.0 + square / 6.0)];
        [y[i], _] = moved([y[i], w[i]], moves);
    }
    y
}

#[inline(always)]
fn bounded(l: f64) -> f64 {
    if l > VISCOUS { VISCOUS } else { l }
}

/// `c [sinh, cosh](s + d)` from those at `s`.
#[inline(always)]
fn moved([y, w]: [f64; 2], [cosh, sinh]: [f64; 2]) -> [f64; 2] {
    [y * cosh + w * sinh, w * cosh + y * sinh]
}

/// `s` to 0.05, and to 2 % of it where it is small.
///
/// - Small: with `x = t/(1 + c)` and `f = c/(1 + c)`, `(1 - f) s + f sinh(s) = x`; a polynomial in `x` and `f`, fitted by
///   least squares with weights to an error of 0.03 for `x < 2.4`.
/// - Else `exp(-s)` does not count: `v + exp(v) = q` for `v = ln y = l + s` and `q = t + l`. Above `q = 1`,
///   `v = ln(q) (1 - 1/(1 + q))`, off by 0.04 at most; below, a cubic for `y`, fitted on `-4 < q < 1` to 0.005.
#[inline(always)]
fn guess(t: f64, l: f64) -> f64 {
    let c = 2.0 * rough_exp(l);
    let inverse = 1.0 / (1.0 + c);
    let (x, f) = (t * inverse, c * inverse);
    let square = x * x;
    let bend = f * (0.1581 - f * (0.121 + 0.0098 * square - 0.0745 * f));
    let near = x - x * square * bend;
    let q = t + l;
    let above = if q > 1.0 { q } else { 1.0 };
    let sliding = rough_ln(above) * (above / (1.0 + above)) - l;
    let below = if q < LOCKED { LOCKED } else { q };
    let slow = t - (0.5652 + below * (0.3551 + below * (0.0775 + below * 0.0057)));
    let far = if q > 1.0 { sliding } else { slow };
    if x < NEAR { near } else { far }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::regularized::double::Double;

    /// The balance of one cell.
    fn balance(t: f64, l: f64) -> f64 {
        let [y] = super::balance(&[t], &[l]);
        y
    }

    /// The error of `ln y`, by the defining equation in numbers of 106 bits.
    ///
    /// With `s = t - y`, `G = ln(2 sinh s) + l - ln y` vanishes at the solution, and `dG/d(ln y) = -(1 + y coth s)`: the
    /// error is `G/(1 + y coth s)` up to its square. Logarithms are of ratios next to 1.
    fn error(t: f64, l: f64, y: f64) -> f64 {
        let s = Double::from(t) - Double::from(y);
        let log = y.ln();
        let lower = (s * Double::from(-2.0)).exp();
        let rate = (s + Double::from(l) - Double::from(log)).exp() * (Double::from(1.0) - lower);
        let of_y = Double::from(y) * Double::from(-log).exp();
        let ratio = ((rate - of_y) / of_y).value();
        let coth = (1.0 + lower.value()) / (Double::from(1.0) - lower).value();
        ratio / (1.0 + y * coth)
    }

    /// What one rounding of `t` and of `l` does to `ln y` at most, where `s > 3`; 1e-13 elsewhere.
    fn check(t: f64, l: f64) -> Result<(), TestCaseError> {
        let y = balance(t, l);
        if y == 0.0 {
            prop_assert!(t + l < -700.0, "{t:e} {l:e}");
            return Ok(());
        }
        prop_assert!(y > 0.0 && y <= t, "{t:e} {l:e} {y:e}");
        if y.ln() < -700.0 {
            return Ok(());
        }
        let error = error(t, l, y).abs();
        let bound = if t - y > 3.0 {
            0.5 * f64::EPSILON * (t + l.abs())
        } else {
            1e-13
        };
        prop_assert!(
            error <= bound,
            "t = {t:e}, l = {l:e}: {error:e} above {bound:e}"
        );
        Ok(())
    }

    proptest! {
            #![proptest_config(ProptestConfig { cases: 20_000, ..ProptestConfig::default() })]

            #[test]
            fn solutions_are_exact_to_rounding(log in -6.0..3.0, l in -1000.0..8.0) {
                check(10_f64.powf(log), l)?;
            }

            /// Where rates count: `t + l` of some tens.
            #[test]
            fn faults_that_move_are_exact_to_rounding(log in -6.0..3.0, q in -40.0..12.0) {
                let t = 10_f64.powf(log);
                let l = f64::min(q - t, 8.0);
                check(t, l)?;
            }

            /// Next to the places where formulas change: `t/(1 + c)` of 2.4, `t + l` of 1 and of -4.
            #[test]
            fn changes_of_formula_do_not_show(l in -30.0..8.0, place in 0..3_usize, off in -1e-3..1e-3) {
                let c = 2.0 * f64::exp(l);
                let t = [NEAR * (1.0 + c), 1.0 - l, LOCKED - l][place] + off;
                if t > 1e-6 && t < 1e3 {
                    check(t, l)?;
                }
            }

            #[test]
            fn guesses_are_near(log in -6.0..3.0, l in -100.0..40.0) {
                let t = 10_f64.powf(log);
                // The root of an increasing function, by bisection.
                let (mut low, mut high) = (0.0, t);
                for _ in 0..200 {
                    let middle = 0.5 * (low + high);
    let y = 2.0 * f64::exp(l) * middle.sinh();
                    if middle + y < t { low = middle } else { high = middle }
                }
                let error = (guess(t, l) - low).abs();
                prop_assert!(error < 0.05 && (low > 0.125 || error < 0.02 * low), "{t:e} {l:e} {low:e} {error:e}");
            }
        }

    #[test]
    fn limits_are_closed() {
        assert_eq!(balance(0.0, -3.0), 0.0);
        assert_eq!(balance(0.0, 900.0), 0.0);
        // Viscous throughout: y = t; without friction at all.
        for t in [1e-200, 1e-6, 1.0, 1e200] {
            for l in [40.0, 500.0, f64::INFINITY] {
                assert!((balance(t, l) / t - 1.0).abs() <= 2.0 * f64::EPSILON);
            }
        }
        assert_eq!(balance(10.0, f64::NEG_INFINITY), 0.0);
        assert_eq!(balance(1.0, -1000.0), 0.0);
        for (t, l) in [
            (f64::NAN, 0.0),
            (1.0, f64::NAN),
            (1e3, f64::NAN),
            (f64::INFINITY, 0.0),
        ] {
            assert!(balance(t, l).is_nan());
        }
    }
}

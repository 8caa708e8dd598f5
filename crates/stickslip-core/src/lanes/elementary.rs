//! Exponentials and logarithms without branches and tables, in operations that every processor has for vectors.
//!
//! Comparisons only select. A NaN is no side of a comparison and stays one.

use std::f64::consts::{LOG2_E, SQRT_2};

/// `1.5 2^52`: a sum with it has an integer in the last bits of its significand.
const SHIFT: f64 = 6_755_399_441_055_744.0;
/// `ln 2` in two parts; the first has 32 trailing zeros: its product with an exponent is exact.
const LN_2: [f64; 2] = [
    f64::from_bits(0x3fe6_2e42_fee0_0000),
    f64::from_bits(0x3dea_39ef_3579_3c76),
];
/// The bias of exponents.
const BIAS: u64 = 1023;
/// The number of bits of a significand that are stored.
const SIGNIFICAND: u32 = 52;
/// Arguments of exponentials that are normal numbers.
const NORMAL: [f64; 2] = [-708.0, 709.0];

/// `sum_k c_k x^k`, even and odd powers side by side.
#[inline(always)]
fn polynomial<const N: usize>(x: f64, coefficients: [[f64; 2]; N]) -> f64 {
    let square = x * x;
    let [mut even, mut odd] = coefficients[N - 1];
    for k in (0..N - 1).rev() {
        even = even * square + coefficients[k][0];
        odd = odd * square + coefficients[k][1];
    }
    even + x * odd
}

/// `exp(x)`, to two units in the last place: 0 below -708, `exp(709)` above 709.
#[inline(always)]
pub fn exp(x: f64) -> f64 {
    let [r, power] = reduced(x);
    let value = (1.0 + exp_m1_of_rest(r)) * power;
    if x < NORMAL[0] { 0.0 } else { value }
}

/// `exp(x) - 1` for `x <= 0`, to two units in the last place.
///
/// It is `(2^n - 1) + 2^n (exp(r) - 1)`, two numbers of one sign unless `n = 0`, where the first vanishes.
#[inline(always)]
pub fn exp_m1(x: f64) -> f64 {
    let [r, power] = reduced(x);
    (power - 1.0) + power * exp_m1_of_rest(r)
}

/// `exp(r) - 1` for `abs(r) <= ln(2)/2`, by Taylor's polynomial of degree 13; the remainder is below `2e-17 abs(r)`.
#[inline(always)]
fn exp_m1_of_rest(r: f64) -> f64 {
    const FACTORIALS: [[f64; 2]; 6] = [
        [1.0 / 2.0, 1.0 / 6.0],
        [1.0 / 24.0, 1.0 / 120.0],
        [1.0 / 720.0, 1.0 / 5_040.0],
        [1.0 / 40_320.0, 1.0 / 362_880.0],
        [1.0 / 3_628_800.0, 1.0 / 39_916_800.0],
        [1.0 / 479_001_600.0, 1.0 / 6_227_020_800.0],
    ];
    r + r * r * polynomial(r, FACTORIALS)
}

/// `exp(x)` to 1e-4 of it, with the same ends.
#[inline(always)]
pub fn rough_exp(x: f64) -> f64 {
    let [r, power] = reduced(x);
    let value = (1.0 + r * (1.0 + r * (0.5 + r * (1.0 / 6.0 + r * (1.0 / 24.0))))) * power;
    if x < NORMAL[0] { 0.0 } else { value }
}

/// `[r, 2^n]` with `x = n ln(2) + r`, of the nearest argument within [`NORMAL`].
#[inline(always)]
fn reduced(x: f64) -> [f64; 2] {
    let bounded = if x > NORMAL[1] { NORMAL[1] } else { x };
    let bounded = if bounded < NORMAL[0] {
        NORMAL[0]
    } else {
        bounded
    };
    let shifted = bounded * LOG2_E + SHIFT;
    let n = shifted - SHIFT;
    let r = (bounded - n * LN_2[0]) - n * LN_2[1];
    let power = shifted.to_bits().wrapping_add(BIAS) << SIGNIFICAND;
    [r, f64::from_bits(power)]
}

/// `ln(x)` of a normal number `x > 0`, to two units in the last place; a finite number for all others.
///
/// `x = 2^k (1 + f)` with `1 + f` from `sqrt(1/2)` to `sqrt(2)`, and the series `2 atanh(s)`, `s = f/(2 + f)`, to the
/// power 21; the remainder is below `1e-18 f`. The order of the sum is that of FreeBSD's `e_log.c`:
/// `ln(1 + f) = f - (f^2/2 - s (f^2/2 + R))`.
#[inline(always)]
pub fn ln(x: f64) -> f64 {
    const SERIES: [[f64; 2]; 5] = [
        [2.0 / 3.0, 2.0 / 5.0],
        [2.0 / 7.0, 2.0 / 9.0],
        [2.0 / 11.0, 2.0 / 13.0],
        [2.0 / 15.0, 2.0 / 17.0],
        [2.0 / 19.0, 2.0 / 21.0],
    ];
    let [k, f] = parts(x);
    let s = f / (2.0 + f);
    let z = s * s;
    let rest = z * polynomial(z, SERIES);
    let half_square = 0.5 * f * f;
    k * LN_2[0] - ((half_square - (s * (half_square + rest) + k * LN_2[1])) - f)
}

/// `ln(x)` of a normal number `x > 0`, to 0.005.
#[inline(always)]
pub fn rough_ln(x: f64) -> f64 {
    let [k, f] = parts(x);
    k * LN_2[0] + f * (1.0 - f * (0.5 - 0.3 * f))
}

/// `[k, f]` with `x = 2^k (1 + f)` and `1 + f` from `sqrt(1/2)` to `sqrt(2)`.
#[inline(always)]
fn parts(x: f64) -> [f64; 2] {
    /// `2^52` and the bias.
    const SHIFTED: f64 = 4_503_599_627_370_496.0 + BIAS as f64;
    let one = BIAS << SIGNIFICAND;
    let bits = x.to_bits();
    let half_root = (0.5 * SQRT_2).to_bits();
    let exponent = bits.wrapping_sub(half_root).wrapping_add(one) >> SIGNIFICAND;
    let k = f64::from_bits(exponent | 4_503_599_627_370_496_f64.to_bits()) - SHIFTED;
    let scaled = bits.wrapping_sub(exponent << SIGNIFICAND).wrapping_add(one);
    [k, f64::from_bits(scaled) - 1.0]
}

/// `[cosh(x), sinh(x)]` for `abs(x) <= 0.05`, by Taylor's polynomials of degree 8 and 7; the remainders are below `3e-20`
/// and `2e-16 abs(x)`.
#[inline(always)]
pub fn cosh_sinh(x: f64) -> [f64; 2] {
    let z = x * x;
    let cosh = 1.0 / 24.0 + z * (1.0 / 720.0 + z * (1.0 / 40_320.0));
    let cosh = 1.0 / 2.0 + z * cosh;
    let sinh = 1.0 / 6.0 + z * (1.0 / 120.0 + z * (1.0 / 5_040.0));
    [1.0 + z * cosh, x + x * z * sinh]
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    proptest! {
        #![proptest_config(ProptestConfig { cases: 20_000, ..ProptestConfig::default() })]

        #[test]
        fn exponentials_are_those_of_the_library(x in prop_oneof![-708.0..709.0, -1.0..1.0, -1e-9..1e-9]) {
            let exact = f64::exp(x);
            prop_assert!((exp(x) - exact).abs() <= 2.0 * f64::EPSILON * exact, "{} {}", exp(x), exact);
            prop_assert!((rough_exp(x) - exact).abs() <= 1e-4 * exact);
        }

        #[test]
        fn differences_of_exponentials_to_one_are_those_of_the_library(x in prop_oneof![-800.0..0.0, -1.0..0.0, -1e-9..0.0]) {
            let exact = f64::exp_m1(x);
            prop_assert!((exp_m1(x) - exact).abs() <= 2.0 * f64::EPSILON * exact.abs(), "{} {}", exp_m1(x), exact);
        }

        #[test]
        fn logarithms_are_those_of_the_library(
            x in prop_oneof![(-700.0..700.0).prop_map(f64::exp), 0.5..2.0, 1.0 - 1e-6..1.0 + 1e-6],
        ) {
            let exact = f64::ln(x);
            prop_assert!((ln(x) - exact).abs() <= 2.0 * f64::EPSILON * exact.abs(), "{} {}", ln(x), exact);
            prop_assert!((rough_ln(x) - exact).abs() < 0.005);
        }

        #[test]
        fn hyperbolic_functions_are_those_of_the_library(x in prop_oneof![-0.05..0.05, -1e-9..1e-9]) {
            let [cosh, sinh] = cosh_sinh(x);
            prop_assert!((cosh - x.cosh()).abs() <= 2.0 * f64::EPSILON);
            prop_assert!((sinh - x.sinh()).abs() <= 2.0 * f64::EPSILON * x.abs());
        }
    }

    #[test]
    fn ends_of_the_range_are_values() {
        assert_eq!((exp(0.0), exp(-0.0), ln(1.0)), (1.0, 1.0, 0.0));
        assert_eq!((exp(-709.0), exp(f64::NEG_INFINITY)), (0.0, 0.0));
        assert_eq!(exp(f64::INFINITY), exp(709.0));
        assert!(exp(f64::NAN).is_nan() && exp_m1(f64::NAN).is_nan());
        assert_eq!((exp_m1(0.0), exp_m1(f64::NEG_INFINITY)), (0.0, -1.0));
        for x in [0.0, -0.0, 1e-310, -1.0, f64::INFINITY, f64::NAN] {
            assert!(ln(x).is_finite());
        }
    }
}

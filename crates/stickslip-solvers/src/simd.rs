//! SIMD passes over columns, inlined into code that is compiled for the widest registers.

use pulp::Simd;

/// Independent sums in one product.
const CHAINS: usize = 4;

// Loops, not closures: these would not be compiled for the wide registers.

/// `x -= columns * known`.
#[inline(always)]
pub(crate) fn subtract<S: Simd, const N: usize>(
    simd: S,
    columns: [&[f64]; N],
    known: [f64; N],
    x: &mut [f64],
) {
    let count = x.len();
    let (xs, x) = S::as_mut_simd_f64s(x);
    let parts = columns.map(|column| S::as_simd_f64s(&column[..count]));
    let mut factors = [simd.splat_f64s(0.0); N];
    for k in 0..N {
        factors[k] = simd.splat_f64s(known[k]);
    }
    for (i, x) in xs.iter_mut().enumerate() {
        for k in 0..N {
            *x = simd.negate_mul_add_e_f64s(parts[k].0[i], factors[k], *x);
        }
    }
    for (i, x) in x.iter_mut().enumerate() {
        for k in 0..N {
            *x -= parts[k].1[i] * known[k];
        }
    }
}

/// Products of the columns with `x`.
#[inline(always)]
pub(crate) fn products<S: Simd, const N: usize>(
    simd: S,
    columns: [&[f64]; N],
    x: &[f64],
) -> [f64; N] {
    let parts = columns.map(|column| S::as_simd_f64s(&column[..x.len()]));
    let (xs, x) = S::as_simd_f64s(x);
    let mut sums = [simd.splat_f64s(0.0); N];
    for (i, x) in xs.iter().enumerate() {
        for k in 0..N {
            sums[k] = simd.mul_add_e_f64s(parts[k].0[i], *x, sums[k]);
        }
    }
    let mut products = [0.0; N];
    for k in 0..N {
        products[k] = simd.reduce_sum_f64s(sums[k]);
        for (i, x) in x.iter().enumerate() {
            products[k] += parts[k].1[i] * x;
        }
    }
    products
}

/// `x . y`.
#[inline(always)]
pub(crate) fn product<S: Simd>(simd: S, x: &[f64], y: &[f64]) -> f64 {
    let (xs, x) = S::as_simd_f64s(&x[..y.len()]);
    let (ys, y) = S::as_simd_f64s(y);
    let mut sums = [simd.splat_f64s(0.0); CHAINS];
    let (x_fours, x_ones) = xs.as_chunks::<CHAINS>();
    let (y_fours, y_ones) = ys.as_chunks::<CHAINS>();
    for (x, y) in x_fours.iter().zip(y_fours) {
        for k in 0..CHAINS {
            sums[k] = simd.mul_add_e_f64s(x[k], y[k], sums[k]);
        }
    }
    for (x, y) in x_ones.iter().zip(y_ones) {
        sums[0] = simd.mul_add_e_f64s(*x, *y, sums[0]);
    }
    let [a, b, c, d] = sums;
    let sum = simd.add_f64s(simd.add_f64s(a, b), simd.add_f64s(c, d));
    let tail: f64 = x.iter().zip(y).map(|(x, y)| x * y).sum();
    simd.reduce_sum_f64s(sum) + tail
}

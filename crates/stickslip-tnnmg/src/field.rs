//! Vector operations on fields.

use nalgebra::SVector;

/// `sum_p a_p . b_p`.
pub(crate) fn dot<const C: usize>(a: &[SVector<f64, C>], b: &[SVector<f64, C>]) -> f64 {
    let mut product = SVector::<f64, C>::zeros();
    for (a, b) in a.iter().zip(b) {
        product += a.component_mul(b);
    }
    product.sum()
}

/// A step of two fields in one pass: `a += factor x`, `b -= factor y`.
#[cfg(feature = "multigrid")]
pub(crate) fn add_scaled_pair<const C: usize>(
    (a, b): (&mut [SVector<f64, C>], &mut [SVector<f64, C>]),
    factor: f64,
    (x, y): (&[SVector<f64, C>], &[SVector<f64, C>]),
) {
    for (((a, b), x), y) in a.iter_mut().zip(b).zip(x).zip(y) {
        *a += x * factor;
        *b -= y * factor;
    }
}

/// Two fields renewed in one pass, `a = factor a + x`, `b = factor b + y`, and their product
/// `sum_p a_p . b_p`.
#[cfg(feature = "multigrid")]
pub(crate) fn scale_and_add_pair<const C: usize>(
    (a, b): (&mut [SVector<f64, C>], &mut [SVector<f64, C>]),
    factor: f64,
    (x, y): (&[SVector<f64, C>], &[SVector<f64, C>]),
) -> f64 {
    let mut product = SVector::<f64, C>::zeros();
    for (((a, b), x), y) in a.iter_mut().zip(b).zip(x).zip(y) {
        *a = *a * factor + x;
        *b = *b * factor + y;
        product += a.component_mul(b);
    }
    product.sum()
}

/// Sets the components of `x` under the mask to zero.
#[inline(always)]
pub(crate) fn clear_masked<const C: usize>(x: &mut SVector<f64, C>, mask: &[bool; C]) {
    for c in 0..C {
        if mask[c] {
            x[c] = 0.0;
        }
    }
}

/// Products of some columns with a vector, each in independent lanes.
#[cfg(any(feature = "multigrid", feature = "condensed"))]
#[inline(always)]
pub(crate) fn dots<const LANES: usize, const N: usize>(
    columns: [&[f64]; N],
    x: &[f64],
) -> [f64; N] {
    let mut sums = [[0.0; LANES]; N];
    let whole = x.len() - x.len() % LANES;
    for i in (0..whole).step_by(LANES) {
        let x: &[f64] = &x[i..i + LANES];
        for k in 0..N {
            let column = &columns[k][i..i + LANES];
            for l in 0..LANES {
                sums[k][l] += column[l] * x[l];
            }
        }
    }
    std::array::from_fn(|k| {
        let tail: f64 = (whole..x.len()).map(|i| columns[k][i] * x[i]).sum();
        sums[k].iter().sum::<f64>() + tail
    })
}

//! Vector operations on fields.

use nalgebra::SVector;

/// `sum_p a_p . b_p`.
#[cfg(feature = "multigrid")]
pub(crate) fn dot<const C: usize>(a: &[SVector<f64, C>], b: &[SVector<f64, C>]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a.dot(b)).sum()
}

/// `y += factor x`.
#[cfg(feature = "multigrid")]
pub(crate) fn add_scaled<const C: usize>(
    y: &mut [SVector<f64, C>],
    factor: f64,
    x: &[SVector<f64, C>],
) {
    for (y, x) in y.iter_mut().zip(x) {
        *y += x * factor;
    }
}

/// `y = factor y + x`.
#[cfg(feature = "multigrid")]
pub(crate) fn scale_and_add<const C: usize>(
    y: &mut [SVector<f64, C>],
    factor: f64,
    x: &[SVector<f64, C>],
) {
    for (y, x) in y.iter_mut().zip(x) {
        *y = *y * factor + x;
    }
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

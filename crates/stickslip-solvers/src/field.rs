//! Vector operations on fields.

use nalgebra::SVector;

#[cfg(feature = "multigrid")]
use crate::parts::for_parts;
use crate::parts::sum_parts;

/// `sum_p a_p . b_p`.
pub(crate) fn dot<const C: usize>(a: &[SVector<f64, C>], b: &[SVector<f64, C>]) -> f64 {
    sum_parts(0..a.len().min(b.len()), (), &|part, ()| {
        let mut product = SVector::<f64, C>::zeros();
        for (a, b) in a[part.clone()].iter().zip(&b[part]) {
            product += a.component_mul(b);
        }
        product.sum()
    })
}

/// An update of two fields in one pass: `a += factor x`, `b -= factor y`.
#[cfg(feature = "multigrid")]
pub(crate) fn add_scaled_pair<const C: usize>(
    (a, b): (&mut [SVector<f64, C>], &mut [SVector<f64, C>]),
    factor: f64,
    (x, y): (&[SVector<f64, C>], &[SVector<f64, C>]),
) {
    for_parts(0..a.len(), (a, b), &|part, (a, b)| {
        let others = x[part.clone()].iter().zip(&y[part]);
        for ((a, b), (x, y)) in a.iter_mut().zip(b).zip(others) {
            *a += x * factor;
            *b -= y * factor;
        }
    });
}

/// An update of two fields in one pass, `a = factor a + x`, `b = factor b + y`, and their product `sum_p a_p . b_p`.
#[cfg(feature = "multigrid")]
pub(crate) fn scale_and_add_pair<const C: usize>(
    (a, b): (&mut [SVector<f64, C>], &mut [SVector<f64, C>]),
    factor: f64,
    (x, y): (&[SVector<f64, C>], &[SVector<f64, C>]),
) -> f64 {
    sum_parts(0..a.len(), (a, b), &|part, (a, b)| {
        let mut product = SVector::<f64, C>::zeros();
        let others = x[part.clone()].iter().zip(&y[part]);
        for ((a, b), (x, y)) in a.iter_mut().zip(b).zip(others) {
            *a = *a * factor + x;
            *b = *b * factor + y;
            product += a.component_mul(b);
        }
        product.sum()
    })
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

//! SIMD passes over the columns of a dense symmetric matrix.

use pulp::{Arch, Simd, WithSimd};

use crate::simd;

/// `y -= column * x`.
pub(super) fn subtract(column: &[f64], x: f64, y: &mut [f64]) {
    Arch::new().dispatch(Subtract { column, x, y });
}

/// `x . y`.
pub(super) fn dot(x: &[f64], y: &[f64]) -> f64 {
    Arch::new().dispatch(Dot { x, y })
}

/// `x . S x`, from the triangle on and below the diagonal.
pub(super) fn quadratic(matrix: &[f64], x: &[f64]) -> f64 {
    Arch::new().dispatch(Quadratic { matrix, x })
}

struct Quadratic<'a> {
    matrix: &'a [f64],
    x: &'a [f64],
}

impl WithSimd for Quadratic<'_> {
    type Output = f64;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> f64 {
        let Self { matrix, x } = self;
        let mut square = 0.0;
        for (j, column) in matrix.chunks_exact(x.len().max(1)).enumerate() {
            let below = simd::product(simd, &column[j + 1..], &x[j + 1..]);
            square += x[j] * (2.0 * below + column[j] * x[j]);
        }
        square
    }
}

struct Subtract<'a> {
    column: &'a [f64],
    x: f64,
    y: &'a mut [f64],
}

impl WithSimd for Subtract<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        simd::subtract(simd, [self.column], [self.x], self.y);
    }
}

struct Dot<'a> {
    x: &'a [f64],
    y: &'a [f64],
}

impl WithSimd for Dot<'_> {
    type Output = f64;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> f64 {
        simd::product(simd, self.x, self.y)
    }
}

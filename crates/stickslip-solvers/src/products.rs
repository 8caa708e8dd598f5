//! Products with a compressed matrix, by rows.

use nalgebra::{SMatrix, SVector};
use pulp::{Arch, Simd, WithSimd};

use crate::block_matrix::{Rows, row_product};
use crate::parts::{for_parts, sum_parts};

/// The entry of a matrix for a pair of vertices with `C` components each.
pub(crate) trait Entry<const C: usize>: Copy + Send + Sync {
    /// The entry times a vector.
    fn times(&self, x: &SVector<f64, C>) -> SVector<f64, C>;

    /// `(A x)_row`.
    fn row_product(rows: &Rows<'_, Self>, row: usize, x: &[SVector<f64, C>]) -> SVector<f64, C>;
}

impl<const C: usize> Entry<C> for SMatrix<f64, C, C> {
    #[inline(always)]
    fn times(&self, x: &SVector<f64, C>) -> SVector<f64, C> {
        self * x
    }

    #[inline(always)]
    fn row_product(rows: &Rows<'_, Self>, row: usize, x: &[SVector<f64, C>]) -> SVector<f64, C> {
        row_product(rows, row, x)
    }
}

/// A multiple of the unit matrix, in the order in which a product of blocks adds.
impl<const C: usize> Entry<C> for f64 {
    #[inline(always)]
    fn times(&self, x: &SVector<f64, C>) -> SVector<f64, C> {
        x * *self
    }

    #[inline(always)]
    fn row_product(rows: &Rows<'_, Self>, row: usize, x: &[SVector<f64, C>]) -> SVector<f64, C> {
        let mut sums = [0.0; C];
        for (j, number) in rows.row(row) {
            let x_j = &x[j].data.0[0];
            for c in 0..C {
                sums[c] += number * x_j[c];
            }
        }
        SVector::from(sums)
    }
}

/// The rows of a product from `first` on.
struct Product<'a, T, const C: usize> {
    rows: Rows<'a, T>,
    first: usize,
    scale: f64,
    x: &'a [SVector<f64, C>],
    y: &'a mut [SVector<f64, C>],
}

impl<T: Entry<C>, const C: usize> WithSimd for Product<'_, T, C> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        for (i, y) in self.y.iter_mut().enumerate() {
            *y += T::row_product(&self.rows, self.first + i, self.x) * self.scale;
        }
    }
}

/// `y += scale A x`.
pub(crate) fn multiply_add<T: Entry<C>, const C: usize>(
    rows: Rows<'_, T>,
    scale: f64,
    x: &[SVector<f64, C>],
    y: &mut [SVector<f64, C>],
) {
    if rows.is_diagonal() {
        return multiply_add_diagonal(rows.values, scale, x, y);
    }
    let arch = Arch::new();
    for_parts(0..y.len(), y, &|part, y| {
        let first = part.start;
        arch.dispatch(Product {
            rows,
            first,
            scale,
            x,
            y,
        });
    });
}

/// `y += scale A x` of a diagonal matrix: nothing to look up.
pub(crate) fn multiply_add_diagonal<T: Entry<C>, const C: usize>(
    entries: &[T],
    scale: f64,
    x: &[SVector<f64, C>],
    y: &mut [SVector<f64, C>],
) {
    for_parts(0..y.len(), y, &|part, y| {
        let (entries, x) = (&entries[part.clone()], &x[part]);
        for ((y, entry), x) in y.iter_mut().zip(entries).zip(x) {
            *y += entry.times(x) * scale;
        }
    });
}

/// `x . A x`.
pub(crate) fn quadratic<T: Entry<C>, const C: usize>(
    rows: Rows<'_, T>,
    x: &[SVector<f64, C>],
) -> f64 {
    sum_parts(0..x.len(), (), &|part, ()| {
        part.map(|i| x[i].dot(&T::row_product(&rows, i, x))).sum()
    })
}

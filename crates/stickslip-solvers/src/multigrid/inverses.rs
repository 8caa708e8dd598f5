//! The inverses of diagonal blocks, whole or by half.

use std::fmt::Debug;

use nalgebra::{SMatrix, SVector};

/// One symmetric inverse per row.
pub(super) trait Inverses<const C: usize>: Debug {
    /// So many zero blocks.
    fn zeros(rows: usize) -> Self;

    fn set(&mut self, i: usize, inverse: &SMatrix<f64, C, C>);

    /// The inverse of row `i` times a vector.
    fn times(&self, i: usize, x: &SVector<f64, C>) -> SVector<f64, C>;
}

/// As they are.
impl<const C: usize> Inverses<C> for Vec<SMatrix<f64, C, C>> {
    fn zeros(rows: usize) -> Self {
        vec![SMatrix::zeros(); rows]
    }

    fn set(&mut self, i: usize, inverse: &SMatrix<f64, C, C>) {
        self[i] = *inverse;
    }

    #[inline(always)]
    fn times(&self, i: usize, x: &SVector<f64, C>) -> SVector<f64, C> {
        self[i] * x
    }
}

/// The entries on and below the diagonal, by rows, in double precision.
///
/// The residual of a row follows from the changes after it, since the row was balanced. An inverse in single precision
/// leaves a share of 6e-8 of the force of a row, also under a translation: on fine meshes far more than the rounded
/// couplings do, whose errors the diagonal blocks take up.
#[derive(Debug)]
pub(super) struct LowerTriangles<const C: usize>(Vec<f64>);

impl<const C: usize> LowerTriangles<C> {
    /// The number of entries of a block.
    const COUNT: usize = C * (C + 1) / 2;
}

/// The position of an entry on or below the diagonal.
#[inline(always)]
fn place(row: usize, column: usize) -> usize {
    row * (row + 1) / 2 + column
}

impl<const C: usize> Inverses<C> for LowerTriangles<C> {
    fn zeros(rows: usize) -> Self {
        Self(vec![0.0; rows * Self::COUNT])
    }

    fn set(&mut self, i: usize, inverse: &SMatrix<f64, C, C>) {
        let entries = &mut self.0[i * Self::COUNT..][..Self::COUNT];
        for r in 0..C {
            for c in 0..=r {
                entries[place(r, c)] = inverse[(r, c)];
            }
        }
    }

    #[inline(always)]
    fn times(&self, i: usize, x: &SVector<f64, C>) -> SVector<f64, C> {
        let entries = &self.0[i * Self::COUNT..][..Self::COUNT];
        let mut product = SVector::zeros();
        for r in 0..C {
            for c in 0..C {
                product[r] += entries[place(r.max(c), r.min(c))] * x[c];
            }
        }
        product
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::{Matrix3, Vector3};

    use crate::multigrid::inverses::{Inverses, LowerTriangles};

    /// Of small whole numbers, whose products are exact.
    #[test]
    fn halves_of_symmetric_blocks_act_as_the_blocks() {
        let blocks: Vec<_> = (0..4)
            .map(|k| {
                let k = f64::from(k);
                let (a, b, c) = (k + 1.0, 2.0 - k, 3.0 * k);
                Matrix3::new(7.0, a, b, a, 9.0 + k, c, b, c, 5.0)
            })
            .collect();
        let mut halves = LowerTriangles::zeros(blocks.len());
        // In another order than that of the rows: none changes another.
        for i in [2, 0, 3, 1] {
            halves.set(i, &blocks[i]);
        }
        let x = Vector3::new(3.0, -2.0, 11.0);
        for (i, block) in blocks.iter().enumerate() {
            assert_eq!(halves.times(i, &x), block * x);
            assert_eq!(blocks.times(i, &x), block * x);
        }
    }
}

//! The blocks below the diagonal, packed: half of a symmetric matrix, and all that a cycle reads.

use nalgebra::{SMatrix, SVector};

use crate::BlockMatrix;
use crate::block_matrix::{Rows, partial_product};

/// The strictly lower part `L` of a symmetric matrix, by rows.
#[derive(Debug)]
pub(super) struct LowerHalf<const C: usize> {
    starts: Vec<u32>,
    columns: Vec<u32>,
    blocks: Vec<SMatrix<f64, C, C>>,
}

impl<const C: usize> LowerHalf<C> {
    /// The pattern of `matrix` below the diagonal, with zero values.
    pub(super) fn of(matrix: &BlockMatrix<C>) -> Self {
        let rows = Rows::of(matrix);
        let mut starts = vec![0];
        let mut columns = Vec::with_capacity(matrix.nnz().saturating_sub(matrix.rows()) / 2);
        for i in 0..matrix.rows() {
            let row = &rows.columns[rows.range(i)];
            columns.extend(row.iter().take_while(|&&j| (j as usize) < i));
            starts.push(columns.len() as u32);
        }
        Self {
            starts,
            blocks: vec![SMatrix::zeros(); columns.len()],
            columns,
        }
    }

    /// Takes the values of row `i`.
    pub(super) fn copy_row(&mut self, matrix: &BlockMatrix<C>, i: usize) {
        let own = self.range(i);
        let begin = Rows::of(matrix).range(i).start;
        let values = &matrix.data()[begin..begin + own.len()];
        self.blocks[own].copy_from_slice(values);
    }

    #[inline(always)]
    fn range(&self, i: usize) -> std::ops::Range<usize> {
        self.starts[i] as usize..self.starts[i + 1] as usize
    }

    /// `(L x)_i`.
    #[inline(always)]
    pub(super) fn row_product(&self, i: usize, x: &[SVector<f64, C>]) -> SVector<f64, C> {
        let range = self.range(i);
        partial_product(&self.columns[range.clone()], &self.blocks[range], x)
    }

    /// Adds to `sums` what `L^T x` owes to `x_i`; the neighbour closest to `i` comes first.
    #[inline(always)]
    pub(super) fn spread(&self, i: usize, x_i: &SVector<f64, C>, sums: &mut [SVector<f64, C>]) {
        let range = self.range(i);
        let entries = self.columns[range.clone()].iter().zip(&self.blocks[range]);
        for (&j, block) in entries.rev() {
            let sum = &mut sums[j as usize];
            for c in 0..C {
                let mut product = 0.0;
                for r in 0..C {
                    product += block.data.0[c][r] * x_i[r];
                }
                sum[c] += product;
            }
        }
    }
}

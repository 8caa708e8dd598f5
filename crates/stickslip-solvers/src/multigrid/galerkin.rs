//! Galerkin products `P^T H P`, row by row.

use nalgebra::SMatrix;

use super::entries::Entries;
use super::transfer::Transfer;
use crate::block::without;
use crate::block_matrix::Rows;
use crate::parts::{Divide, Each, for_each};
use crate::{BlockMatrix, Frames};

/// The pattern of `P^T H P`, with zero values.
pub(super) fn pattern<const C: usize>(
    fine: &BlockMatrix<C>,
    transfer: &Transfer,
) -> BlockMatrix<C> {
    let rows = Rows::of(fine);
    let parents = Rows::of(&transfer.prolongation);
    let children = Rows::of(&transfer.restriction);
    let size = transfer.restriction.rows();
    let mut seen_by = vec![u32::MAX; size];
    let mut starts = vec![0_u32];
    let mut columns: Vec<u32> = Vec::new();
    for coarse in 0..size {
        let begin = columns.len();
        for (i, _) in children.row(coarse) {
            for (j, _) in rows.row(i) {
                for (parent, _) in parents.row(j) {
                    if seen_by[parent] != coarse as u32 {
                        seen_by[parent] = coarse as u32;
                        columns.push(parent as u32);
                    }
                }
            }
        }
        columns[begin..].sort_unstable();
        starts.push(columns.len() as u32);
    }
    let values = vec![SMatrix::zeros(); columns.len()];
    BlockMatrix::new((size, size), starts, columns, values)
}

/// Some rows of a matrix with a fixed pattern.
pub(super) struct RowsMut<'a, const C: usize> {
    /// The row starts, and the end of the last row, in all columns of the matrix.
    starts: &'a [u32],
    columns: &'a [u32],
    blocks: &'a mut [SMatrix<f64, C, C>],
}

impl<'a, const C: usize> RowsMut<'a, C> {
    /// All rows of a matrix.
    pub(super) fn of(matrix: &'a mut BlockMatrix<C>) -> Self {
        let (starts, columns, blocks) = matrix.view_mut().into_raw_storage();
        Self {
            starts,
            columns,
            blocks,
        }
    }

    /// Columns and blocks of a row, counted from the first one.
    fn row(&mut self, row: usize) -> (&[u32], &mut [SMatrix<f64, C, C>]) {
        let place = |row: usize| (self.starts[row] - self.starts[0]) as usize;
        let range = place(row)..place(row + 1);
        (&self.columns[range.clone()], &mut self.blocks[range])
    }
}

impl<const C: usize> Divide for RowsMut<'_, C> {
    fn divide(self, vertices: usize, _: usize) -> (Self, Self) {
        let cut = (self.starts[vertices] - self.starts[0]) as usize;
        let (columns, blocks) = (self.columns.split_at(cut), self.blocks.split_at_mut(cut));
        let (before, behind) = (&self.starts[..=vertices], &self.starts[vertices..]);
        let part = |starts, columns, blocks| Self {
            starts,
            columns,
            blocks,
        };
        (
            part(before, columns.0, blocks.0),
            part(behind, columns.1, blocks.1),
        )
    }
}

/// `P^T H P` without the components that the coarse level drops.
pub(super) struct Product<'a, const C: usize> {
    pub(super) fine: Entries<'a, C>,
    pub(super) frames: &'a Frames<C>,
    pub(super) transfer: &'a Transfer,
    pub(super) dropped: &'a [[bool; C]],
}

impl<const C: usize> Product<'_, C> {
    /// Overwrites all rows, the parts between `cuts` in parallel; `positions` has room for all columns, once per part.
    pub(super) fn assemble(&self, cuts: &[usize], rows: RowsMut<'_, C>, positions: &mut [u32]) {
        let positions = Each {
            entries: positions,
            per_part: self.dropped.len(),
        };
        for_each(cuts, (rows, positions), &|k, (mut rows, positions)| {
            for row in cuts[k]..cuts[k + 1] {
                self.assemble_row(row, rows.row(row - cuts[k]), positions.entries);
            }
        });
    }

    /// Overwrites one of all rows.
    pub(super) fn renew(&self, row: usize, mut rows: RowsMut<'_, C>, positions: &mut [u32]) {
        self.assemble_row(row, rows.row(row), positions);
    }

    fn assemble_row(
        &self,
        row: usize,
        (columns, blocks): (&[u32], &mut [SMatrix<f64, C, C>]),
        positions: &mut [u32],
    ) {
        let parents = Rows::of(&self.transfer.prolongation);
        let children = Rows::of(&self.transfer.restriction);
        for (&column, k) in columns.iter().zip(0..) {
            positions[column as usize] = k;
        }
        blocks.fill(SMatrix::zeros());
        for (i, &row_weight) in children.row(row) {
            for (j, block) in self.fine.row(i) {
                let block = self.frames.block_to_coordinates((i, j), block);
                for (parent, &column_weight) in parents.row(j) {
                    blocks[positions[parent] as usize] += block * (row_weight * column_weight);
                }
            }
        }
        for (&column, block) in columns.iter().zip(blocks) {
            *block = without(block, &self.dropped[row], &self.dropped[column as usize]);
        }
    }
}

//! Galerkin products `P^T H P`, row by row.

use nalgebra::SMatrix;

use super::level::{Level, Transfer};
use crate::BlockMatrix;
use crate::block::without;
use crate::block_matrix::Rows;

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

/// Overwrites one row of `P^T H P`, with the dropped components of the coarse level left out.
pub(super) fn assemble_row<const C: usize>(
    coarse: &mut Level<C>,
    fine: &Level<C>,
    transfer: &Transfer,
    row: usize,
) {
    let fine_rows = Rows::of(&fine.matrix);
    let parents = Rows::of(&transfer.prolongation);
    let children = Rows::of(&transfer.restriction);
    let range = Rows::of(&coarse.matrix).range(row);
    for k in range.clone() {
        coarse.positions[coarse.matrix.indices()[k] as usize] = k as u32;
    }
    coarse.matrix.data_mut()[range.clone()].fill(SMatrix::zeros());
    let values = coarse.matrix.data_mut();
    for (i, &row_weight) in children.row(row) {
        for (j, block) in fine_rows.row(i) {
            let block = fine.frames.block_to_coordinates((i, j), *block);
            for (parent, &column_weight) in parents.row(j) {
                values[coarse.positions[parent] as usize] += block * (row_weight * column_weight);
            }
        }
    }
    for k in range {
        let j = coarse.matrix.indices()[k] as usize;
        let value = coarse.matrix.data()[k];
        coarse.matrix.data_mut()[k] = without(&value, &coarse.dropped[row], &coarse.dropped[j]);
    }
}

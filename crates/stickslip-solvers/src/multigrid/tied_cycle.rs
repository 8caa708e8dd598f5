//! The cycle on a level with a line smoother: sweeps over the sets, in separate passes.

use nalgebra::{SMatrix, SVector};

use super::level::Level;
use super::transfer::Transfer;
use crate::block_matrix::{Rows, row_product};
use crate::field::clear_masked;

/// `pre` forward sweeps from zero, and `P^T` of the remaining residual.
pub(super) fn descend<const C: usize>(
    level: &Level<C>,
    pre: usize,
    residual: &[SVector<f64, C>],
    x: &mut [SVector<f64, C>],
    sums: &mut [SVector<f64, C>],
    transfer: &Transfer,
    coarse: &mut [SVector<f64, C>],
) {
    let Some(matrix) = &level.matrix else {
        return;
    };
    let (rows, parents) = (Rows::of(matrix), Rows::of(&transfer.prolongation));
    x.fill(SVector::zeros());
    for _ in 0..pre {
        for set in 0..level.sets.len() {
            balance(level, &rows, set, residual, x, sums);
        }
    }
    coarse.fill(SVector::zeros());
    for i in 0..x.len() {
        let rest = residual[i] - row_product(&rows, i, x);
        let rest = level.frames.to_coordinates(i, rest);
        for (parent, &weight) in parents.row(i) {
            coarse[parent] += rest * weight;
        }
    }
}

/// Adds `P coarse` to the correction, then `post` backward sweeps and, on request, the product of matrix and correction
/// in `sums`.
pub(super) fn ascend<const C: usize, const IMAGE: bool>(
    level: &Level<C>,
    post: usize,
    residual: &[SVector<f64, C>],
    x: &mut [SVector<f64, C>],
    sums: &mut [SVector<f64, C>],
    transfer: &Transfer,
    coarse: &[SVector<f64, C>],
) {
    let Some(matrix) = &level.matrix else {
        return;
    };
    let (rows, parents) = (Rows::of(matrix), Rows::of(&transfer.prolongation));
    for i in 0..x.len() {
        let mut step = SVector::zeros();
        for (parent, &weight) in parents.row(i) {
            step += coarse[parent] * weight;
        }
        step = level.frames.to_frame(i, step);
        clear_masked(&mut step, &level.dropped[i]);
        x[i] += step;
    }
    for _ in 0..post {
        for set in (0..level.sets.len()).rev() {
            balance(level, &rows, set, residual, x, sums);
        }
    }
    if IMAGE {
        for (i, image) in sums.iter_mut().enumerate() {
            *image = row_product(&rows, i, x);
        }
    }
}

/// Solves for the unknowns of a set, with all others fixed.
fn balance<const C: usize>(
    level: &Level<C>,
    rows: &Rows<'_, SMatrix<f64, C, C>>,
    set: usize,
    residual: &[SVector<f64, C>],
    x: &mut [SVector<f64, C>],
    rest: &mut [SVector<f64, C>],
) {
    for i in level.sets.vertices(set) {
        rest[i] = residual[i] - row_product(rows, i, x);
    }
    level.sets.solve(set, rest);
    for i in level.sets.vertices(set) {
        x[i] += rest[i];
    }
}

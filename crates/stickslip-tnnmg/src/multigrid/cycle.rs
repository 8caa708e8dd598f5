//! The V-cycle: forward sweeps down, an exact solve at the bottom, backward sweeps up.
//!
//! Backward after forward makes the cycle symmetric, so that it may precondition conjugate
//! gradients.

use nalgebra::SVector;

use super::Multigrid;
use super::level::{Level, Transfer};
use crate::block_matrix::{Rows, partial_product, partial_product_reversed, row_product};
use crate::field::clear_masked;

/// One V(pre, post) cycle from zero: `correction = V residual`, `image = H correction`.
pub(super) fn run<const C: usize>(
    multigrid: &mut Multigrid<C>,
    residual: &[SVector<f64, C>],
    correction: &mut [SVector<f64, C>],
    image: &mut [SVector<f64, C>],
) {
    let Multigrid {
        transfers,
        levels,
        coarse,
        pre,
        post,
        ..
    } = multigrid;
    let finest = levels.len() - 1;
    levels[finest].residual.copy_from_slice(residual);
    for l in (1..=finest).rev() {
        let (coarser, finer) = levels.split_at_mut(l);
        smooth_down(&mut finer[0], *pre);
        restrict(&finer[0], &transfers[l - 1], *pre, &mut coarser[l - 1]);
    }
    let bottom = &mut levels[0];
    if let Some(coarse) = coarse {
        coarse.solve(&bottom.residual, &bottom.dropped, &mut bottom.correction);
    }
    for l in 1..=finest {
        let (coarser, finer) = levels.split_at_mut(l);
        prolongate(&coarser[l - 1], &transfers[l - 1], &mut finer[0]);
        for sweep in 1..=*post {
            // The last sweep on the finest level notes what it changed, for the image.
            let changes = (l == finest && sweep == *post).then_some(&mut *image);
            backward(&mut finer[0], changes);
        }
    }
    correction.copy_from_slice(&levels[finest].correction);
    if finest > 0 && *post > 0 {
        image_from_changes(&levels[finest], residual, image);
    } else {
        let rows = Rows::of(&levels[finest].matrix);
        for (i, image) in image.iter_mut().enumerate() {
            *image = row_product(&rows, i, correction);
        }
    }
}

/// `pre` forward sweeps from zero; the level notes what the last one changed.
fn smooth_down<const C: usize>(level: &mut Level<C>, pre: usize) {
    if pre == 0 {
        level.correction.fill(SVector::zeros());
        return;
    }
    forward_from_zero(level);
    if pre == 1 {
        level.change.copy_from_slice(&level.correction);
    }
    for _ in 1..pre {
        forward(level);
    }
}

/// The first sweep sees zeros behind the diagonal and reads half of the matrix.
fn forward_from_zero<const C: usize>(level: &mut Level<C>) {
    let rows = Rows::of(&level.matrix);
    for i in 0..level.correction.len() {
        let lower = rows.range(i).start..level.diagonals[i] as usize;
        let sum = partial_product(
            &rows.columns[lower.clone()],
            &rows.values[lower],
            &level.correction,
        );
        level.correction[i] = level.inverses[i] * (level.residual[i] - sum);
    }
}

fn forward<const C: usize>(level: &mut Level<C>) {
    let rows = Rows::of(&level.matrix);
    for i in 0..level.correction.len() {
        let (range, diagonal) = (rows.range(i), level.diagonals[i] as usize);
        let (lower, upper) = (range.start..diagonal, diagonal + 1..range.end);
        let x = &level.correction;
        // What was just computed enters last: its latency is that of the whole sweep.
        let rest = level.residual[i]
            - partial_product(&rows.columns[upper.clone()], &rows.values[upper], x)
            - partial_product(&rows.columns[lower.clone()], &rows.values[lower], x);
        let new = level.inverses[i] * rest;
        level.change[i] = new - level.correction[i];
        level.correction[i] = new;
    }
}

fn backward<const C: usize>(level: &mut Level<C>, mut changes: Option<&mut [SVector<f64, C>]>) {
    let rows = Rows::of(&level.matrix);
    for i in (0..level.correction.len()).rev() {
        let (range, diagonal) = (rows.range(i), level.diagonals[i] as usize);
        let (lower, upper) = (range.start..diagonal, diagonal + 1..range.end);
        let x = &level.correction;
        let rest = level.residual[i]
            - partial_product(&rows.columns[lower.clone()], &rows.values[lower], x)
            - partial_product_reversed(&rows.columns[upper.clone()], &rows.values[upper], x);
        let new = level.inverses[i] * rest;
        if let Some(changes) = &mut changes {
            changes[i] = new - level.correction[i];
        }
        level.correction[i] = new;
    }
}

/// `H x` after a backward sweep: each row was balanced in its turn, so that it misses the right-hand
/// side by what the rows before the diagonal changed afterwards. Half a product instead of a whole.
fn image_from_changes<const C: usize>(
    level: &Level<C>,
    residual: &[SVector<f64, C>],
    changes_to_image: &mut [SVector<f64, C>],
) {
    let rows = Rows::of(&level.matrix);
    for i in (0..changes_to_image.len()).rev() {
        let lower = rows.range(i).start..level.diagonals[i] as usize;
        changes_to_image[i] = residual[i]
            + partial_product(
                &rows.columns[lower.clone()],
                &rows.values[lower],
                changes_to_image,
            );
    }
}

/// The coarse right-hand side `P^T (b - H x)`.
fn restrict<const C: usize>(
    fine: &Level<C>,
    transfer: &Transfer,
    pre: usize,
    coarse: &mut Level<C>,
) {
    let rows = Rows::of(&fine.matrix);
    let parents = Rows::of(&transfer.prolongation);
    coarse.residual.fill(SVector::zeros());
    for i in 0..fine.correction.len() {
        let rest = if pre > 0 {
            // Each row was balanced in its turn; the rows behind the diagonal changed afterwards.
            let upper = fine.diagonals[i] as usize + 1..rows.range(i).end;
            -partial_product(
                &rows.columns[upper.clone()],
                &rows.values[upper],
                &fine.change,
            )
        } else {
            fine.residual[i]
        };
        for (parent, &weight) in parents.row(i) {
            coarse.residual[parent] += rest * weight;
        }
    }
    for (residual, dropped) in coarse.residual.iter_mut().zip(&coarse.dropped) {
        clear_masked(residual, dropped);
    }
}

/// Adds `P x` to the fine correction, on its kept components.
fn prolongate<const C: usize>(coarse: &Level<C>, transfer: &Transfer, fine: &mut Level<C>) {
    let parents = Rows::of(&transfer.prolongation);
    for (i, correction) in fine.correction.iter_mut().enumerate() {
        let mut step = SVector::zeros();
        for (parent, &weight) in parents.row(i) {
            step += coarse.correction[parent] * weight;
        }
        clear_masked(&mut step, &fine.dropped[i]);
        *correction += step;
    }
}

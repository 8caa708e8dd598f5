//! The V-cycle: forward sweeps down, an exact solve at the bottom, backward sweeps up.
//!
//! Backward after forward makes the cycle symmetric, so that it may precondition conjugate
//! gradients.
//!
//! All that a cycle does on a level between two transfers is one pass over its matrix. A row of the
//! second sweep needs of the first no more than the rows up to its last neighbour, so that it
//! follows at the distance of the matrix's bandwidth, the third sweep behind it, and the residual
//! last: rows are read from memory once and from cache by those that follow. The arithmetic and
//! its order in each row are those of sweeps one after the other.

use nalgebra::SVector;

use super::Multigrid;
use super::level::{Fields, Level, Transfer};
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
        fields,
        coarse,
        pre,
        post,
        ..
    } = multigrid;
    let finest = levels.len() - 1;
    for l in (1..=finest).rev() {
        let (coarser, own) = fields.split_at_mut(l);
        let (transfer, target) = (&transfers[l - 1], &mut coarser[l - 1].residual);
        match own.first_mut() {
            Some(own) => own.descend(&levels[l], *pre, transfer, target),
            // The image is free until the way up.
            None => descend(
                &levels[l], *pre, residual, correction, image, transfer, target,
            ),
        }
        for (residual, dropped) in target.iter_mut().zip(&levels[l - 1].dropped) {
            clear_masked(residual, dropped);
        }
    }
    if let Some(coarse) = coarse {
        let dropped = &levels[0].dropped;
        match fields.first_mut() {
            Some(bottom) => coarse.solve(&bottom.residual, dropped, &mut bottom.correction),
            None => coarse.solve(residual, dropped, correction),
        }
    }
    for l in 1..=finest {
        let (coarser, own) = fields.split_at_mut(l);
        let (transfer, source) = (&transfers[l - 1], &coarser[l - 1].correction);
        match own.first_mut() {
            Some(own) => own.ascend(&levels[l], *post, transfer, source),
            None => {
                let image = (*post > 0).then_some(&mut *image);
                ascend(
                    &levels[l], *post, residual, correction, transfer, source, image,
                );
            }
        }
    }
    if finest == 0 || *post == 0 {
        let rows = Rows::of(&levels[finest].matrix);
        for (i, image) in image.iter_mut().enumerate() {
            *image = row_product(&rows, i, correction);
        }
    }
}

impl<const C: usize> Fields<C> {
    fn descend(
        &mut self,
        level: &Level<C>,
        pre: usize,
        transfer: &Transfer,
        coarse: &mut [SVector<f64, C>],
    ) {
        let Self {
            residual,
            correction,
            change,
        } = self;
        descend(level, pre, residual, correction, change, transfer, coarse);
    }

    fn ascend(
        &mut self,
        level: &Level<C>,
        post: usize,
        transfer: &Transfer,
        coarse: &[SVector<f64, C>],
    ) {
        let (residual, correction) = (&self.residual, &mut self.correction);
        ascend(level, post, residual, correction, transfer, coarse, None);
    }
}

/// `pre` forward sweeps from zero, and `P^T` of the residual they leave.
fn descend<const C: usize>(
    level: &Level<C>,
    pre: usize,
    residual: &[SVector<f64, C>],
    x: &mut [SVector<f64, C>],
    change: &mut [SVector<f64, C>],
    transfer: &Transfer,
    coarse: &mut [SVector<f64, C>],
) {
    let rows = Rows::of(&level.matrix);
    let parents = Rows::of(&transfer.prolongation);
    coarse.fill(SVector::zeros());
    if pre == 0 {
        x.fill(SVector::zeros());
    }
    let lag = level.bandwidth + 1;
    for t in 0..x.len() + pre * lag {
        for sweep in 0..=pre {
            let Some(i) = t.checked_sub(sweep * lag) else {
                break;
            };
            if i >= x.len() {
                continue;
            }
            let (range, diagonal) = (rows.range(i), level.diagonals[i] as usize);
            let (lower, upper) = (range.start..diagonal, diagonal + 1..range.end);
            if sweep == pre {
                // Each row was balanced in its turn; the rows behind the diagonal changed
                // afterwards: in the first sweep from zero, later by what the last one notes.
                let (columns, values) = (&rows.columns[upper.clone()], &rows.values[upper]);
                let rest = match pre {
                    0 => residual[i],
                    1 => -partial_product(columns, values, x),
                    _ => -partial_product(columns, values, change),
                };
                for (parent, &weight) in parents.row(i) {
                    coarse[parent] += rest * weight;
                }
                continue;
            }
            // The first sweep sees zeros behind the diagonal.
            let mut rest = residual[i];
            if sweep > 0 {
                rest -= partial_product(&rows.columns[upper.clone()], &rows.values[upper], x);
            }
            // What was just computed enters last: its latency is that of the whole sweep.
            rest -= partial_product(&rows.columns[lower.clone()], &rows.values[lower], x);
            let new = level.inverses[i] * rest;
            if sweep > 0 && sweep + 1 == pre {
                change[i] = new - x[i];
            }
            x[i] = new;
        }
    }
}

/// Adds `P coarse` to `x`, then `post` backward sweeps and, if asked for, the product `H x`.
fn ascend<const C: usize>(
    level: &Level<C>,
    post: usize,
    residual: &[SVector<f64, C>],
    x: &mut [SVector<f64, C>],
    transfer: &Transfer,
    coarse: &[SVector<f64, C>],
    mut image: Option<&mut [SVector<f64, C>]>,
) {
    let rows = Rows::of(&level.matrix);
    let parents = Rows::of(&transfer.prolongation);
    let stages = post + usize::from(image.is_some());
    let lag = level.bandwidth + 1;
    for t in 0..x.len() + stages * lag {
        for stage in 0..=stages {
            let Some(behind) = t.checked_sub(stage * lag) else {
                break;
            };
            let Some(i) = x.len().checked_sub(behind + 1) else {
                continue;
            };
            if stage == 0 {
                let mut step = SVector::zeros();
                for (parent, &weight) in parents.row(i) {
                    step += coarse[parent] * weight;
                }
                clear_masked(&mut step, &level.dropped[i]);
                x[i] += step;
                continue;
            }
            let (range, diagonal) = (rows.range(i), level.diagonals[i] as usize);
            let (lower, upper) = (range.start..diagonal, diagonal + 1..range.end);
            let (columns, values) = (&rows.columns[lower.clone()], &rows.values[lower]);
            if stage > post {
                // Each row was balanced in its turn, so that it misses the right-hand side by what
                // the rows before the diagonal changed afterwards.
                if let Some(image) = &mut image {
                    image[i] = residual[i] + partial_product(columns, values, image);
                }
                continue;
            }
            let rest = residual[i]
                - partial_product(columns, values, x)
                - partial_product_reversed(&rows.columns[upper.clone()], &rows.values[upper], x);
            let new = level.inverses[i] * rest;
            if let (true, Some(changes)) = (stage == post, &mut image) {
                changes[i] = new - x[i];
            }
            x[i] = new;
        }
    }
}

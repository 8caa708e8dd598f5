//! The V-cycle: forward sweeps down, an exact solve at the bottom, backward sweeps up.
//!
//! Backward after forward makes the cycle symmetric, so that it may precondition conjugate
//! gradients.
//!
//! All that a cycle does on a level between two transfers is one pass over the blocks below the
//! diagonal: what a row needs from behind it, the rows there spread when they are read. A row of the
//! second sweep needs of the first no more than the rows up to its last neighbour, so that it
//! follows at the distance of the matrix's bandwidth, the third sweep behind it, and the residual
//! last: rows are read from memory once and from cache by those that follow. The arithmetic and
//! its order in each row are those of sweeps one after the other. Where stretched cells tie vertices
//! together, `tied_cycle` takes the place of these passes.

use nalgebra::SVector;

use super::Multigrid;
use super::level::{Fields, Level, Transfer};
use super::tied_cycle;
use crate::block_matrix::{Rows, add_transposed_row, row_product};
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
    for (l, transfer) in transfers.iter().enumerate().rev() {
        let (coarser, own) = fields.split_at_mut(l + 1);
        let target = &mut coarser[l].residual;
        let level = &levels[l + 1];
        match own.first_mut() {
            Some(own) => own.descend(level, *pre, transfer, target),
            None if level.frames.is_empty() => {
                descend::<C, false>(level, *pre, residual, correction, image, transfer, target);
            }
            None => descend::<C, true>(level, *pre, residual, correction, image, transfer, target),
        }
        for (residual, dropped) in target.iter_mut().zip(&levels[l].dropped) {
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
    for (l, transfer) in transfers.iter().enumerate() {
        let (coarser, own) = fields.split_at_mut(l + 1);
        let (level, source) = (&levels[l + 1], &coarser[l].correction);
        match own.first_mut() {
            Some(own) => own.ascend(level, *post, transfer, source),
            None => {
                let pass = match (*post > 0, level.frames.is_empty()) {
                    (true, true) => ascend::<C, true, false>,
                    (true, false) => ascend::<C, true, true>,
                    (false, true) => ascend::<C, false, false>,
                    (false, false) => ascend::<C, false, true>,
                };
                pass(level, *post, residual, correction, image, transfer, source);
            }
        }
    }
    if transfers.is_empty() || *post == 0 {
        let rows = Rows::of(&levels[transfers.len()].matrix);
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
        let (residual, correction, sums) = (&self.residual, &mut self.correction, &mut self.sums);
        descend::<C, false>(level, pre, residual, correction, sums, transfer, coarse);
    }

    fn ascend(
        &mut self,
        level: &Level<C>,
        post: usize,
        transfer: &Transfer,
        coarse: &[SVector<f64, C>],
    ) {
        let (residual, correction, sums) = (&self.residual, &mut self.correction, &mut self.sums);
        ascend::<C, false, false>(level, post, residual, correction, sums, transfer, coarse);
    }
}

/// `pre` forward sweeps from zero, and `P^T` of the residual they leave.
///
/// A row needs of the rows behind it what they had before this sweep; they spread it when they
/// are read themselves.
///
/// The fields are arguments of their own, which tells the compiler that they do not overlap; whether there are `FRAMES`
/// is one of the type, so that a level without any does not ask at each row.
fn descend<const C: usize, const FRAMES: bool>(
    level: &Level<C>,
    pre: usize,
    residual: &[SVector<f64, C>],
    x: &mut [SVector<f64, C>],
    sums: &mut [SVector<f64, C>],
    transfer: &Transfer,
    coarse: &mut [SVector<f64, C>],
) {
    if !level.sets.is_empty() {
        return tied_cycle::descend(level, pre, residual, x, sums, transfer, coarse);
    }
    let (below, parents) = (Rows::of(&level.lower), Rows::of(&transfer.prolongation));
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
            if sweep == pre {
                // Each row was balanced in its turn; it misses what the rows behind it changed
                // afterwards.
                let rest = if pre == 0 { residual[i] } else { -sums[i] };
                let rest = if FRAMES {
                    level.frames.to_coordinates(i, rest)
                } else {
                    rest
                };
                for (parent, &weight) in parents.row(i) {
                    coarse[parent] += rest * weight;
                }
                continue;
            }
            // The first sweep starts from zero. The last leaves the change of what is behind.
            let behind = if sweep == 0 {
                SVector::zeros()
            } else {
                sums[i]
            };
            let last = sweep + 1 == pre;
            sums[i] = if last { -behind } else { SVector::zeros() };
            let rest = residual[i] - behind - row_product(&below, i, x);
            x[i] = level.inverses[i] * rest;
            add_transposed_row(&below, i, &x[i], sums);
        }
    }
}

/// Adds `P coarse` to the correction, then `post` backward sweeps and, if asked for, the
/// product of matrix and correction in `sums`.
fn ascend<const C: usize, const IMAGE: bool, const FRAMES: bool>(
    level: &Level<C>,
    post: usize,
    residual: &[SVector<f64, C>],
    x: &mut [SVector<f64, C>],
    sums: &mut [SVector<f64, C>],
    transfer: &Transfer,
    coarse: &[SVector<f64, C>],
) {
    if !level.sets.is_empty() {
        return tied_cycle::ascend::<C, IMAGE>(level, post, residual, x, sums, transfer, coarse);
    }
    let (below, parents) = (Rows::of(&level.lower), Rows::of(&transfer.prolongation));
    let stages = post + usize::from(IMAGE);
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
                if FRAMES {
                    step = level.frames.to_frame(i, step);
                }
                clear_masked(&mut step, &level.dropped[i]);
                x[i] += step;
                sums[i] = SVector::zeros();
            } else if stage <= post {
                let rest = residual[i] - row_product(&below, i, x) - sums[i];
                let new = level.inverses[i] * rest;
                add_transposed_row(&below, i, &new, sums);
                // The next sweep starts anew; the product needs the change.
                let last = stage == post;
                sums[i] = if last { new - x[i] } else { SVector::zeros() };
                x[i] = new;
            } else {
                // Each row was balanced in its turn, so that it misses the right-hand side by what
                // the rows before it changed afterwards.
                sums[i] = residual[i] + row_product(&below, i, sums);
            }
        }
    }
}

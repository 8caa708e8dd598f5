//! The V-cycle: forward sweeps down, an exact solve at the bottom, backward sweeps up.
//!
//! Backward after forward makes the cycle symmetric, as a preconditioner of conjugate gradients requires.
//!
//! Between two transfers a cycle makes one pass over the blocks below the diagonal of a level: rows after a row scatter
//! their contribution to it when they are read. A row of the second sweep needs of the first only the rows up to its
//! last neighbour. It follows at the distance of the bandwidth, the third sweep after it, and the residual last: rows
//! are read from memory once and from cache by the later sweeps. The arithmetic and its order in each row are those of
//! separate sweeps. Large levels are cut into slabs, see `slab_cycle`. For the line smoother on stretched cells
//! `tied_cycle` replaces these passes.

use nalgebra::SVector;

use super::Multigrid;
use super::couplings::Couplings;
use super::fields::Fields;
use super::level::Level;
use super::packed::{Before, Coupling};
use super::smoother::{Smoother, Sweep, interpolated, parents};
use super::transfer::Transfer;
use super::{slab_cycle, tied_cycle};
use crate::block_matrix::{Rows, row_product};
use crate::colouring::Colouring;
use crate::field::clear_masked;
use crate::parts::for_parts;

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
        edges,
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
                pass(
                    level, *post, residual, correction, image, edges, transfer, source,
                );
            }
        }
    }
    if transfers.is_empty() || *post == 0 {
        multiply(&levels[transfers.len()], correction, image);
    }
}

/// `image = H correction`, on a level that keeps its matrix.
pub(super) fn multiply<const C: usize>(
    level: &Level<C>,
    correction: &[SVector<f64, C>],
    image: &mut [SVector<f64, C>],
) {
    let Some(matrix) = &level.matrix else {
        return;
    };
    let rows = Rows::of(matrix);
    for_parts(0..image.len(), image, &|part, image| {
        for (image, i) in image.iter_mut().zip(part) {
            *image = row_product(&rows, i, correction);
        }
    });
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
        let edges = &mut [];
        ascend::<C, false, false>(
            level, post, residual, correction, sums, edges, transfer, coarse,
        );
    }
}

/// `pre` forward sweeps from zero, and `P^T` of the remaining residual.
///
/// A row needs the values of later rows before this sweep. These rows scatter them when they are read themselves.
///
/// The fields are separate arguments, from which the compiler sees that they do not overlap. `FRAMES` is a type
/// parameter: a level without frames has no test per row.
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
    if pre == 0 {
        x.fill(SVector::zeros());
    }
    match &level.couplings {
        Couplings::Double(packed) => {
            let smoother = Smoother::new(level, packed.rows(), residual);
            sweep_down::<_, C, FRAMES>(smoother, &level.slabs, pre, x, sums, transfer, coarse);
        }
        Couplings::Single(packed) => {
            let smoother = Smoother::new(level, packed.rows(), residual);
            sweep_down::<_, C, FRAMES>(smoother, &level.slabs, pre, x, sums, transfer, coarse);
        }
    }
}

/// [`descend`] in sweeps over single vertices.
fn sweep_down<B: Coupling<C>, const C: usize, const FRAMES: bool>(
    smoother: Smoother<'_, B, C>,
    slabs: &Colouring,
    pre: usize,
    x: &mut [SVector<f64, C>],
    sums: &mut [SVector<f64, C>],
    transfer: &Transfer,
    coarse: &mut [SVector<f64, C>],
) {
    if !slabs.is_whole() {
        slab_cycle::descend(smoother, slabs, pre, x, sums);
        return slab_cycle::restrict::<B, C, FRAMES>(smoother, pre > 0, sums, transfer, coarse);
    }
    let parents = parents(transfer);
    coarse.fill(SVector::zeros());
    let lag = slabs.bandwidth() + 1;
    for t in 0..x.len() + pre * lag {
        for sweep in 0..=pre {
            let Some(i) = t.checked_sub(sweep * lag) else {
                break;
            };
            if i >= x.len() {
                continue;
            }
            if sweep == pre {
                let rest = smoother.left_over::<FRAMES>(i, pre > 0, sums);
                for (parent, &weight) in parents.row(i) {
                    coarse[parent] += rest * weight;
                }
                continue;
            }
            let sweep = Sweep {
                first: sweep == 0,
                last: sweep + 1 == pre,
            };
            smoother.forward(i, sweep, 0, x, sums);
        }
    }
}

/// Adds `P coarse` to the correction, then `post` backward sweeps and, on request, the product of matrix and correction
/// in `sums`.
#[expect(clippy::too_many_arguments, reason = "fields that do not overlap")]
fn ascend<const C: usize, const IMAGE: bool, const FRAMES: bool>(
    level: &Level<C>,
    post: usize,
    residual: &[SVector<f64, C>],
    x: &mut [SVector<f64, C>],
    sums: &mut [SVector<f64, C>],
    edges: &mut [SVector<f64, C>],
    transfer: &Transfer,
    coarse: &[SVector<f64, C>],
) {
    if !level.sets.is_empty() {
        return tied_cycle::ascend::<C, IMAGE>(level, post, residual, x, sums, transfer, coarse);
    }
    match &level.couplings {
        Couplings::Double(packed) => {
            let before = packed.rows();
            sweep_up::<_, C, IMAGE, FRAMES>(
                level, before, post, residual, x, sums, edges, transfer, coarse,
            );
        }
        Couplings::Single(packed) => {
            let before = packed.rows();
            sweep_up::<_, C, IMAGE, FRAMES>(
                level, before, post, residual, x, sums, edges, transfer, coarse,
            );
        }
    }
}

/// [`ascend`] in sweeps over single vertices.
#[expect(clippy::too_many_arguments, reason = "fields that do not overlap")]
fn sweep_up<B: Coupling<C>, const C: usize, const IMAGE: bool, const FRAMES: bool>(
    level: &Level<C>,
    before: Before<'_, B, C>,
    post: usize,
    residual: &[SVector<f64, C>],
    x: &mut [SVector<f64, C>],
    sums: &mut [SVector<f64, C>],
    edges: &mut [SVector<f64, C>],
    transfer: &Transfer,
    coarse: &[SVector<f64, C>],
) {
    if !level.slabs.is_whole() {
        return slab_cycle::ascend::<B, C, IMAGE, FRAMES>(
            level, before, post, residual, x, sums, edges, transfer, coarse,
        );
    }
    let (smoother, parents) = (Smoother::new(level, before, residual), parents(transfer));
    let stages = post + usize::from(IMAGE);
    let lag = level.slabs.bandwidth() + 1;
    for t in 0..x.len() + stages * lag {
        for stage in 0..=stages {
            let Some(behind) = t.checked_sub(stage * lag) else {
                break;
            };
            let Some(i) = x.len().checked_sub(behind + 1) else {
                continue;
            };
            if stage == 0 {
                x[i] += interpolated::<C, FRAMES>(level, &parents, i, coarse);
                sums[i] = SVector::zeros();
            } else if stage <= post {
                smoother.backward(i, stage == post, 0, x, sums);
            } else {
                sums[i] = smoother.product(i, 0, sums);
            }
        }
    }
}

//! The cycle on a level of several slabs: forward sweeps over the wide slabs and then over the narrow ones, backward
//! sweeps in the reverse order, the slabs of one colour in parallel.
//!
//! With one sweep in each direction, the default, a row is read from memory once on the way down and once on the way
//! up, except in narrow slabs, whose product waits for the wide ones. Each further sweep reads the matrix again.
//!
//! The product overwrites the changes that it is computed from. The changes at the ends of wide slabs, which narrow
//! slabs need as well, are kept in `edges`.

use std::ops::Range;

use nalgebra::SVector;

use super::level::Level;
use super::packed::{Before, Coupling};
use super::smoother::{Smoother, Sweep, interpolated, parents};
use super::transfer::Transfer;
use crate::block_matrix::Rows;
use crate::colouring::Colouring;
use crate::parts::{Each, for_parts};

/// `pre` forward sweeps from zero.
pub(super) fn descend<B: Coupling<C>, const C: usize>(
    smoother: Smoother<'_, B, C>,
    slabs: &Colouring,
    pre: usize,
    x: &mut [SVector<f64, C>],
    sums: &mut [SVector<f64, C>],
) {
    for sweep in 0..pre {
        let sweep = Sweep {
            first: sweep == 0,
            last: sweep + 1 == pre,
        };
        slabs.for_wide((&mut *x, &mut *sums), |k, first, (x, sums)| {
            forward(&smoother, slabs.wide(k), sweep, first, x, sums);
        });
        slabs.for_narrow((&mut *x, &mut *sums), |k, first, (x, sums)| {
            forward(&smoother, slabs.narrow(k), sweep, first, x, sums);
        });
    }
}

/// Some rows of a forward sweep. The compiler sees that separate arguments of a function that is not inlined do not
/// overlap; parts of a tuple may.
#[inline(never)]
fn forward<B: Coupling<C>, const C: usize>(
    smoother: &Smoother<'_, B, C>,
    rows: Range<usize>,
    sweep: Sweep,
    first: usize,
    x: &mut [SVector<f64, C>],
    sums: &mut [SVector<f64, C>],
) {
    for i in rows {
        smoother.forward(i, sweep, first, x, sums);
    }
}

/// Some rows of a backward sweep, the last one first.
#[inline(never)]
fn backward<B: Coupling<C>, const C: usize>(
    smoother: &Smoother<'_, B, C>,
    rows: Range<usize>,
    is_last: bool,
    first: usize,
    x: &mut [SVector<f64, C>],
    sums: &mut [SVector<f64, C>],
) {
    for i in rows.rev() {
        smoother.backward(i, is_last, first, x, sums);
    }
}

/// `P^T` of the remaining residual.
pub(super) fn restrict<B: Coupling<C>, const C: usize, const FRAMES: bool>(
    smoother: Smoother<'_, B, C>,
    swept: bool,
    sums: &[SVector<f64, C>],
    transfer: &Transfer,
    coarse: &mut [SVector<f64, C>],
) {
    let children = Rows::of(&transfer.restriction);
    for_parts(0..coarse.len(), coarse, &|part, coarse| {
        for (coarse, parent) in coarse.iter_mut().zip(part) {
            *coarse = SVector::zeros();
            for (i, &weight) in children.row(parent) {
                *coarse += smoother.left_over::<FRAMES>(i, swept, sums) * weight;
            }
        }
    });
}

/// Adds `P coarse` to the correction, then `post` backward sweeps and, on request, the product of matrix and correction
/// in `sums`.
#[expect(clippy::too_many_arguments, reason = "fields that do not overlap")]
pub(super) fn ascend<B: Coupling<C>, const C: usize, const IMAGE: bool, const FRAMES: bool>(
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
    let (smoother, slabs) = (Smoother::new(level, before, residual), &level.slabs);
    let parents = parents(transfer);
    let prolong = |i: usize, x: &mut SVector<f64, C>, sum: &mut SVector<f64, C>| {
        *x += interpolated::<C, FRAMES>(level, &parents, i, coarse);
        *sum = SVector::zeros();
    };
    if post == 0 {
        return for_parts(0..x.len(), (x, sums), &|part, (x, sums)| {
            for ((x, sum), i) in x.iter_mut().zip(sums).zip(part) {
                prolong(i, x, sum);
            }
        });
    }
    let per_part = edge_count(slabs);
    for sweep in 1..=post {
        let (is_first, is_last) = (sweep == 1, sweep == post);
        slabs.for_narrow((&mut *x, &mut *sums), |k, first, (x, sums)| {
            let rows = slabs.narrow(k);
            if is_first {
                let reach = slabs.bandwidth();
                for i in rows.start - reach..rows.end + reach {
                    prolong(i, &mut x[i - first], &mut sums[i - first]);
                }
            }
            backward(&smoother, rows, is_last, first, x, sums);
        });
        let each = Each {
            entries: &mut *edges,
            per_part: if IMAGE { per_part } else { 0 },
        };
        slabs.for_wide((&mut *x, &mut *sums, each), |k, first, (x, sums, edges)| {
            let slab = Wide {
                smoother,
                slabs,
                k,
                first,
                is_first,
                is_last,
            };
            slab.ascend::<IMAGE>(&prolong, x, sums, edges.entries);
        });
    }
    if IMAGE {
        slabs.for_narrow(sums, |k, first, sums| {
            for i in slabs.narrow(k).rev() {
                let changes = narrow_product(&smoother, slabs, k, i, first, sums, edges);
                sums[i - first] = residual[i] + changes;
            }
        });
    }
}

/// A wide slab in one of the backward sweeps, with fields from row `first` on.
struct Wide<'a, B: Coupling<C>, const C: usize> {
    smoother: Smoother<'a, B, C>,
    slabs: &'a Colouring,
    k: usize,
    first: usize,
    is_first: bool,
    is_last: bool,
}

impl<B: Coupling<C>, const C: usize> Wide<'_, B, C> {
    /// Row by row at the distance of the bandwidth: interpolation, sweep, product.
    #[inline(never)]
    fn ascend<const IMAGE: bool>(
        &self,
        prolong: &impl Fn(usize, &mut SVector<f64, C>, &mut SVector<f64, C>),
        x: &mut [SVector<f64, C>],
        sums: &mut [SVector<f64, C>],
        edges: &mut [SVector<f64, C>],
    ) {
        let (slabs, k, first) = (self.slabs, self.k, self.first);
        let (rows, inner, lag) = (slabs.wide(k), slabs.inner(k), slabs.bandwidth() + 1);
        for t in (rows.start..rows.end + 2 * lag).rev() {
            let i = t.wrapping_sub(2 * lag);
            if self.is_first && inner.contains(&i) {
                prolong(i, &mut x[i - first], &mut sums[i - first]);
            }
            let i = t.wrapping_sub(lag);
            if rows.contains(&i) {
                self.smoother.backward(i, self.is_last, first, x, sums);
                if let Some(edge) = edge(slabs, k, i).filter(|_| IMAGE && self.is_last) {
                    edges[edge] = sums[i - first];
                }
            }
            if IMAGE && self.is_last && rows.contains(&t) {
                sums[t - first] = self.smoother.product(t, first, sums);
            }
        }
    }
}

/// The contribution to the product at row `i` of narrow slab `k` of the changes before it, its own and those at the
/// ends of its neighbours.
fn narrow_product<B: Coupling<C>, const C: usize>(
    smoother: &Smoother<'_, B, C>,
    slabs: &Colouring,
    k: usize,
    i: usize,
    first: usize,
    changes: &[SVector<f64, C>],
    edges: &[SVector<f64, C>],
) -> SVector<f64, C> {
    let (before, rows) = (&smoother.before, slabs.narrow(k));
    let columns = before.columns(i);
    let begin = columns.partition_point(|&j| (j as usize) < rows.start);
    let end = columns.partition_point(|&j| (j as usize) < rows.end);
    let mut product = before.partial_product(i, begin..end, first, changes);
    for n in (0..begin).chain(end..columns.len()) {
        let j = columns[n] as usize;
        let wide = k + usize::from(j >= rows.end);
        if let Some(edge) = edge(slabs, wide, j) {
            product += before.times(i, n, &edges[wide * edge_count(slabs) + edge]);
        }
    }
    product
}

/// The rows at the ends of a wide slab.
pub(super) fn edge_count(slabs: &Colouring) -> usize {
    2 * slabs.bandwidth()
}

/// The position of a row among those at the ends of its wide slab, if it is one.
#[inline(always)]
fn edge(slabs: &Colouring, k: usize, row: usize) -> Option<usize> {
    let (rows, bandwidth) = (slabs.wide(k), slabs.bandwidth());
    if row < rows.start + bandwidth {
        Some(row - rows.start)
    } else if row + bandwidth >= rows.end {
        Some(bandwidth + row + bandwidth - rows.end)
    } else {
        None
    }
}

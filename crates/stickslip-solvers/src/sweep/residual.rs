//! A forward sweep that leaves the residual behind it.

use std::ops::Range;

use nalgebra::SVector;

use super::passes::Part;
use super::{Inverses, Sweep};
use crate::block_matrix::{Rows, partial_product};
use crate::field::clear_masked;
use crate::{BlockMatrix, Energy};

impl<const C: usize> Sweep<C> {
    /// [`forward`](Self::forward), and the negative gradient of the energy after it, zero on fixed
    /// components.
    ///
    /// Each vertex was balanced in its turn. Its residual is due to the vertices after it: half a product, of changes
    /// instead of values. It follows the sweep at the distance of the bandwidth, while the rows are in cache.
    /// Contributions of wide slabs to a narrow one are added when its rows are read.
    pub(crate) fn forward_with_residual(
        &self,
        (energy, inverses): (&Energy<'_, BlockMatrix<C>, C>, Inverses<'_, C>),
        v: &mut [SVector<f64, C>],
        moved: &mut [SVector<f64, C>],
        residual: &mut [SVector<f64, C>],
    ) {
        let slabs = &self.slabs;
        let fields = (&mut *v, &mut *moved, &mut *residual);
        slabs.for_wide(fields, |k, first, (v, moved, residual)| {
            let part = Part { first, v, moved };
            self.pass_with_residual((energy, inverses), slabs.wide(k), part, residual);
        });
        if slabs.is_whole() {
            return;
        }
        slabs.for_narrow((v, moved, residual), |k, first, (v, moved, residual)| {
            let rows = slabs.narrow(k);
            let part = Part {
                first,
                v,
                moved: &mut *moved,
            };
            self.pass_with_residual((energy, inverses), rows.clone(), part, residual);
            let matrix = Rows::of(energy.operator);
            for i in rows.clone() {
                let beside = matrix.row(i).filter(|(j, _)| !rows.contains(j));
                for (j, block) in beside {
                    residual[j - first] += block.tr_mul(&moved[i - first]);
                    clear_masked(&mut residual[j - first], &energy.fixed[j]);
                }
            }
        });
    }

    /// A pass over some rows, and the residual at earlier rows due to later ones among them.
    fn pass_with_residual(
        &self,
        (energy, inverses): (&Energy<'_, BlockMatrix<C>, C>, Inverses<'_, C>),
        range: Range<usize>,
        part: Part<'_, C>,
        residual: &mut [SVector<f64, C>],
    ) {
        let rows = Rows::of(energy.operator);
        let (first, lag) = (part.first, self.slabs.bandwidth() + 1);
        let mut balance = |i: usize, moved: &[SVector<f64, C>]| {
            let mut upper = self.behind[i] as usize..rows.range(i).end;
            if i + lag > range.end {
                let own = &rows.columns[upper.clone()];
                upper.end = upper.start + own.partition_point(|&j| (j as usize) < range.end);
            }
            let left = &mut residual[i - first];
            let (columns, blocks) = (&rows.columns[upper.clone()], &rows.values[upper]);
            *left = partial_product(columns, blocks, first, moved);
            clear_masked(left, &energy.fixed[i]);
        };
        let moved = self.pass((energy, inverses), range.clone(), part, |i, moved| {
            if let Some(i) = i.checked_sub(lag).filter(|&i| i >= range.start) {
                balance(i, moved);
            }
        });
        for i in range.end.saturating_sub(lag).max(range.start)..range.end {
            balance(i, moved);
        }
    }
}

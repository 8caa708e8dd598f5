//! The sweeps of a cycle at one row, for any order of the rows.

use nalgebra::SVector;

use super::level::Level;
use super::packed::{Before, Coupling};
use super::transfer::Transfer;
use crate::block_matrix::Rows;
use crate::field::clear_masked;

/// The position among the forward sweeps. The first starts from zero. The last stores in `sums` the change of the rows
/// after a row.
#[derive(Clone, Copy)]
pub(super) struct Sweep {
    pub(super) first: bool,
    pub(super) last: bool,
}

/// A level and the right-hand side there.
///
/// Sweeps read the blocks of the matrix before the diagonal, in the order of the sweep, once for both triangles. The
/// fields that they change begin at vertex `first`. They are separate arguments, from which the compiler sees that they
/// do not overlap.
#[derive(Clone, Copy)]
pub(super) struct Smoother<'a, B: Coupling<C>, const C: usize> {
    level: &'a Level<C>,
    pub(super) before: Before<'a, B, C>,
    residual: &'a [SVector<f64, C>],
}

impl<'a, B: Coupling<C>, const C: usize> Smoother<'a, B, C> {
    pub(super) fn new(
        level: &'a Level<C>,
        before: Before<'a, B, C>,
        residual: &'a [SVector<f64, C>],
    ) -> Self {
        Self {
            level,
            before,
            residual,
        }
    }

    /// A row of a forward sweep. Later rows scatter their contribution when they are read themselves.
    #[inline(always)]
    pub(super) fn forward(
        &self,
        i: usize,
        sweep: Sweep,
        first: usize,
        x: &mut [SVector<f64, C>],
        sums: &mut [SVector<f64, C>],
    ) {
        let at = i - first;
        let behind = if sweep.first {
            SVector::zeros()
        } else {
            sums[at]
        };
        sums[at] = if sweep.last {
            -behind
        } else {
            SVector::zeros()
        };
        let rest = self.residual[i] - behind - self.before.product(i, first, x);
        x[at] = self.before.balanced(i, &rest);
        self.before.scatter(i, &x[at], first, sums);
    }

    /// A row of a backward sweep. The last sweep stores the change of the row in `sums`, which the product needs;
    /// earlier ones store zero for the next.
    #[inline(always)]
    pub(super) fn backward(
        &self,
        i: usize,
        last: bool,
        first: usize,
        x: &mut [SVector<f64, C>],
        sums: &mut [SVector<f64, C>],
    ) {
        let at = i - first;
        let rest = self.residual[i] - self.before.product(i, first, x) - sums[at];
        let new = self.before.balanced(i, &rest);
        self.before.scatter(i, &new, first, sums);
        sums[at] = if last { new - x[at] } else { SVector::zeros() };
        x[at] = new;
    }

    /// A row of the product of matrix and correction, from the changes before it. Each row was balanced in its turn:
    /// its residual is due to the later changes of the rows before it.
    #[inline(always)]
    pub(super) fn product(
        &self,
        i: usize,
        first: usize,
        changes: &[SVector<f64, C>],
    ) -> SVector<f64, C> {
        self.residual[i] + self.before.product(i, first, changes)
    }

    /// The residual of a row for the coarse level, in the coordinates: the later changes of the rows after it, or the
    /// whole residual without a sweep.
    #[inline(always)]
    pub(super) fn left_over<const FRAMES: bool>(
        &self,
        i: usize,
        swept: bool,
        sums: &[SVector<f64, C>],
    ) -> SVector<f64, C> {
        let rest = if swept { -sums[i] } else { self.residual[i] };
        if FRAMES {
            self.level.frames.to_coordinates(i, rest)
        } else {
            rest
        }
    }
}

/// `P coarse` at a row, without dropped components.
#[inline(always)]
pub(super) fn interpolated<const C: usize, const FRAMES: bool>(
    level: &Level<C>,
    parents: &Rows<'_, f64>,
    i: usize,
    coarse: &[SVector<f64, C>],
) -> SVector<f64, C> {
    let mut step = SVector::zeros();
    for (parent, &weight) in parents.row(i) {
        step += coarse[parent] * weight;
    }
    if FRAMES {
        step = level.frames.to_frame(i, step);
    }
    clear_masked(&mut step, &level.dropped[i]);
    step
}

/// The parents of the rows of a level.
pub(super) fn parents(transfer: &Transfer) -> Rows<'_, f64> {
    Rows::of(&transfer.prolongation)
}

//! Rows of blocks, of double or single precision, for sweeps.

use std::ops::Range;

use nalgebra::{SMatrix, SVector};

use super::inverses::{Inverses, LowerTriangles};
use crate::block_matrix::{Block, Rows, add_transposed_row, partial_product, row_product_behind};

/// Compressed rows of blocks before the diagonal, and the inverses of the diagonal blocks.
#[derive(Debug)]
pub(super) struct Packed<B: Coupling<C>, const C: usize> {
    pub(super) starts: Vec<u32>,
    pub(super) columns: Vec<u32>,
    pub(super) blocks: Vec<B>,
    /// The unit of the blocks of each row, if they have one.
    pub(super) units: Vec<f64>,
    /// Zero on dropped components.
    pub(super) inverses: B::Inverses,
}

/// The rows of packed blocks.
pub(super) struct Before<'a, B: Coupling<C>, const C: usize> {
    pub(super) rows: Rows<'a, B>,
    units: &'a [f64],
    inverses: &'a B::Inverses,
}

// Derived ones would ask for inverses that can be copied.
impl<B: Coupling<C>, const C: usize> Clone for Before<'_, B, C> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<B: Coupling<C>, const C: usize> Copy for Before<'_, B, C> {}

impl<B: Coupling<C>, const C: usize> Packed<B, C> {
    pub(super) fn rows(&self) -> Before<'_, B, C> {
        Before {
            rows: Rows {
                starts: &self.starts,
                columns: &self.columns,
                values: &self.blocks,
            },
            units: &self.units,
            inverses: &self.inverses,
        }
    }
}

/// Blocks that know whether they are relative to a unit.
pub(super) trait Coupling<const C: usize>: Block<C> {
    const HAS_UNIT: bool;

    /// The inverses of the diagonal blocks of rows of such blocks.
    type Inverses: Inverses<C> + Sync;
}

impl<const C: usize> Coupling<C> for SMatrix<f64, C, C> {
    const HAS_UNIT: bool = false;
    type Inverses = Vec<Self>;
}

impl<const C: usize> Coupling<C> for [[f32; C]; C] {
    const HAS_UNIT: bool = true;
    type Inverses = LowerTriangles<C>;
}

impl<B: Coupling<C>, const C: usize> Before<'_, B, C> {
    /// The inverse of the diagonal block of a row times a vector.
    #[inline(always)]
    pub(super) fn balanced(&self, i: usize, force: &SVector<f64, C>) -> SVector<f64, C> {
        self.inverses.times(i, force)
    }

    /// The columns of a row.
    #[inline(always)]
    pub(super) fn columns(&self, i: usize) -> &[u32] {
        &self.rows.columns[self.rows.range(i)]
    }

    #[inline(always)]
    fn in_unit(&self, i: usize, value: SVector<f64, C>) -> SVector<f64, C> {
        if B::HAS_UNIT {
            value * self.units[i]
        } else {
            value
        }
    }

    /// `sum of block_j x_j` over a row, of an `x` that begins at vertex `first`.
    #[inline(always)]
    pub(super) fn product(&self, i: usize, first: usize, x: &[SVector<f64, C>]) -> SVector<f64, C> {
        self.in_unit(i, row_product_behind(&self.rows, i, first, x))
    }

    /// The same over the entries `begin..end` of the row.
    #[inline(always)]
    pub(super) fn partial_product(
        &self,
        i: usize,
        entries: Range<usize>,
        first: usize,
        x: &[SVector<f64, C>],
    ) -> SVector<f64, C> {
        let range = self.rows.range(i);
        let blocks = &self.rows.values[range][entries.clone()];
        self.in_unit(
            i,
            partial_product(&self.columns(i)[entries], blocks, first, x),
        )
    }

    /// One entry of a row times a vector.
    #[inline(always)]
    pub(super) fn times(&self, i: usize, entry: usize, x: &SVector<f64, C>) -> SVector<f64, C> {
        let block = &self.rows.values[self.rows.range(i)][entry];
        self.in_unit(i, SMatrix::from_fn(|r, c| block.entry(r, c)) * x)
    }

    /// Adds the contributions of `x_i` to earlier rows.
    #[inline(always)]
    pub(super) fn scatter(
        &self,
        i: usize,
        x_i: &SVector<f64, C>,
        first: usize,
        y: &mut [SVector<f64, C>],
    ) {
        add_transposed_row(&self.rows, i, &self.in_unit(i, *x_i), first, y);
    }
}

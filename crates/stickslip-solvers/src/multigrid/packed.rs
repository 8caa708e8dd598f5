//! Rows of blocks, of double or single precision, for sweeps.

use std::ops::Range;

use nalgebra::{SMatrix, SVector};

use crate::block_matrix::{Block, Rows, add_transposed_row, partial_product, row_product_behind};

/// Compressed rows of blocks.
#[derive(Debug)]
pub(super) struct Packed<B> {
    pub(super) starts: Vec<u32>,
    pub(super) columns: Vec<u32>,
    pub(super) blocks: Vec<B>,
    /// The unit of the blocks of each row, if they have one.
    pub(super) units: Vec<f64>,
}

/// The rows of packed blocks.
#[derive(Clone, Copy)]
pub(super) struct Before<'a, B> {
    pub(super) rows: Rows<'a, B>,
    units: &'a [f64],
}

impl<B> Packed<B> {
    pub(super) fn rows(&self) -> Before<'_, B> {
        Before {
            rows: Rows {
                starts: &self.starts,
                columns: &self.columns,
                values: &self.blocks,
            },
            units: &self.units,
        }
    }
}

/// Blocks that know whether they are relative to a unit.
pub(super) trait Coupling<const C: usize>: Block<C> {
    const HAS_UNIT: bool;
}

impl<const C: usize> Coupling<C> for SMatrix<f64, C, C> {
    const HAS_UNIT: bool = false;
}

impl<const C: usize> Coupling<C> for [[f32; C]; C] {
    const HAS_UNIT: bool = true;
}

impl<B> Before<'_, B> {
    /// The columns of a row.
    #[inline(always)]
    pub(super) fn columns(&self, i: usize) -> &[u32] {
        &self.rows.columns[self.rows.range(i)]
    }

    #[inline(always)]
    fn in_unit<const C: usize>(&self, i: usize, value: SVector<f64, C>) -> SVector<f64, C>
    where
        B: Coupling<C>,
    {
        if B::HAS_UNIT {
            value * self.units[i]
        } else {
            value
        }
    }

    /// `sum of block_j x_j` over a row, of an `x` that begins at vertex `first`.
    #[inline(always)]
    pub(super) fn product<const C: usize>(
        &self,
        i: usize,
        first: usize,
        x: &[SVector<f64, C>],
    ) -> SVector<f64, C>
    where
        B: Coupling<C>,
    {
        self.in_unit(i, row_product_behind(&self.rows, i, first, x))
    }

    /// The same over the entries `begin..end` of the row.
    #[inline(always)]
    pub(super) fn partial_product<const C: usize>(
        &self,
        i: usize,
        entries: Range<usize>,
        first: usize,
        x: &[SVector<f64, C>],
    ) -> SVector<f64, C>
    where
        B: Coupling<C>,
    {
        let range = self.rows.range(i);
        let blocks = &self.rows.values[range][entries.clone()];
        self.in_unit(
            i,
            partial_product(&self.columns(i)[entries], blocks, first, x),
        )
    }

    /// One entry of a row times a vector.
    #[inline(always)]
    pub(super) fn times<const C: usize>(
        &self,
        i: usize,
        entry: usize,
        x: &SVector<f64, C>,
    ) -> SVector<f64, C>
    where
        B: Coupling<C>,
    {
        self.in_unit(i, self.rows.values[self.rows.range(i)][entry].times(x))
    }

    /// Adds the contributions of `x_i` to earlier rows.
    #[inline(always)]
    pub(super) fn scatter<const C: usize>(
        &self,
        i: usize,
        x_i: &SVector<f64, C>,
        first: usize,
        y: &mut [SVector<f64, C>],
    ) where
        B: Coupling<C>,
    {
        add_transposed_row(&self.rows, i, &self.in_unit(i, *x_i), first, y);
    }
}

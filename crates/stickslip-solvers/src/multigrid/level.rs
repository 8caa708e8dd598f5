//! One level: its matrix, the blocks that its cycle reads, the order of its sweeps.

mod pattern;
mod values;

use nalgebra::SMatrix;

use super::couplings::Couplings;
use super::entries::Entries;
use super::line_smoother::Sets;
use crate::block_matrix::Rows;
use crate::colouring::Colouring;
use crate::{BlockMatrix, Frames};

/// The colouring of so many rows with a bandwidth.
pub(super) type Cut = fn(usize, usize) -> Colouring;

/// A level of the hierarchy.
#[derive(Debug)]
pub(crate) struct Level<const C: usize> {
    /// Rows and columns of dropped components are zero. The finest level has one only if its cycle reads more than the
    /// couplings; its entries are those of the operator.
    pub(super) matrix: Option<BlockMatrix<C>>,
    pub(super) couplings: Couplings<C>,
    /// The permanently fixed components.
    pub(super) fixed: Vec<[bool; C]>,
    /// The components that are currently fixed or truncated.
    pub(crate) dropped: Vec<[bool; C]>,
    /// The frictional vertices, whose components may be dropped, increasing.
    frictional: Vec<u32>,
    /// The slopes of friction there, on the finest level since the last refresh.
    hessians: Vec<SMatrix<f64, C, C>>,
    /// The rows that truncation and friction can change, increasing.
    pub(super) strip: Vec<u32>,
    /// The frictional vertices on the finer level: (this level's vertex, the finer level's).
    pub(super) copies: Vec<(u32, u32)>,
    /// The cuts between parts of rows whose Galerkin products are computed in parallel.
    pub(super) cuts: Vec<usize>,
    /// The position of a column in its row, once per part; scratch of the Galerkin product.
    pub(super) positions: Vec<u32>,
    /// The order in which sweeps visit the rows.
    pub(super) slabs: Colouring,
    /// The sets of the line smoother; empty without stretched cells, and on the coarsest level.
    pub(super) sets: Sets<C>,
    /// The frames of the finest level. Coarser levels keep the coordinates.
    pub(super) frames: Frames<C>,
}

impl<const C: usize> Level<C> {
    /// The number of vertices.
    pub(super) fn size(&self) -> usize {
        self.dropped.len()
    }

    /// The matrix of the finest level, whose entries are those of the operator.
    pub(super) fn of_operator<'a>(&'a self, operator: &'a BlockMatrix<C>) -> Entries<'a, C> {
        Entries {
            rows: Rows::of(operator),
            dropped: &self.dropped,
            frictional: &self.frictional,
            hessians: &self.hessians,
        }
    }

    /// The matrix of a level; that of the finest is given by the operator.
    pub(super) fn entries<'a>(&'a self, operator: &'a BlockMatrix<C>) -> Entries<'a, C> {
        match &self.matrix {
            Some(matrix) => Entries {
                rows: Rows::of(matrix),
                dropped: &self.dropped,
                frictional: &[],
                hessians: &[],
            },
            None => self.of_operator(operator),
        }
    }

    /// The components of a vertex that its coarse copy drops. A vertex with axes of its own drops all or none.
    fn seen(&self, vertex: usize, mask: &[bool; C]) -> [bool; C] {
        match self.frames.of(vertex) {
            None => *mask,
            Some(_) => [mask.iter().all(|&dropped| dropped); C],
        }
    }

    pub(super) fn same_pattern(&self, operator: &BlockMatrix<C>, fixed: &[[bool; C]]) -> bool {
        self.fixed == fixed && self.couplings.has_pattern_of(operator, &self.slabs)
    }
}

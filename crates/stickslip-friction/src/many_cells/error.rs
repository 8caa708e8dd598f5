//! Errors for friction of many cells.

use crate::FrictionError;

/// A parameter of [`QuasiDynamicFriction`](crate::QuasiDynamicFriction) that is out of its range.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ManyCellsError {
    /// A parameter of a cell.
    #[error("cell {cell}: {source}")]
    Cell {
        /// The cell, from 0.
        cell: usize,
        /// Its parameter.
        source: FrictionError,
    },
    /// A parameter that all cells share.
    #[error(transparent)]
    Shared(#[from] FrictionError),
}

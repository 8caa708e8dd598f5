//! How an interaction is stored.

use super::pairs::{Pairs, Rows};
use crate::hmatrix::{Approximation, HMatrix, HMatrixError};

/// The largest number of cells of a fault that is stored whole unless an approximation is asked for.
pub(crate) const WHOLE: usize = 2000;

/// The approximation of an interaction: that asked for, else none up to [`WHOLE`] cells, and the default beyond.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct Storage {
    asked: Option<Approximation>,
    limit: Option<u64>,
}

impl Storage {
    pub(crate) fn of(approximation: Approximation) -> Self {
        Self {
            asked: Some(approximation),
            limit: None,
        }
    }

    /// The default with a limit of so many bytes.
    pub(crate) fn within(bytes: u64) -> Self {
        Self {
            asked: None,
            limit: Some(bytes),
        }
    }

    pub(crate) fn approximation(&self, cells: usize) -> Approximation {
        let default = || {
            let default = Approximation::default();
            if cells > WHOLE {
                default
            } else {
                default.without_far_blocks()
            }
        };
        let found = self.asked.unwrap_or_else(default);
        match self.limit {
            Some(bytes) => found.with_memory_limit(bytes),
            None => found,
        }
    }

    /// Refuses an interaction beyond the limit of memory, as its near blocks and some far ones tell. One that fits without any
    /// approximation is not looked at.
    pub(crate) fn check<P: Pairs<C>, const C: usize>(&self, pairs: &P) -> Result<(), HMatrixError> {
        let cells = [pairs.extents(), pairs.source_extents()];
        let approximation = self.approximation(cells[0].len().max(cells[1].len()));
        let rows = Rows::new(pairs);
        HMatrix::check_memory(&rows, cells.each_ref().map(Vec::as_slice), &approximation)
    }
}

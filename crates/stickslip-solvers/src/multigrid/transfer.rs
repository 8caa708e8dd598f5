//! Interpolation between two levels.

use crate::Prolongation;
use crate::block_matrix::Rows;

/// Prolongation and its transpose, both by rows.
#[derive(Debug, Clone)]
pub(crate) struct Transfer {
    /// Rows: fine vertices.
    pub(super) prolongation: Prolongation,
    /// Rows: coarse vertices.
    pub(super) restriction: Prolongation,
}

impl Transfer {
    pub(super) fn new(prolongation: &Prolongation) -> Self {
        Self {
            prolongation: prolongation.to_csr(),
            restriction: prolongation.transpose_view().to_csr(),
        }
    }

    pub(super) fn fine_count(&self) -> usize {
        self.prolongation.rows()
    }

    /// The fine vertex at the position of a coarse one.
    pub(super) fn copy_of(&self, coarse: usize) -> usize {
        let mut found = coarse;
        self.for_each_copy(|fine, parent| {
            if parent == coarse {
                found = fine;
            }
        });
        found
    }

    /// Calls `visit(fine, coarse)` for every fine vertex that is a coarse one.
    pub(super) fn for_each_copy(&self, mut visit: impl FnMut(usize, usize)) {
        let rows = Rows::of(&self.prolongation);
        for fine in 0..self.prolongation.rows() {
            if let (Some((coarse, _)), None) = {
                let mut row = rows.row(fine);
                (row.next(), row.next())
            } {
                visit(fine, coarse);
            }
        }
    }
}

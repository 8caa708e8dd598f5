//! An operator between the unknowns in the order of elimination.

use pulp::{Arch, Simd, WithSimd};
use sprs::{CsMatI, TriMatI};

use crate::BlockMatrix;
use crate::block_matrix::Rows;
use crate::cholesky::Layout;
use crate::several_vectors::{Row, combine};

/// Both triangles by rows, without the zeros inside blocks.
pub(super) struct Ordered {
    rows: CsMatI<f64, u32>,
}

impl Ordered {
    /// From an operator with the pattern of the layout.
    pub(super) fn new<const C: usize>(layout: &Layout<C>, operator: &BlockMatrix<C>) -> Self {
        let (unknowns, blocks) = (layout.unknowns(), operator.data());
        let mut entries = TriMatI::with_capacity((unknowns, unknowns), 2 * layout.sources.len());
        for (column, bounds) in layout.lower.starts.windows(2).enumerate() {
            for entry in bounds[0]..bounds[1] {
                let (row, (block, r, c)) = (layout.lower.rows[entry], layout.sources[entry]);
                let value = blocks[block as usize][(r as usize, c as usize)];
                if value != 0.0 {
                    entries.add_triplet(row, column, value);
                    if row != column {
                        entries.add_triplet(column, row, value);
                    }
                }
            }
        }
        Self {
            rows: entries.to_csr(),
        }
    }

    /// `N x` for several vectors.
    pub(super) fn multiply(&self, x: &[Row], into: &mut [Row]) {
        Arch::new().dispatch(Multiply {
            rows: Rows::of(&self.rows),
            x,
            into,
        });
    }
}

struct Multiply<'a> {
    rows: Rows<'a, f64>,
    x: &'a [Row],
    into: &'a mut [Row],
}

impl WithSimd for Multiply<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        for (row, into) in self.into.iter_mut().enumerate() {
            let entries = self.rows.range(row);
            let places = &self.rows.columns[entries.clone()];
            *into = combine(simd, &self.rows.values[entries], places, self.x);
        }
    }
}

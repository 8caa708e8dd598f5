//! An operator between the unknowns in the order of elimination.

use pulp::{Arch, Simd, WithSimd};

use crate::BlockMatrix;
use crate::abreast::{Row, combine};
use crate::cholesky::Layout;

/// Both triangles by rows, without the zeros that blocks hold.
pub(super) struct Ordered {
    starts: Vec<usize>,
    places: Vec<u32>,
    values: Vec<f64>,
}

impl Ordered {
    /// Of an operator with the pattern of the layout.
    pub(super) fn new<const C: usize>(layout: &Layout<C>, operator: &BlockMatrix<C>) -> Self {
        let (unknowns, blocks) = (layout.unknowns(), operator.data());
        let lower = (0..unknowns).flat_map(|column| {
            let entries = layout.lower.starts[column]..layout.lower.starts[column + 1];
            entries.filter_map(move |entry| {
                let (block, row, of) = layout.sources[entry];
                let value = blocks[block as usize][(row as usize, of as usize)];
                (value != 0.0).then_some((layout.lower.rows[entry], column, value))
            })
        });
        let mut starts = vec![0; unknowns + 1];
        for (row, column, _) in lower.clone() {
            starts[row + 1] += 1;
            if row != column {
                starts[column + 1] += 1;
            }
        }
        for row in 0..unknowns {
            starts[row + 1] += starts[row];
        }
        let mut next = starts.clone();
        let (mut places, mut values) = (vec![0; starts[unknowns]], vec![0.0; starts[unknowns]]);
        let mut put = |row: usize, column: usize, value| {
            places[next[row]] = column as u32;
            values[next[row]] = value;
            next[row] += 1;
        };
        for (row, column, value) in lower {
            put(row, column, value);
            if row != column {
                put(column, row, value);
            }
        }
        Self {
            starts,
            places,
            values,
        }
    }

    /// `N x` of vectors abreast.
    pub(super) fn multiply(&self, x: &[Row], into: &mut [Row]) {
        Arch::new().dispatch(Multiply {
            operator: self,
            x,
            into,
        });
    }
}

struct Multiply<'a> {
    operator: &'a Ordered,
    x: &'a [Row],
    into: &'a mut [Row],
}

impl WithSimd for Multiply<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let Ordered {
            starts,
            places,
            values,
        } = self.operator;
        for (row, into) in self.into.iter_mut().enumerate() {
            let entries = starts[row]..starts[row + 1];
            *into = combine(simd, &values[entries.clone()], &places[entries], self.x);
        }
    }
}

//! Block matrices and their rows.

use nalgebra::{SMatrix, SVector};

use crate::parts::sum_parts;

/// A square sparse matrix with one `C x C` block for each pair of neighbouring vertices.
///
/// Compressed rows with sorted columns and every diagonal block stored. The matrix is symmetric, as finite element
/// assembly makes it. Indices are `u32`. They save a tenth of the memory traffic of a sweep with `2 x 2` blocks and a
/// quarter with scalars.
pub type BlockMatrix<const C: usize> = sprs::CsMatI<SMatrix<f64, C, C>, u32>;

/// Interpolation weights from a coarse mesh (columns) to the next finer one (rows).
pub type Prolongation = sprs::CsMatI<f64, u32>;

/// Row-wise access to a compressed matrix without a view object per row.
#[derive(Clone, Copy)]
pub(crate) struct Rows<'a, T> {
    pub(crate) starts: &'a [u32],
    pub(crate) columns: &'a [u32],
    pub(crate) values: &'a [T],
}

/// The adjacency of the vertices.
#[cfg(any(feature = "multigrid", feature = "condensed"))]
pub(crate) type Graph<'a> = Rows<'a, ()>;

impl<'a, T> Rows<'a, T> {
    pub(crate) fn of(matrix: &'a sprs::CsMatI<T, u32>) -> Self {
        Rows {
            starts: matrix.indptr().into_raw_storage(),
            columns: matrix.indices(),
            values: matrix.data(),
        }
    }

    /// The pattern without the values.
    #[cfg(any(feature = "multigrid", feature = "condensed"))]
    pub(crate) fn graph(&self) -> Graph<'a> {
        Graph {
            starts: self.starts,
            columns: self.columns,
            values: &[],
        }
    }

    /// The row starts and the columns of all rows.
    pub(crate) fn pattern(&self) -> (&'a [u32], &'a [u32]) {
        (self.starts, self.columns)
    }

    /// The bandwidth: the largest distance of a column from its row.
    pub(crate) fn bandwidth(&self) -> usize {
        (0..self.starts.len().saturating_sub(1))
            .flat_map(|i| self.row(i).map(move |(j, _)| i.abs_diff(j)))
            .max()
            .unwrap_or(0)
    }

    /// Whether the matrix is diagonal. The test has no branch per entry, since it runs before every product.
    pub(crate) fn is_diagonal(&self) -> bool {
        let counts = |indices: &[u32]| {
            let others = sum_parts(0..indices.len(), (), &|part, ()| {
                let counted = indices[part.clone()].iter().zip(part.start as u32..);
                let all = counted.fold(true, |all, (&index, k)| all & (index == k));
                f64::from(u8::from(!all))
            });
            others == 0.0
        };
        self.columns.len() + 1 == self.starts.len() && counts(self.starts) && counts(self.columns)
    }

    #[inline(always)]
    pub(crate) fn range(&self, row: usize) -> std::ops::Range<usize> {
        self.starts[row] as usize..self.starts[row + 1] as usize
    }

    #[inline(always)]
    pub(crate) fn row(
        &self,
        row: usize,
    ) -> impl Iterator<Item = (usize, &'a T)> + Clone + use<'a, T> {
        let range = self.range(row);
        let (columns, values) = (&self.columns[range.clone()], &self.values[range]);
        columns.iter().map(|&j| j as usize).zip(values)
    }
}

/// The entries of a block, in double or in single precision.
pub(crate) trait Block<const C: usize>: Copy + Send + Sync {
    fn entry(&self, row: usize, column: usize) -> f64;
}

impl<const C: usize> Block<C> for SMatrix<f64, C, C> {
    #[inline(always)]
    fn entry(&self, row: usize, column: usize) -> f64 {
        self.data.0[column][row]
    }
}

impl<B: Block<C>, const C: usize> Block<C> for &B {
    #[inline(always)]
    fn entry(&self, row: usize, column: usize) -> f64 {
        (**self).entry(row, column)
    }
}

/// By columns.
impl<const C: usize> Block<C> for [[f32; C]; C] {
    #[inline(always)]
    fn entry(&self, row: usize, column: usize) -> f64 {
        f64::from(self[column][row])
    }
}

/// `sum of block_j x_j` over some entries of a row; `x` begins at vertex `first`.
///
/// One accumulator per entry of a block: the chains are independent, and the loads fill a register.
#[inline(always)]
pub(crate) fn partial_product<B: Block<C>, const C: usize>(
    columns: &[u32],
    blocks: &[B],
    first: usize,
    x: &[SVector<f64, C>],
) -> SVector<f64, C> {
    let columns = columns.iter().map(|&j| j as usize - first);
    sum_products(columns.zip(blocks), x)
}

/// `sum of block_j x_j`, given the positions and the blocks.
#[inline(always)]
pub(crate) fn sum_products<B: Block<C>, const C: usize>(
    entries: impl Iterator<Item = (usize, B)>,
    x: &[SVector<f64, C>],
) -> SVector<f64, C> {
    let mut sums = [[0.0; C]; C];
    for (j, block) in entries {
        let x_j = &x[j].data.0[0];
        for c in 0..C {
            for r in 0..C {
                sums[c][r] += block.entry(r, c) * x_j[c];
            }
        }
    }
    let mut sum = sums[0];
    for column in &sums[1..] {
        for r in 0..C {
            sum[r] += column[r];
        }
    }
    SVector::from(sum)
}

/// `(A x)_row`.
#[inline(always)]
pub(crate) fn row_product<B: Block<C>, const C: usize>(
    matrix: &Rows<'_, B>,
    row: usize,
    x: &[SVector<f64, C>],
) -> SVector<f64, C> {
    row_product_behind(matrix, row, 0, x)
}

/// `(A x)_row`, of an `x` that begins at vertex `first`, before any column of the row.
#[inline(always)]
pub(crate) fn row_product_behind<B: Block<C>, const C: usize>(
    matrix: &Rows<'_, B>,
    row: usize,
    first: usize,
    x: &[SVector<f64, C>],
) -> SVector<f64, C> {
    let range = matrix.range(row);
    let columns = &matrix.columns[range.clone()];
    partial_product(columns, &matrix.values[range], first, x)
}

/// Adds to `y`, which begins at vertex `first`, the contribution of `x_row` to `A^T x`, last entry of the row first.
#[cfg(feature = "multigrid")]
#[inline(always)]
pub(crate) fn add_transposed_row<B: Block<C>, const C: usize>(
    matrix: &Rows<'_, B>,
    row: usize,
    x_row: &SVector<f64, C>,
    first: usize,
    y: &mut [SVector<f64, C>],
) {
    let range = matrix.range(row);
    let entries = matrix.columns[range.clone()]
        .iter()
        .zip(&matrix.values[range]);
    for (&j, block) in entries.rev() {
        let y_j = &mut y[j as usize - first];
        for c in 0..C {
            let mut product = 0.0;
            for r in 0..C {
                product += block.entry(r, c) * x_row[r];
            }
            y_j[c] += product;
        }
    }
}

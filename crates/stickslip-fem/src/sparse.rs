use nalgebra::SMatrix;
use sprs::CsMatI;

/// A sparse operator on fields with C components: compressed rows of C x C blocks, one block per pair of vertices that
/// share a cell.
///
/// Row p and column q belong to vertices p and q. Columns are sorted within a row, and the diagonal
/// block is always stored.
pub type BlockMatrix<const C: usize> = CsMatI<SMatrix<f64, C, C>, u32>;

/// Interpolation from a level to the next finer one: a row per fine vertex, a column per coarse one, the same weights
/// for every component.
///
/// A row is a single 1 (the vertex exists on the coarse level) or two entries 1/2 (it halves an edge). After several
/// bisections it has the nonzero barycentric coordinates in a coarse cell; from an auxiliary level, weights of
/// surrounding coarse vertices with the sum 1.
pub type Prolongation = CsMatI<f64, u32>;

/// The block-diagonal operator of these blocks.
pub(crate) fn block_diagonal<const C: usize>(blocks: Vec<SMatrix<f64, C, C>>) -> BlockMatrix<C> {
    let size = blocks.len();
    let rows = (0..=size as u32).collect();
    let columns = (0..size as u32).collect();
    BlockMatrix::new((size, size), rows, columns, blocks)
}

use thiserror::Error;

/// A defect of a matrix as an operator on fields, see [`Matrix::defect`](crate::Matrix::defect).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum MatrixDefect {
    /// The matrix is not square.
    #[error("has {rows} rows and {columns} columns")]
    NotSquare {
        /// The number of its rows.
        rows: usize,
        /// The number of its columns.
        columns: usize,
    },
    /// The number of rows is no multiple of the number of components.
    #[error("has {rows} rows, which are no vertices of {components} components")]
    NoBlocks {
        /// The number of its rows, of one number each.
        rows: usize,
        /// The number of components per vertex.
        components: usize,
    },
    /// The matrix is stored by columns, whose blocks would be taken for those of rows.
    #[error("is stored by columns: `to_csr` makes rows of them")]
    ByColumns,
}

use thiserror::Error;

/// What keeps a matrix from being an operator on fields, see [`Operator::defect`](crate::Operator::defect).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum MatrixDefect {
    /// It is not square.
    #[error("has {rows} rows and {columns} columns")]
    NotSquare {
        /// Its rows.
        rows: usize,
        /// Its columns.
        columns: usize,
    },
    /// Its rows are no blocks of as many components.
    #[error("has {rows} rows, which are no vertices of {components} components")]
    NoBlocks {
        /// Its rows, of one number each.
        rows: usize,
        /// The components of a vertex.
        components: usize,
    },
    /// It is stored by columns, whose blocks would be taken for those of rows.
    #[error("is stored by columns: `to_csr` makes rows of them")]
    ByColumns,
}

//! Failures between processes.

use thiserror::Error;

/// The failures of PETSc, MPI and of bodies in pieces.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum Error {
    /// A call of PETSc or MPI has failed.
    #[error("{call} failed with code {code}")]
    Library {
        /// The function.
        call: &'static str,
        /// Its error code.
        code: i32,
    },
    /// More than an index of MPI counts.
    #[error("{size} entries in one process are too many: take more processes")]
    TooLarge {
        /// The number of processes.
        size: usize,
    },
    /// A process would have no cell of the mesh.
    #[error("{cells} cells are too few for {processes} processes: refine, or take fewer processes")]
    TooFewCells {
        /// The cells of the finest mesh that is divided.
        cells: usize,
        /// The processes.
        processes: usize,
    },
    /// A vertex of the mesh that no process has.
    #[error("a vertex has no owner: do two parts of the mesh meet in vertices of their own?")]
    NoOwner,
    /// Values that cannot be sent from process to process.
    #[error("values cannot be sent to another process: {0}")]
    Encoding(#[source] Box<dyn std::error::Error + Send + Sync>),
    /// Another process has the reason.
    #[error("another process has failed")]
    Elsewhere,
    /// A checkpoint that cannot be written, or from which a run cannot go on, as this process finds it.
    #[error(transparent)]
    File(#[from] stickslip::record::FileError),
    /// A mesh that cannot be refined or restricted.
    #[error(transparent)]
    Fem(#[from] stickslip::fem::FemError),
}

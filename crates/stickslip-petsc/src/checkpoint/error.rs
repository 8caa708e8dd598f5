//! Failures of a checkpoint of several processes.

use stickslip::record::FileError;
use thiserror::Error;

/// A checkpoint that cannot be written, or from which a run cannot go on.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum SharedCheckpointError {
    /// The file, as this process finds it.
    #[error(transparent)]
    File(#[from] FileError),
    /// PETSc or MPI has failed, or another process, which has the reason.
    #[error(transparent)]
    Processes(#[from] crate::Error),
}

//! What can go wrong with the file of a body.

use std::io;
use std::path::PathBuf;

use thiserror::Error;

use crate::{Difference, SceneError};

/// A reduced body that cannot be written to a file or read from one.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum BodyFileError {
    /// The file cannot be read.
    #[error("cannot read {}: {source}", .path.display())]
    Read {
        /// Where it was to be.
        path: PathBuf,
        /// Why not.
        source: io::Error,
    },
    /// The file cannot be written; the one that was there still is.
    #[error("cannot write {}: {source}", .path.display())]
    Write {
        /// Where it was to be.
        path: PathBuf,
        /// Why not.
        source: io::Error,
    },
    /// The file is something else.
    #[error("{} is not a reduced body", .path.display())]
    NotABody {
        /// Where it is.
        path: PathBuf,
    },
    /// The file is of another version of this crate.
    #[error("{} is a reduced body of format {found}, this program reads format {expected}", .path.display())]
    Version {
        /// Where it is.
        path: PathBuf,
        /// Its format.
        found: u32,
        /// The format of this program.
        expected: u32,
    },
    /// The file has been cut or changed.
    #[error("{} is damaged: its checksum is not that of its contents", .path.display())]
    Damaged {
        /// Where it is.
        path: PathBuf,
    },
    /// The contents agree with their checksum, and are no body.
    #[error("{} does not hold what a reduced body is made of", .path.display())]
    Contents {
        /// Where it is.
        path: PathBuf,
    },
    /// The file is of a body with another mesh, material, or held, moved or kept parts than the scene's.
    #[error("{} is another body: {difference}", .path.display())]
    AnotherBody {
        /// Where it is.
        path: PathBuf,
        /// The first of what differs.
        difference: Difference,
    },
    /// The scene at hand is none.
    #[error(transparent)]
    Scene(#[from] SceneError),
}

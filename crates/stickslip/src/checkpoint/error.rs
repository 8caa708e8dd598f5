//! What can go wrong with a checkpoint.

use std::io;
use std::path::PathBuf;

use thiserror::Error;

use super::mark::Difference;
use crate::SceneError;

/// A checkpoint that cannot be written, or from which a run cannot go on.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum CheckpointError {
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
    #[error("{} is not a checkpoint", .path.display())]
    NotACheckpoint {
        /// Where it is.
        path: PathBuf,
    },
    /// The file is of another version of this crate.
    #[error("{} is a checkpoint of format {found}, this program reads format {expected}", .path.display())]
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
    /// The file is of another scene, or has other tags.
    #[error("{} is a checkpoint of another scene: {difference}", .path.display())]
    AnotherScene {
        /// Where it is.
        path: PathBuf,
        /// The first of what differs.
        difference: Difference,
    },
    /// The file is of this scene, by a method that carries other numbers.
    #[error("{} does not fit the method: {source}", .path.display())]
    State {
        /// Where it is.
        path: PathBuf,
        /// What does not fit.
        source: Box<SceneError>,
    },
    /// The file holds other records than those asked for.
    #[error("{} holds other records than those asked for: {source}", .path.display())]
    Records {
        /// Where it is.
        path: PathBuf,
        /// How that shows.
        source: postcard::Error,
    },
    /// The records are of a type that cannot be encoded.
    #[error("records cannot be encoded: {0}")]
    Encode(postcard::Error),
}

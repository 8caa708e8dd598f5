//! What can go wrong with a file.

use std::error::Error as Cause;
use std::io;
use std::path::PathBuf;

use thiserror::Error;

use crate::SceneError;

/// A file, or what a recorder writes to, that cannot be written, or from which a run or a reduced body cannot be read.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum FileError {
    /// The file cannot be read.
    #[error("cannot read {}: {source}", .path.display())]
    Read {
        /// Where it was to be.
        path: PathBuf,
        /// Why not.
        source: io::Error,
    },
    /// A file or a row of a table cannot be written. A checkpoint or a reduced body that was there still is.
    #[error(
        "cannot write {}: {source}",
        path.as_ref().map_or_else(|| "a row of a table".to_string(), |path| path.display().to_string())
    )]
    Write {
        /// Where it was to be; `None` for a row, whose writer is the caller's.
        path: Option<PathBuf>,
        /// Why not.
        source: io::Error,
    },
    /// The file is something else.
    #[error("{} is not a {kind}", .path.display())]
    Kind {
        /// Where it is.
        path: PathBuf,
        /// What it was to be: "checkpoint" or "reduced body".
        kind: &'static str,
    },
    /// The file is of another version of this crate.
    #[error("{} is a {kind} of format {found}, this program reads format {expected}: write it anew", .path.display())]
    Version {
        /// Where it is.
        path: PathBuf,
        /// What it is.
        kind: &'static str,
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
    /// A checkpoint of another scene or with other tags; a reduced body with another mesh, material, or fixed,
    /// prescribed or kept parts than those of the scene.
    #[error("{} is a {kind} of another scene: {what} is {found} there and {expected} here", .path.display())]
    Mismatch {
        /// Where it is.
        path: PathBuf,
        /// What it is.
        kind: &'static str,
        /// The first of what differs.
        what: String,
        /// As it is in the file.
        found: String,
        /// As it is in the scene at hand.
        expected: String,
    },
    /// A checkpoint of this scene, by a method that has_algorithmic other numbers.
    #[error("{} does not fit the method: {source}", .path.display())]
    State {
        /// Where it is.
        path: PathBuf,
        /// What does not fit.
        source: Box<SceneError>,
    },
    /// The contents agree with their checksum, and are other ones than those asked for.
    #[error(
        "{} does not hold {what}{}",
        .path.display(),
        source.as_ref().map_or_else(String::new, |source| format!(": {source}"))
    )]
    Contents {
        /// Where it is.
        path: PathBuf,
        /// What was asked for: "the records asked for" or "a reduced body".
        what: &'static str,
        /// How that shows, if decoding failed.
        source: Option<Box<dyn Cause + Send + Sync>>,
    },
    /// What is to be written cannot be encoded.
    #[error("{what} cannot be encoded: {source}")]
    Encode {
        /// What it is: "records" or "a reduced body".
        what: &'static str,
        /// Why not.
        source: Box<dyn Cause + Send + Sync>,
    },
    /// The scene is not valid, or a recorder does not fit it.
    #[error(transparent)]
    Scene(#[from] SceneError),
}

impl From<io::Error> for FileError {
    /// Of a row of a table.
    fn from(source: io::Error) -> Self {
        Self::Write { path: None, source }
    }
}

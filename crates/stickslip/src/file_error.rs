//! Errors of reading and writing files.

use std::error::Error as Cause;
use std::io;
use std::path::PathBuf;

use thiserror::Error;

use crate::SceneError;

/// A file, or the output of a recorder, that cannot be written; or a file from which a run or a reduced body cannot be
/// read.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum FileError {
    /// The file cannot be read.
    #[error("cannot read {}: {source}", .path.display())]
    Read {
        /// The path of the file.
        path: PathBuf,
        /// The cause.
        source: io::Error,
    },
    /// A file or a row of a table cannot be written. An existing checkpoint or reduced body remains.
    #[error(
        "cannot write {}: {source}",
        path.as_ref().map_or_else(|| "a row of a table".to_string(), |path| path.display().to_string())
    )]
    Write {
        /// The path of the file; `None` for a row, whose writer belongs to the caller.
        path: Option<PathBuf>,
        /// The cause.
        source: io::Error,
    },
    /// Displacement off a fault cannot be had.
    #[cfg(feature = "bie")]
    #[error(transparent)]
    Receivers(#[from] stickslip_bie::ReceiverError),
    /// Two points of a recorder have one file: their names agree, rounded.
    #[error(
        "{} would be the file of two points, {} and {}: choose points further apart, or a smaller unit of the names",
        .path.display(), .points[0], .points[1]
    )]
    SameName {
        /// The path of the file.
        path: PathBuf,
        /// Both points.
        points: [String; 2],
    },
    /// A line of a text file is not what it should be.
    #[error("{}, line {line}: {what}", .path.display())]
    Line {
        /// The path of the file.
        path: PathBuf,
        /// The number of the line, counted from 1.
        line: usize,
        /// The defect.
        what: String,
    },
    /// The file is of another kind.
    #[error("{} is not a {kind}", .path.display())]
    Kind {
        /// The path of the file.
        path: PathBuf,
        /// The expected kind: "checkpoint" or "reduced body".
        kind: &'static str,
    },
    /// The file was written by another version of this crate.
    #[error("{} is a {kind} of format {found}, this program reads format {expected}: write it anew", .path.display())]
    Version {
        /// The path of the file.
        path: PathBuf,
        /// The kind of the file.
        kind: &'static str,
        /// The format version of the file.
        found: u32,
        /// The format version of this program.
        expected: u32,
    },
    /// The file has been truncated or changed.
    #[error("{} is damaged: its checksum is not that of its contents", .path.display())]
    Damaged {
        /// The path of the file.
        path: PathBuf,
    },
    /// A checkpoint of another scene or with other tags; a reduced body with another mesh, material, or fixed,
    /// prescribed or kept parts than those of the scene.
    #[error("{} is a {kind} of another scene: {what} is {found} there and {expected} here", .path.display())]
    Mismatch {
        /// The path of the file.
        path: PathBuf,
        /// The kind of the file.
        kind: &'static str,
        /// The first quantity that differs.
        what: String,
        /// Its value in the file.
        found: String,
        /// Its value in the present scene.
        expected: String,
    },
    /// A checkpoint of this scene from a method that stores other fields.
    #[error("{} does not fit the method: {source}", .path.display())]
    State {
        /// The path of the file.
        path: PathBuf,
        /// The field that does not fit.
        source: Box<SceneError>,
    },
    /// The contents agree with their checksum and are not the requested ones.
    #[error(
        "{} does not hold {what}{}",
        .path.display(),
        source.as_ref().map_or_else(String::new, |source| format!(": {source}"))
    )]
    Contents {
        /// The path of the file.
        path: PathBuf,
        /// The requested contents: "the records asked for" or "a reduced body".
        what: &'static str,
        /// The error of the decoder, if decoding failed.
        source: Option<Box<dyn Cause + Send + Sync>>,
    },
    /// The data cannot be encoded.
    #[error("{what} cannot be encoded: {source}")]
    Encode {
        /// The data: "records" or "a reduced body".
        what: &'static str,
        /// The cause.
        source: Box<dyn Cause + Send + Sync>,
    },
    /// The scene is invalid, or a recorder does not fit it.
    #[error(transparent)]
    Scene(#[from] SceneError),
}

impl From<io::Error> for FileError {
    /// The error of a row of a table.
    fn from(source: io::Error) -> Self {
        Self::Write { path: None, source }
    }
}

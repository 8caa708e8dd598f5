//! Places and numbered items of a file, as errors name them.

use std::fmt;

/// A place in a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum FilePlace {
    /// The line of a text, from 1.
    Line(usize),
    /// The line and column of a table, from 1.
    Entry {
        /// The line.
        line: usize,
        /// The column.
        column: usize,
    },
    /// The offset in a binary file, from 0.
    Byte(usize),
}

impl fmt::Display for FilePlace {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Line(line) => write!(f, "line {line}"),
            Self::Entry { line, column } => write!(f, "line {line}, column {column}"),
            Self::Byte(byte) => write!(f, "byte {byte}"),
        }
    }
}

/// A numbered item of a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FileItem {
    /// The item: "node", "entity" or "name of group".
    pub what: &'static str,
    /// Its number in the file.
    pub number: i128,
    /// The dimension of an entity or a group.
    pub dimension: Option<usize>,
}

impl FileItem {
    #[cfg(feature = "gmsh")]
    pub(crate) fn new(
        what: &'static str,
        number: impl Into<i128>,
        dimension: Option<usize>,
    ) -> Self {
        Self {
            what,
            number: number.into(),
            dimension,
        }
    }
}

impl fmt::Display for FileItem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} {}", self.what, self.number)?;
        match self.dimension {
            Some(dimension) => write!(f, " of dimension {dimension}"),
            None => Ok(()),
        }
    }
}

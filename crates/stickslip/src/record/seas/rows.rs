//! Whole rows of numbers, separated by spaces.

use std::fmt::Write as _;
use std::fs::File;
use std::io;
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};

use super::SeasHeader;
use crate::FileError;

/// The number of bytes that are kept before they are written.
const KEPT: usize = 1 << 13;

/// A column: its name in the line of names, and its quantity and unit in a comment.
pub(in crate::record) type Column<'a> = (&'a str, &'a str);

/// Writes the header before the first row, and rows as a whole: a run that is killed leaves no half of a row.
///
/// The first write error is kept, and no row is written after it.
#[derive(Debug)]
pub(in crate::record) struct Rows<W: io::Write> {
    /// None once it has been returned.
    writer: Option<W>,
    path: Option<PathBuf>,
    kept: String,
    error: Option<FileError>,
}

impl Rows<File> {
    pub(in crate::record) fn create(path: &Path) -> Result<Self, FileError> {
        let file = File::create(path).map_err(|source| FileError::Write {
            path: Some(path.into()),
            source,
        })?;
        let mut rows = Self::new(file);
        rows.path = Some(path.into());
        Ok(rows)
    }
}

impl<W: io::Write> Rows<W> {
    pub(in crate::record) fn new(writer: W) -> Self {
        Self {
            writer: Some(writer),
            path: None,
            kept: String::with_capacity(2 * KEPT),
            error: None,
        }
    }

    /// The header, the columns as comments, and the lines of their names.
    pub(in crate::record) fn begin(
        &mut self,
        header: &SeasHeader,
        location: &str,
        columns: &[Column<'_>],
    ) {
        self.kept.push_str(&header.to_string());
        let text = &mut self.kept;
        // Writing into a string does not fail.
        let _ = writeln!(text, "# location={location}");
        for (n, (_, quantity)) in columns.iter().enumerate() {
            let _ = writeln!(text, "# Column #{} = {quantity}", n + 1);
        }
        text.push_str("# The line below lists the names of the data fields\n");
    }

    /// A line of names.
    pub(in crate::record) fn names<'a>(&mut self, names: impl IntoIterator<Item = &'a str>) {
        let begin = self.kept.len();
        for name in names {
            let space = if self.kept.len() > begin { " " } else { "" };
            self.kept.push_str(space);
            self.kept.push_str(name);
        }
        self.kept.push('\n');
    }

    /// A row. Numbers read back bit for bit.
    pub(in crate::record) fn row(&mut self, numbers: impl IntoIterator<Item = f64>) {
        if self.error.is_some() {
            return;
        }
        for (n, number) in numbers.into_iter().enumerate() {
            let space = if n > 0 { " " } else { "" };
            let _ = write!(self.kept, "{space}{number:e}");
        }
        self.kept.push('\n');
        if self.kept.len() >= KEPT {
            self.write();
        }
    }

    /// Writes what is kept.
    pub(in crate::record) fn write(&mut self) {
        if let (Some(writer), None) = (&mut self.writer, &self.error) {
            let written = writer.write_all(self.kept.as_bytes());
            let written = written.and_then(|()| writer.flush());
            let path = &self.path;
            self.error = written.err().map(|source| FileError::Write {
                path: path.clone(),
                source,
            });
        }
        self.kept.clear();
    }

    /// The control flow: a failed row breaks the run.
    pub(in crate::record) fn flow(&self) -> ControlFlow<()> {
        if self.error.is_some() {
            ControlFlow::Break(())
        } else {
            ControlFlow::Continue(())
        }
    }

    pub(in crate::record) fn finish(mut self) -> Result<W, FileError> {
        self.write();
        match (self.error.take(), self.writer.take()) {
            (Some(error), _) => Err(error),
            (None, Some(writer)) => Ok(writer),
            (None, None) => Err(io::Error::from(io::ErrorKind::BrokenPipe).into()),
        }
    }
}

impl<W: io::Write> Drop for Rows<W> {
    fn drop(&mut self) {
        self.write();
    }
}

//! Rows of comma-separated values.

use std::fmt::Write as _;
use std::io;

use crate::FileError;

/// A table of comma-separated values, written row by row: one line of names, and one line of numbers per row.
///
/// Numbers read back bit for bit. Missing values are `NaN`. A row is one write: use a [`BufWriter`](io::BufWriter) for
/// files.
///
/// ```
/// use stickslip::record::Table;
///
/// let mut table = Table::new(Vec::new(), &["vertex", "slip"])?;
/// table.row([3.into(), 0.1.into()])?;
/// assert_eq!(table.finish()?, b"vertex,slip\n3,1e-1\n");
/// # Ok::<(), stickslip::record::FileError>(())
/// ```
#[derive(Debug)]
pub struct Table<W> {
    writer: W,
    line: String,
}

/// An entry of a [`Table`].
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum Entry {
    /// A count or an index.
    Count(usize),
    /// A number, in the unit of its column.
    Number(f64),
}

impl From<usize> for Entry {
    fn from(count: usize) -> Self {
        Self::Count(count)
    }
}

impl From<f64> for Entry {
    fn from(number: f64) -> Self {
        Self::Number(number)
    }
}

/// The longest number, its comma included: `-1.2345678901234567e-308,`.
const WIDTH: usize = 26;

impl<W: io::Write> Table<W> {
    /// Writes the names of the columns.
    ///
    /// # Errors
    /// [`FileError::Write`].
    pub fn new<S: AsRef<str>>(mut writer: W, columns: &[S]) -> Result<Self, FileError> {
        let mut line = String::with_capacity(WIDTH * columns.len());
        for (k, name) in columns.iter().enumerate() {
            let comma = if k > 0 { "," } else { "" };
            line.push_str(comma);
            line.push_str(name.as_ref());
        }
        line.push('\n');
        writer.write_all(line.as_bytes())?;
        Ok(Self { writer, line })
    }

    /// Writes a row.
    ///
    /// # Errors
    /// [`FileError::Write`].
    pub fn row(&mut self, entries: impl IntoIterator<Item = Entry>) -> Result<(), FileError> {
        self.line.clear();
        for (k, entry) in entries.into_iter().enumerate() {
            let comma = if k > 0 { "," } else { "" };
            // Writing into a string does not fail.
            let _ = match entry {
                Entry::Count(count) => write!(self.line, "{comma}{count}"),
                Entry::Number(number) => write!(self.line, "{comma}{number:e}"),
            };
        }
        self.line.push('\n');
        self.writer.write_all(self.line.as_bytes())?;
        Ok(())
    }

    /// Writes the buffered rows, and returns the writer.
    ///
    /// # Errors
    /// [`FileError::Write`].
    pub fn finish(mut self) -> Result<W, FileError> {
        self.writer.flush()?;
        Ok(self.writer)
    }
}

/// A table that stops at the first write error and stores it.
#[derive(Debug)]
pub(super) struct Lasting<W> {
    table: Table<W>,
    error: Option<FileError>,
}

impl<W: io::Write> Lasting<W> {
    pub(super) fn new<S: AsRef<str>>(writer: W, columns: &[S]) -> Result<Self, FileError> {
        Ok(Self {
            table: Table::new(writer, columns)?,
            error: None,
        })
    }

    /// Writes a row, unless an earlier one failed.
    pub(super) fn row(&mut self, entries: impl IntoIterator<Item = Entry>) {
        if self.error.is_none() {
            self.error = self.table.row(entries).err();
        }
    }

    /// The control flow: a failed row breaks the run.
    pub(super) fn flow(&self) -> std::ops::ControlFlow<()> {
        if self.error.is_some() {
            std::ops::ControlFlow::Break(())
        } else {
            std::ops::ControlFlow::Continue(())
        }
    }

    pub(super) fn finish(self) -> Result<W, FileError> {
        match self.error {
            Some(error) => Err(error),
            None => self.table.finish(),
        }
    }
}

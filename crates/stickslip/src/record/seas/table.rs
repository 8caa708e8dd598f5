//! Reading of files in the format of the SEAS benchmarks.

use std::fs::File;
use std::io::{BufRead, BufReader};
use std::path::Path;

use super::read::Lines;
use crate::FileError;

/// A file in the format of the SEAS benchmarks, of this code or another: comments `# key=value`, names, columns.
///
/// Names are the words before the first row, on one line or several. A file of slip on a line has its positions in the
/// first row, behind two zeros: [`positions`](Self::positions).
///
/// ```
/// use std::path::Path;
/// use stickslip::record::SeasTable;
///
/// let text = b"# problem=BP1-QD\n#\n\nt slip slip_rate shear_stress state\n0.0 0.0 -9.0 29.2 3.9\n1.0D+03,1e-6,-9.0,29.2,3.9\n";
/// let table = SeasTable::parse(&text[..], Path::new("fltst_dp000"))?;
/// assert_eq!(table.metadata("problem"), Some("BP1-QD"));
/// assert_eq!(table.column("t"), Some(&[0.0, 1e3][..]));
///
/// let text = b"# Row #1 = Depth (m) with two zeros first\nz\nt max_slip_rate slip\n0 0 0 500\n0 -9 0 0\n1e9 -8.9 1 1.1\n";
/// let slip = SeasTable::parse(&text[..], Path::new("slip.dat"))?;
/// assert_eq!(slip.positions(), Some(&[0.0, 500.0][..]));
/// assert_eq!(slip.columns()[3], [0.0, 1.1]);
/// # Ok::<(), stickslip::record::FileError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct SeasTable {
    comments: Vec<String>,
    names: Vec<String>,
    positions: Option<Vec<f64>>,
    columns: Vec<Vec<f64>>,
    rows: usize,
}

impl SeasTable {
    /// Reads a file. Numbers are separated by spaces, tabs or commas, and may have Fortran's exponents; blank lines are
    /// skipped. A last line without its line end is dropped if it is no whole row, as an interrupted program leaves it.
    ///
    /// # Errors
    /// [`FileError::Read`], [`FileError::Line`] for a row with another number of columns than the first one, or with a
    /// word, for as many names as there are no columns, and for a file without a row.
    pub fn read(path: impl AsRef<Path>) -> Result<Self, FileError> {
        let path = path.as_ref();
        let file = File::open(path).map_err(|source| FileError::Read {
            path: path.into(),
            source,
        })?;
        Self::parse(BufReader::new(file), path)
    }

    /// Reads text; errors name `path`.
    ///
    /// # Errors
    /// Those of [`read`](Self::read).
    pub fn parse(reader: impl BufRead, path: &Path) -> Result<Self, FileError> {
        let Lines {
            comments,
            mut names,
            mut rows,
        } = Lines::read(reader, path)?;
        let mut positions = None;
        if is_profile(&names, &rows) {
            positions = Some(rows.remove(0).split_off(2));
            // The name of the positions stands before the others.
            names = names.split_off(names.len().saturating_sub(3));
        }
        let width = rows.first().map_or(0, Vec::len);
        let fits = positions.is_some() || names.is_empty() || names.len() == width;
        if !fits {
            let what = format!("{} names {names:?} of {width} columns", names.len());
            let (path, line) = (path.into(), 1);
            return Err(FileError::Line { path, line, what });
        }
        let columns = (0..width).map(|n| rows.iter().map(|row| row[n]).collect());
        Ok(Self {
            comments,
            names,
            positions,
            columns: columns.collect(),
            rows: rows.len(),
        })
    }

    /// The value of the first comment `# key=value`.
    pub fn metadata(&self, key: &str) -> Option<&str> {
        let pairs = self.comments.iter().filter_map(|line| line.split_once('='));
        let mut pairs = pairs.map(|(key, value)| (key.trim(), value.trim()));
        pairs.find_map(|(found, value)| (found == key).then_some(value))
    }

    /// The comments, without their `#`.
    pub fn comments(&self) -> &[String] {
        &self.comments
    }

    /// The names of the columns, empty if the file has none. The last name of slip on a line is that of all columns
    /// from the third one on.
    pub fn names(&self) -> &[String] {
        &self.names
    }

    /// The columns, in their order.
    pub fn columns(&self) -> &[Vec<f64>] {
        &self.columns
    }

    /// The first column with a name.
    pub fn column(&self, name: &str) -> Option<&[f64]> {
        let index = self.names.iter().position(|found| found == name)?;
        self.columns.get(index).map(Vec::as_slice)
    }

    /// The positions of slip on a line \[m\], those of the columns from the third one on; none in other files.
    pub fn positions(&self) -> Option<&[f64]> {
        self.positions.as_deref()
    }

    /// The number of rows.
    pub fn len(&self) -> usize {
        self.rows
    }

    /// Whether there are no rows.
    pub fn is_empty(&self) -> bool {
        self.rows == 0
    }
}

/// Whether the names end with `t max_slip_rate` and one more for all other columns, and the first row begins with two
/// zeros.
fn is_profile(names: &[String], rows: &[Vec<f64>]) -> bool {
    let named = matches!(names, [.., t, rate, of] if t == "t" && rate == "max_slip_rate" && of != "moment_rate");
    named
        && rows
            .first()
            .is_some_and(|row| row.len() > 2 && row[..2] == [0.0; 2])
}

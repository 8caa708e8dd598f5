//! Lines of a text file of numbers.

use std::io::{self, BufRead};
use std::path::Path;

use crate::FileError;

/// The content of the lines of a file.
#[derive(Debug, Default)]
pub(super) struct Lines {
    /// The comments, without `#`.
    pub(super) comments: Vec<String>,
    pub(super) names: Vec<String>,
    pub(super) rows: Vec<Vec<f64>>,
}

impl Lines {
    /// Comments begin with `#`, blank lines are skipped, lines of names precede the first row, and begin with no number.
    /// Numbers are separated by spaces, tabs or commas, and may have Fortran's exponents. A last line without its line
    /// end is dropped if it is no whole row. A file without a row is refused.
    pub(super) fn read(mut reader: impl BufRead, path: &Path) -> Result<Self, FileError> {
        let unread = |source: io::Error| FileError::Read {
            path: path.into(),
            source,
        };
        let mut lines = Self::default();
        let mut bytes = Vec::new();
        let mut number = 0;
        loop {
            bytes.clear();
            if reader.read_until(b'\n', &mut bytes).map_err(unread)? == 0 {
                if !lines.rows.is_empty() {
                    return Ok(lines);
                }
                let (path, line) = (path.into(), number);
                let what = "the file ends without a row of numbers".into();
                return Err(FileError::Line { path, line, what });
            }
            number += 1;
            // Names of people in comments come in any encoding.
            let line = String::from_utf8_lossy(&bytes);
            lines.take(&line).or_else(|what| {
                // The row that an interrupted run has left.
                if !line.ends_with('\n') && !lines.rows.is_empty() {
                    return Ok(());
                }
                let (path, line) = (path.into(), number);
                Err(FileError::Line { path, line, what })
            })?;
        }
    }

    fn take(&mut self, line: &str) -> Result<(), String> {
        // Editors of some systems begin a file with a mark of its encoding.
        let text = line.trim_start_matches('\u{feff}').trim();
        if let Some(comment) = text.strip_prefix('#') {
            self.comments.push(comment.trim().into());
            return Ok(());
        }
        let fields = || {
            let separates = |c: char| c.is_whitespace() || c == ',';
            text.split(separates).filter(|field| !field.is_empty())
        };
        let numbers: Result<Vec<f64>, &str> =
            fields().map(|field| number(field).ok_or(field)).collect();
        match numbers {
            Ok(row) if row.is_empty() => Ok(()),
            Ok(row) => {
                if let Some(first) = self.rows.first()
                    && first.len() != row.len()
                {
                    let (found, expected) = (row.len(), first.len());
                    return Err(format!(
                        "{found} numbers where the first row has {expected}"
                    ));
                }
                self.rows.push(row);
                Ok(())
            }
            Err(_) if self.rows.is_empty() && fields().next().and_then(number).is_none() => {
                self.names.extend(fields().map(String::from));
                Ok(())
            }
            Err(field) => Err(format!("`{field}` is not a number")),
        }
    }
}

fn number(field: &str) -> Option<f64> {
    field.parse().ok().or_else(|| {
        // 1.0D+02, and 1.0-103 without a letter.
        let exponent = field.replace(['D', 'd'], "e");
        let sign = exponent.rfind(['+', '-']).filter(|&at| at > 0)?;
        let (mantissa, power) = exponent.split_at(sign);
        let letter = if mantissa.ends_with('e') { "" } else { "e" };
        format!("{mantissa}{letter}{power}").parse().ok()
    })
}

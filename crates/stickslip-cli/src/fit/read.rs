//! Tables of samples.

use std::fs;
use std::path::Path;

use crate::cli::Problem;

/// The columns of a table, read by name or number.
pub(super) struct Table {
    file: String,
    names: Option<Vec<String>>,
    rows: Vec<Vec<f64>>,
}

impl Table {
    /// Reads a table of numbers, whose first row may be names.
    pub(super) fn read(path: &Path) -> Result<Self, Problem> {
        let file = path.display().to_string();
        let text =
            fs::read_to_string(path).map_err(|error| format!("cannot read {file}: {error}"))?;
        let first = text
            .lines()
            .find(|line| !line.starts_with('#'))
            .unwrap_or("");
        let delimiter = [b';', b'\t']
            .into_iter()
            .find(|byte| first.as_bytes().contains(byte));
        let mut reader = csv::ReaderBuilder::new()
            .has_headers(false)
            .comment(Some(b'#'))
            .delimiter(delimiter.unwrap_or(b','))
            .trim(csv::Trim::All)
            .from_reader(text.as_bytes());
        let (mut names, mut rows) = (None, Vec::new());
        for (index, record) in reader.records().enumerate() {
            let record = record.map_err(|error| format!("{file}: {error}"))?;
            let numbers: Result<Vec<f64>, _> = record.iter().map(str::parse).collect();
            match numbers {
                Ok(numbers) => rows.push(numbers),
                Err(_) if index == 0 => names = Some(record.iter().map(String::from).collect()),
                Err(_) => {
                    let line = record.position().map_or(0, csv::Position::line);
                    return Err(format!("{file}, line {line}: not all cells are numbers").into());
                }
            }
        }
        if rows.is_empty() {
            return Err(format!("{file} has no rows of numbers").into());
        }
        Ok(Self { file, names, rows })
    }

    /// Whether there is a column of this name.
    pub(super) fn has(&self, name: &str) -> bool {
        let names = self.names.as_ref();
        names.is_some_and(|names| names.iter().any(|other| other == name))
    }

    /// A column by its name or its number, from 1 on.
    pub(super) fn column(&self, column: &str) -> Result<Vec<f64>, Problem> {
        let width = self.rows[0].len();
        let named = self.names.as_ref();
        let place = named.and_then(|names| names.iter().position(|name| name == column));
        let number = || column.parse::<usize>().ok()?.checked_sub(1);
        let place = place.or_else(number).filter(|place| *place < width);
        let place = place.ok_or_else(|| match named {
            Some(names) => format!(
                "{} has no column `{column}`, but {}",
                self.file,
                names.join(", ")
            ),
            None => format!(
                "{} has no column `{column}`, but {width} without names",
                self.file
            ),
        })?;
        Ok(self.rows.iter().map(|row| row[place]).collect())
    }
}

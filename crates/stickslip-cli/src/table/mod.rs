//! Tables of numbers as machines and programs write them.
//!
//! Separators, decimal commas, encodings, comments, preambles, names and units are found, not asked for: a layout is the
//! one in which most cells are numbers. Whatever stands above the first row of numbers is a preamble, which may hold names.
//! A cell matters only if its column is used.

mod cell;
mod decode;
mod error;
mod layout;
mod names;

use std::fs;
use std::path::Path;

use clap::Args;

pub use error::TableError;
pub use layout::Delimiter;

use cell::Cell;
use layout::{JUDGED, Layout};
use names::Names;

/// How tables are read, where it is not to be found out.
#[derive(Debug, Clone, Default, PartialEq, Eq, Args)]
pub struct Format {
    /// Skip so many lines at the begin of each table [default: those above the first row of numbers, but for names]
    #[arg(
        long,
        value_name = "LINES",
        default_value_t = 0,
        hide_default_value = true
    )]
    pub skip: usize,
    /// What separates cells: comma, semicolon, tab, blanks, or a sign [default: that by which most cells are numbers]
    #[arg(long, value_name = "SIGN", value_parser = Delimiter::parse)]
    pub delimiter: Option<Delimiter>,
}

/// A table of numbers, with columns by name or number.
#[derive(Debug)]
pub struct Table {
    file: String,
    names: Names,
    width: usize,
    /// Row by row; NaN for cells without a number.
    values: Vec<f64>,
    /// The line of each row, from 1 on.
    lines: Vec<usize>,
    /// Cells that are text: row, column and text, in order.
    texts: Vec<(usize, usize, String)>,
}

/// Columns of a table without rows in which a cell of theirs is empty.
#[derive(Debug, Clone, PartialEq)]
pub struct Columns {
    /// The columns in the order in which they were asked for.
    pub values: Vec<Vec<f64>>,
    /// The number of rows that were dropped.
    pub dropped: usize,
}

impl Table {
    /// Reads a table of numbers.
    ///
    /// # Errors
    /// The file cannot be read, holds no row of numbers, or has rows of other widths below the first row of numbers.
    pub fn read(path: &Path, format: &Format) -> Result<Self, TableError> {
        let file = path.display().to_string();
        match fs::read(path) {
            Ok(bytes) => Self::of_text(file, &decode::text(&bytes), format),
            Err(cause) => Err(TableError::Read { file, cause }),
        }
    }

    fn of_text(file: String, text: &str, format: &Format) -> Result<Self, TableError> {
        let all = text.lines().enumerate().skip(format.skip);
        let all = all.filter(|(_, line)| !line.trim().is_empty());
        let (comments, rows): (Vec<_>, Vec<_>) =
            all.partition(|(_, line)| line.trim_start().starts_with(['#', '%']));
        let lines: Vec<&str> = rows.iter().map(|(_, line)| *line).collect();
        let Some((layout, width)) = Layout::of(&lines, format.delimiter) else {
            let first = rows.first();
            let first = first.map(|(line, text)| (line + 1, 1, shortened(text)));
            return Err(TableError::NoNumbers { file, first });
        };
        let records = layout.records(&lines);
        let is_number = |text: &str| matches!(layout.cell(text), Cell::Number(_));
        // A column is one of numbers if it holds more numbers than texts.
        let mut numeric = vec![0_i64; width];
        let judged = records
            .iter()
            .step_by(records.len().div_ceil(JUDGED).max(1));
        for record in judged.filter(|record| fits(record, width)) {
            for (count, text) in numeric.iter_mut().zip(record) {
                match layout.cell(text) {
                    Cell::Number(_) => *count += 1,
                    Cell::Text => *count -= 1,
                    Cell::Empty => {}
                }
            }
        }
        // Names and units begin with a text, and the only number that is a unit is 1: any other row that begins with a
        // number is one of numbers, be some of its cells text.
        let is_row = |record: &csv::StringRecord| {
            let cells = || record.iter().zip(&numeric);
            let text = |text: &str| layout.cell(text) == Cell::Text;
            let begins = |text: &str| is_number(text) && text != "1";
            fits(record, width)
                && cells().any(|(text, _)| is_number(text))
                && (record.iter().next().is_some_and(begins)
                    || !cells().any(|(cell, &count)| count > 0 && text(cell)))
        };
        let Some(first) = records.iter().position(is_row) else {
            let first = rows
                .first()
                .map(|(line, text)| (line + 1, 1, shortened(text)));
            return Err(TableError::NoNumbers { file, first });
        };
        let mut table = Self {
            file,
            names: Names::default(),
            width,
            values: Vec::with_capacity(width * (records.len() - first)),
            lines: Vec::with_capacity(records.len() - first),
            texts: Vec::new(),
        };
        for ((line, _), record) in rows.iter().zip(&records).skip(first) {
            table.push(line + 1, record, layout)?;
        }
        let begin = rows[first].0;
        let mut above: Vec<_> = rows[..first].iter().chain(&comments).collect();
        above.retain(|(line, _)| *line < begin);
        above.sort_unstable_by_key(|(line, _)| *line);
        let above: Vec<&str> = above.into_iter().map(|(_, line)| *line).collect();
        table.names = Names::of(&above, layout, width, table.begins_with_index());
        Ok(table)
    }

    fn push(
        &mut self,
        line: usize,
        record: &csv::StringRecord,
        layout: Layout,
    ) -> Result<(), TableError> {
        if !fits(record, self.width) {
            return Err(TableError::Width {
                file: self.file.clone(),
                line,
                found: record.len(),
                expected: self.width,
            });
        }
        for (k, text) in record.iter().take(self.width).enumerate() {
            self.values.push(match layout.cell(text) {
                Cell::Number(value) => value,
                Cell::Empty => f64::NAN,
                Cell::Text => {
                    self.texts.push((self.lines.len(), k, shortened(text)));
                    f64::NAN
                }
            });
        }
        self.lines.push(line);
        Ok(())
    }

    /// Whether the first column is an index: texts, or integers that count up by one.
    fn begins_with_index(&self) -> bool {
        let first: Vec<f64> = self
            .values
            .iter()
            .copied()
            .step_by(self.width.max(1))
            .collect();
        let counts = first.windows(2).all(|pair| pair[1] - pair[0] == 1.0);
        let texts = self.texts.iter().filter(|(_, k, _)| *k == 0).count();
        texts == self.lines.len() || counts && first.iter().all(|x| x.fract() == 0.0)
    }

    /// Whether there is a column of this name.
    pub fn has(&self, name: &str) -> bool {
        matches!(self.names.position(&self.file, name), Ok(Some(_)) | Err(_))
    }

    /// The line of each row, from 1 on.
    pub fn lines(&self) -> &[usize] {
        &self.lines
    }

    /// The name of its file.
    pub fn file(&self) -> &str {
        &self.file
    }

    /// Columns by their names or their numbers, from 1 on, without rows that have an empty cell in one of them.
    ///
    /// # Errors
    /// A column is not there or there twice, a cell of one is text, or each row has an empty cell.
    pub fn columns(&self, wanted: &[&str]) -> Result<Columns, TableError> {
        let places = wanted.iter().map(|name| self.place(name));
        let places = places.collect::<Result<Vec<usize>, _>>()?;
        for &(row, k, ref text) in &self.texts {
            if let Some(asked) = places.iter().position(|&place| place == k) {
                return Err(TableError::NotANumber {
                    file: self.file.clone(),
                    line: self.lines[row],
                    cell: k + 1,
                    column: wanted[asked].into(),
                    text: text.clone(),
                });
            }
        }
        let mut values = vec![Vec::with_capacity(self.lines.len()); places.len()];
        for row in self.values.chunks_exact(self.width) {
            if places.iter().all(|&place| !row[place].is_nan()) {
                for (column, &place) in values.iter_mut().zip(&places) {
                    column.push(row[place]);
                }
            }
        }
        let kept = values.first().map_or(0, Vec::len);
        if kept == 0 && !places.is_empty() {
            return Err(TableError::AllEmpty {
                file: self.file.clone(),
                rows: self.lines.len(),
            });
        }
        Ok(Columns {
            values,
            dropped: self.lines.len() - kept,
        })
    }

    fn place(&self, column: &str) -> Result<usize, TableError> {
        let place = self.names.position(&self.file, column)?;
        let number = || column.parse::<usize>().ok()?.checked_sub(1);
        let place = place.or_else(number).filter(|place| *place < self.width);
        place.ok_or_else(|| TableError::NoColumn {
            file: self.file.clone(),
            column: column.into(),
            names: self.names.longest(),
            width: self.width,
        })
    }
}

/// Whether a row has so many cells, and empty ones after them.
fn fits(record: &csv::StringRecord, width: usize) -> bool {
    record.len() >= width && record.iter().skip(width).all(str::is_empty)
}

/// A text of at most 40 characters.
fn shortened(text: &str) -> String {
    const MOST: usize = 40;
    let text = text.trim();
    if text.chars().count() <= MOST {
        return text.to_owned();
    }
    let begin: String = text.chars().take(MOST).collect();
    format!("{begin}..")
}

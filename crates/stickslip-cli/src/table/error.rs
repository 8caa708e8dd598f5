//! Why a table cannot be read.

use std::io;

/// Why a table, or a column of it, cannot be read: in which file, line and cell.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum TableError {
    /// The file cannot be read.
    #[error("cannot read {file}: {cause}")]
    Read {
        /// The file.
        file: String,
        /// The cause.
        cause: io::Error,
    },
    /// No line holds numbers.
    #[error(
        "{file}{}: no rows of numbers; --skip and --delimiter say where and how they stand",
        cell_of(.first.as_ref())
    )]
    NoNumbers {
        /// The file.
        file: String,
        /// The first cell that is not a number: its line and cell, from 1 on, and its text.
        first: Option<(usize, usize, String)>,
    },
    /// A row has more or fewer cells than the others.
    #[error(
        "{file}, line {line}, cell {}: the row has {found} cells, others have {expected}; correct or remove the line",
        .found.min(.expected) + 1
    )]
    Width {
        /// The file.
        file: String,
        /// The line, from 1 on.
        line: usize,
        /// Its cells.
        found: usize,
        /// The cells of the other rows.
        expected: usize,
    },
    /// A cell of a column in use is not a number.
    #[error(
        "{file}, line {line}, cell {cell}{}: `{text}` is not a number; correct it, or leave it empty to drop the row",
        named(.column)
    )]
    NotANumber {
        /// The file.
        file: String,
        /// The line, from 1 on.
        line: usize,
        /// The cell, from 1 on.
        cell: usize,
        /// The name by which the column was asked for.
        column: String,
        /// The text of the cell.
        text: String,
    },
    /// No column has this name or number.
    #[error("{file} has no column `{column}`, but {}", listed(.names, *.width))]
    NoColumn {
        /// The file.
        file: String,
        /// What was asked for.
        column: String,
        /// The names of the columns; none without a row of names.
        names: Vec<String>,
        /// The number of columns.
        width: usize,
    },
    /// Several columns have this name.
    #[error("{file}: columns {} and {} are both called `{column}`; give their number", .places.0, .places.1)]
    Twice {
        /// The file.
        file: String,
        /// What was asked for.
        column: String,
        /// The numbers of two of them, from 1 on.
        places: (usize, usize),
    },
    /// Every row has an empty cell in a column in use.
    #[error(
        "{file}: each of the {rows} rows has an empty cell in a column in use; choose others by --columns"
    )]
    AllEmpty {
        /// The file.
        file: String,
        /// The number of rows.
        rows: usize,
    },
}

fn cell_of(first: Option<&(usize, usize, String)>) -> String {
    first.map_or_else(String::new, |(line, cell, text)| {
        format!(", line {line}, cell {cell}: `{text}` is not a number")
    })
}

fn named(column: &str) -> String {
    if column.parse::<usize>().is_ok() {
        String::new()
    } else {
        format!(" ({column})")
    }
}

fn listed(names: &[String], width: usize) -> String {
    if names.is_empty() {
        format!("{width} without names")
    } else {
        names.join(", ")
    }
}

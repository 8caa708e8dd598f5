//! Samples from tables.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use csv::{ReaderBuilder, StringRecord, Trim};
use nalgebra::SVector;
use thiserror::Error;

use crate::{FemError, Samples};

/// Why a table holds no [`Samples`].
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum SamplesError {
    /// The file cannot be read.
    #[error("cannot read {}: {source}", .path.display())]
    Read {
        /// Where it was to be.
        path: PathBuf,
        /// Why not.
        source: io::Error,
    },
    /// The file is no table of text.
    #[error(transparent)]
    Csv(#[from] csv::Error),
    /// A row has more or fewer columns than coordinates and a value.
    #[error("line {line}: {found} columns, expected {expected}: the coordinates and a value")]
    Columns {
        /// The line, from 1.
        line: u64,
        /// Columns there.
        found: usize,
        /// Columns there must be.
        expected: usize,
    },
    /// An entry is no finite number.
    #[error("line {line}, column {column}: \"{found}\" is no finite number")]
    Number {
        /// The line, from 1.
        line: u64,
        /// The column, from 1.
        column: usize,
        /// What is there.
        found: String,
    },
    /// Two rows are about one point.
    #[error("lines {} and {} are about the same point", .lines[0], .lines[1])]
    Repeated {
        /// The lines, from 1.
        lines: [u64; 2],
    },
    /// There are no samples, or too many.
    #[error(transparent)]
    Samples(#[from] FemError),
}

impl<const D: usize> Samples<D> {
    /// Reads samples from a table of D coordinates \[m\] and a value in each row, separated by commas. A first row
    /// without numbers is a heading; empty lines and lines that begin with `#` are passed over.
    ///
    /// # Errors
    ///
    /// [`SamplesError`], with lines and columns.
    pub fn read(path: impl AsRef<Path>) -> Result<Self, SamplesError> {
        let path = path.as_ref();
        let bytes = fs::read(path).map_err(|source| SamplesError::Read {
            path: path.to_owned(),
            source,
        })?;
        Self::parse(&bytes)
    }

    /// As [`Samples::read`], from the bytes of a file.
    ///
    /// # Errors
    ///
    /// Those of [`Samples::read`].
    ///
    /// ```
    /// use nalgebra::Vector2;
    /// use stickslip_fem::Samples;
    ///
    /// let samples = Samples::<2>::parse(b"x, y, b\n0, 0, 0.010\n5, 0, 0.020\n")?;
    /// assert_eq!(samples.nearest(&Vector2::new(3.0, 0.5)), 0.020);
    /// assert_eq!(samples.linear()?.at(&Vector2::new(2.5, 0.0)), 0.015);
    /// # Ok::<(), stickslip_fem::SamplesError>(())
    /// ```
    pub fn parse(bytes: &[u8]) -> Result<Self, SamplesError> {
        let mut reader = ReaderBuilder::new()
            .has_headers(false)
            .flexible(true)
            .trim(Trim::All)
            .comment(Some(b'#'))
            .from_reader(bytes);
        let (mut points, mut values, mut lines) = (Vec::new(), Vec::new(), Vec::new());
        let mut record = StringRecord::new();
        let mut first = true;
        while reader.read_record(&mut record)? {
            let heading = first && record.iter().all(|entry| entry.parse::<f64>().is_err());
            first = false;
            if heading {
                continue;
            }
            let line = record.position().map_or(0, csv::Position::line);
            if record.len() != D + 1 {
                return Err(SamplesError::Columns {
                    line,
                    found: record.len(),
                    expected: D + 1,
                });
            }
            let mut point = SVector::<f64, D>::zeros();
            for (column, entry) in record.iter().enumerate() {
                let number = entry.parse().ok().filter(|number: &f64| number.is_finite());
                let Some(number) = number else {
                    return Err(SamplesError::Number {
                        line,
                        column: column + 1,
                        found: entry.to_owned(),
                    });
                };
                match point.as_mut_slice().get_mut(column) {
                    Some(coordinate) => *coordinate = number,
                    None => values.push(number),
                }
            }
            points.push(point);
            lines.push(line);
        }
        Self::new(&points, &values).map_err(|error| match error {
            FemError::RepeatedSample { samples } => SamplesError::Repeated {
                lines: samples.map(|sample| lines[sample]),
            },
            other => other.into(),
        })
    }
}

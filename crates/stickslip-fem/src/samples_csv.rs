//! Samples from tables.

use std::fs;
use std::path::Path;

use csv::{ReaderBuilder, StringRecord, Trim};
use nalgebra::SVector;

use crate::{FemError, FilePlace, ReadError, Samples};

impl<const D: usize> Samples<D> {
    /// Reads samples from a table with D coordinates \[m\] and a value in each row, separated by commas. A first row
    /// without numbers is a heading; empty lines and lines that begin with `#` are skipped.
    ///
    /// # Errors
    ///
    /// [`ReadError`], with lines and columns.
    pub fn read(path: impl AsRef<Path>) -> Result<Self, ReadError> {
        let path = path.as_ref();
        let bytes = fs::read(path).map_err(|source| ReadError::Read {
            path: path.to_owned(),
            source,
        })?;
        Self::parse(&bytes)
    }

    /// As [`Samples::read`], from the bytes of a file.
    ///
    /// # Errors
    ///
    /// The errors of [`Samples::read`].
    ///
    /// ```
    /// use nalgebra::Vector2;
    /// use stickslip_fem::Samples;
    ///
    /// let samples = Samples::<2>::parse(b"x, y, b\n0, 0, 0.010\n5, 0, 0.020\n")?;
    /// assert_eq!(samples.nearest(&Vector2::new(3.0, 0.5)), 0.020);
    /// assert_eq!(samples.linear()?.at(&Vector2::new(2.5, 0.0)), 0.015);
    /// # Ok::<(), stickslip_fem::ReadError>(())
    /// ```
    pub fn parse(bytes: &[u8]) -> Result<Self, ReadError> {
        let mut reader = ReaderBuilder::new()
            .has_headers(false)
            .flexible(true)
            .trim(Trim::All)
            .comment(Some(b'#'))
            .from_reader(bytes);
        let (mut points, mut values, mut lines) = (Vec::new(), Vec::new(), Vec::new());
        let mut record = StringRecord::new();
        let mut first = true;
        while (reader.read_record(&mut record)).map_err(|error| not_text(&error))? {
            let heading = first && record.iter().all(|entry| entry.parse::<f64>().is_err());
            first = false;
            if heading {
                continue;
            }
            let line = line_of(record.position());
            if record.len() != D + 1 {
                return Err(ReadError::Unexpected {
                    expected: format!("{} columns, the coordinates and a value", D + 1).into(),
                    found: Some(format!("{} columns", record.len())),
                    at: FilePlace::Line(line),
                });
            }
            let mut point = SVector::<f64, D>::zeros();
            for (column, entry) in record.iter().enumerate() {
                let number = entry.parse().ok().filter(|number: &f64| number.is_finite());
                let Some(number) = number else {
                    return Err(ReadError::Unexpected {
                        expected: "a finite number".into(),
                        found: Some(entry.to_owned()),
                        at: FilePlace::Entry {
                            line,
                            column: column + 1,
                        },
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
            FemError::Repeated { places, .. } => ReadError::Same {
                what: "lines",
                numbers: places.map(|sample| lines[sample] as u64),
                share: "point",
                at: FilePlace::Line(lines[places[1]]),
            },
            other => other.into(),
        })
    }
}

fn line_of(position: Option<&csv::Position>) -> usize {
    position.map_or(0, |position| position.line() as usize)
}

/// The bytes in memory can always be read, but need not be text.
fn not_text(error: &csv::Error) -> ReadError {
    ReadError::Unexpected {
        expected: "text in UTF-8".into(),
        found: Some(error.to_string()),
        at: FilePlace::Line(line_of(error.position())),
    }
}

//! Rates from tables of text.

use std::io::Read;

use super::{DiffusionError, RateHistory};

impl RateHistory {
    /// Reads lines `time,rate` of CSV, of \[s\] and the unit of the rates; each rate holds up to the next time. A first
    /// line that holds no numbers names the columns; lines that start with `#` are comments.
    ///
    /// ```
    /// use stickslip_fields::RateHistory;
    ///
    /// let text = "# injection\ntime,rate\n0,3e-3\n360000,0\n";
    /// let rates = RateHistory::constant_from_csv(text.as_bytes())?;
    /// assert_eq!(rates, RateHistory::constant_between(&[(0.0, 3e-3), (3.6e5, 0.0)])?);
    /// # Ok::<(), stickslip_fields::DiffusionError>(())
    /// ```
    ///
    /// # Errors
    /// [`DiffusionError::Text`] for text that holds something else, and the errors of
    /// [`constant_between`](Self::constant_between).
    pub fn constant_from_csv(text: impl Read) -> Result<Self, DiffusionError> {
        Self::constant_between(&rows(text)?)
    }

    /// Reads lines `time,rate` as [`constant_from_csv`](Self::constant_from_csv) does; the rate is linear between them.
    ///
    /// # Errors
    /// [`DiffusionError::Text`] for text that holds something else, and the errors of
    /// [`linear_between`](Self::linear_between).
    pub fn linear_from_csv(text: impl Read) -> Result<Self, DiffusionError> {
        Self::linear_between(&rows(text)?)
    }
}

fn rows(text: impl Read) -> Result<Vec<(f64, f64)>, DiffusionError> {
    let mut reader = csv::ReaderBuilder::new()
        .has_headers(false)
        .comment(Some(b'#'))
        .trim(csv::Trim::All)
        .flexible(true)
        .from_reader(text);
    let (mut rows, mut first) = (Vec::new(), true);
    for record in reader.records() {
        let refuse = |line, problem| DiffusionError::Text { line, problem };
        let record = record.map_err(|error| {
            let line = error.position().map_or(0, csv::Position::line);
            refuse(line, error.to_string())
        })?;
        let line = record.position().map_or(0, csv::Position::line);
        let numbers: Vec<Option<f64>> = record.iter().map(|field| field.parse().ok()).collect();
        match numbers[..] {
            [Some(time), Some(rate)] => rows.push((time, rate)),
            // The names of the columns.
            [None, None] if first => {}
            [_, _] => return Err(refuse(line, "not two numbers".to_owned())),
            _ => return Err(refuse(line, format!("{} columns", numbers.len()))),
        }
        first = false;
    }
    Ok(rows)
}

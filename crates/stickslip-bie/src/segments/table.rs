//! Segments from tables of text.

use std::io::Read;

use super::{Segments, SegmentsError};

impl Segments {
    /// Reads lines `x,z` or `x,z,fault` of CSV \[m\], `z` the height above the surface: points one after the other, and a new
    /// polyline where the number of the fault changes. A first line that holds no numbers names the columns; lines that
    /// start with `#` are comments.
    ///
    /// ```
    /// use stickslip_bie::Segments;
    ///
    /// let text = "# a thrust and its splay\nx,z,fault\n0,0,1\n1e3,-1e3,1\n2e3,-2e3,1\n1e3,-1e3,2\n2.2e3,-1e3,2\n";
    /// let segments = Segments::from_csv(text.as_bytes())?.divided(200.0)?;
    /// assert_eq!((segments.fault_count(), segments.count()), (2, 22));
    /// # Ok::<(), stickslip_bie::SegmentsError>(())
    /// ```
    ///
    /// # Errors
    /// [`SegmentsError::Table`] with the line for text that holds something else, and the errors of
    /// [`polylines`](Self::polylines).
    pub fn from_csv(text: impl Read) -> Result<Self, SegmentsError> {
        let mut reader = csv::ReaderBuilder::new()
            .has_headers(false)
            .comment(Some(b'#'))
            .trim(csv::Trim::All)
            .flexible(true)
            .from_reader(text);
        let mut faults: Vec<(Option<u64>, Vec<[f64; 2]>)> = Vec::new();
        let mut first = true;
        for record in reader.records() {
            let refuse = |line, problem| SegmentsError::Table { line, problem };
            let record = record.map_err(|error| {
                let line = error.position().map_or(0, csv::Position::line);
                refuse(line, error.to_string())
            })?;
            let line = record.position().map_or(0, csv::Position::line);
            let named = first && record.iter().all(|field| field.parse::<f64>().is_err());
            first = false;
            if named {
                continue;
            }
            let (point, fault) = row(&record).map_err(|problem| refuse(line, problem))?;
            let known = faults.iter().any(|(number, _)| *number == fault);
            match faults.last_mut() {
                Some((number, points)) if *number == fault => points.push(point),
                Some((number, _)) if number.is_some() != fault.is_some() => {
                    let problem = "the number of the fault is missing here or on a line before";
                    return Err(refuse(line, problem.to_owned()));
                }
                _ if known => {
                    let problem =
                        "the fault of this line has ended before: its points are in a row";
                    return Err(refuse(line, problem.to_owned()));
                }
                _ => faults.push((fault, vec![point])),
            }
        }
        Self::polylines(faults.into_iter().map(|(_, points)| points))
    }
}

/// The point of a line, and the number of its fault.
fn row(record: &csv::StringRecord) -> Result<([f64; 2], Option<u64>), String> {
    if !(2..=3).contains(&record.len()) {
        return Err(format!(
            "{} columns instead of x, z and fault",
            record.len()
        ));
    }
    let coordinate = |place: usize| {
        let field = &record[place];
        let value: f64 = field
            .parse()
            .map_err(|_| format!("'{field}' is no number"))?;
        if value.is_finite() {
            Ok(value)
        } else {
            Err(format!("'{field}' is not finite"))
        }
    };
    let point = [coordinate(0)?, coordinate(1)?];
    let number = |field: &str| {
        let parsed = field.parse::<u64>();
        parsed.map_err(|_| format!("'{field}' is no number of a fault: 0, 1, .."))
    };
    Ok((point, record.get(2).map(number).transpose()?))
}

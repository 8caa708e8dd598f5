//! Wells from a table.

use stickslip::fields::RateHistory;

use super::{Arguments, Failed, Rates};
use crate::table::{Format, Table};

/// The rate of the well at the centre by default, on a plane [m^3/s] and on a line [m^2/s].
const RATE: [f64; 2] = [1e-3, 8e-6];

/// Times \[s\] and rates.
type Rows = Vec<(f64, f64)>;

/// A well along strike and down dip \[m\].
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Place {
    pub(super) at: [f64; 2],
    pub(super) rates: RateHistory,
}

/// The wells of a command line.
pub(super) fn read(arguments: &Arguments) -> Result<Vec<Place>, Failed> {
    let (injection, line) = (&arguments.injection, arguments.geometry.line);
    let Some(path) = &injection.wells else {
        let rate = injection.rate.unwrap_or(RATE[usize::from(line)]);
        let rows = [(0.0, rate), (injection.shut_in, 0.0)];
        return Ok(vec![Place {
            at: [0.0; 2],
            rates: RateHistory::constant_between(&rows)?,
        }]);
    };
    let table = Table::read(path, &Format::default())?;
    let rows = rows(&table, line)?;
    let mut wells: Vec<([f64; 2], Rows)> = Vec::new();
    for (row, [x, y, time, rate]) in rows.into_iter().enumerate() {
        let known = wells.iter().position(|(at, _)| *at == [x, y]);
        let known = known.unwrap_or_else(|| {
            wells.push(([x, y], Vec::new()));
            wells.len() - 1
        });
        let rates = &mut wells[known].1;
        if let Some(&(before, _)) = rates.last().filter(|(before, _)| time < *before) {
            return Err(format!(
                "{}, line {}: time {time} s is before {before} s, the time of the row above for that well; sort its rows",
                table.file(),
                table.lines()[row]
            )
            .into());
        }
        rates.push((time, rate));
    }
    let history = |rows: &[(f64, f64)]| match injection.rates {
        Rates::Linear => RateHistory::linear_between(rows),
        Rates::Constant => RateHistory::constant_between(rows),
    };
    let wells = wells.into_iter().map(|(at, rows)| {
        let rates = history(&rows)?;
        Ok(Place { at, rates })
    });
    wells.collect()
}

/// The rows: x, y, time, rate.
fn rows(table: &Table, line: bool) -> Result<Vec<[f64; 4]>, Failed> {
    if line && table.has("y") {
        return Err(format!(
            "{} has a column `y`, but a line has no place beside it; remove the column, or leave out --line",
            table.file()
        )
        .into());
    }
    let names = ["x", "y", "time", "rate"];
    let known: Vec<&str> = names
        .into_iter()
        .filter(|name| ["time", "rate"].contains(name) || table.has(name))
        .collect();
    let columns = table.columns(&known)?;
    if columns.dropped > 0 {
        return Err(format!(
            "{}: {} of its {} rows have an empty cell in one of the columns {}; fill them, or remove these rows",
            table.file(),
            columns.dropped,
            table.lines().len(),
            known.join(", ")
        )
        .into());
    }
    let column = |name: &str| {
        let place = known.iter().position(|known| *known == name)?;
        columns.values.get(place)
    };
    let all = names.map(column);
    Ok((0..table.lines().len())
        .map(|row| all.map(|column| column.map_or(0.0, |values| values[row])))
        .collect())
}

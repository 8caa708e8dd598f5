//! Parameters of diffusion out of their ranges.

use thiserror::Error;

/// Where diffusion along a fault cannot be set up.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum DiffusionError {
    /// A value out of its range.
    #[error(
        "{what}{} must be {requirement}, is {value:e}",
        cell.map_or_else(String::new, |cell| format!(" of cell {cell}"))
    )]
    Value {
        /// The quantity, with its unit.
        what: &'static str,
        /// The cell, for a quantity per cell, in the order of the vertices.
        cell: Option<usize>,
        /// Its range.
        requirement: &'static str,
        /// Its value.
        value: f64,
    },
    /// A list of another length.
    #[error("{what}: {found} values for {expected}; give one, or one per cell")]
    Count {
        /// The quantity.
        what: &'static str,
        /// The number of values that fit.
        expected: usize,
        /// The number of values given.
        found: usize,
    },
    /// A point outside of the cells.
    #[error(
        "{what} at {position:?} lies outside of the cells, which reach from {begin:?} to {end:?}"
    )]
    Outside {
        /// The well or source.
        what: &'static str,
        /// Its position \[m\].
        position: Vec<f64>,
        /// The least position of a cell \[m\].
        begin: Vec<f64>,
        /// The greatest position of a cell \[m\].
        end: Vec<f64>,
    },
    /// A place of another kind than the cells.
    #[error("{what} at {place}, but the cells form a {cells}: give {instead}")]
    Place {
        /// The well, source or side.
        what: &'static str,
        /// The place given.
        place: &'static str,
        /// The kind of cells.
        cells: &'static str,
        /// A place that fits.
        instead: &'static str,
    },
    /// A well in a cell without permeability.
    #[error(
        "{what} in cell {cell}, which is sealed (permeability 0): move it, or give the cell a permeability"
    )]
    Sealed {
        /// The well or source.
        what: &'static str,
        /// The cell, in the order of the vertices.
        cell: usize,
    },
    /// A wellbore as wide as its cell.
    #[error(
        "radius {radius:e} m of the wellbore must be below the equivalent radius of its cell, {equivalent:e} m: use larger cells, or a well without a bore"
    )]
    Radius {
        /// The radius \[m\].
        radius: f64,
        /// The radius at which the pressure in the homogeneous plane is that of the cell \[m\].
        equivalent: f64,
    },
    /// A row of a table of rates out of order or not finite.
    #[error(
        "row {row} of the rates: time {time:e} s and rate {rate:e}; times do not decrease (before {before:e} s) and both are finite"
    )]
    Rates {
        /// The row, from 0.
        row: usize,
        /// Its time \[s\].
        time: f64,
        /// Its rate.
        rate: f64,
        /// The time of the row before \[s\].
        before: f64,
    },
    /// Text that is no table of rates.
    #[error("line {line} of the rates: {problem}; write `time,rate` per line")]
    Text {
        /// The line, from 1.
        line: u64,
        /// The problem.
        problem: String,
    },
}

/// Requires a value above 0 and finite.
pub(super) fn positive(
    what: &'static str,
    cell: Option<usize>,
    value: f64,
) -> Result<(), DiffusionError> {
    if value > 0.0 && value.is_finite() {
        return Ok(());
    }
    Err(DiffusionError::Value {
        what,
        cell,
        requirement: "above 0 and finite",
        value,
    })
}

/// Requires a value of at least 0 and finite.
pub(super) fn not_negative(
    what: &'static str,
    cell: Option<usize>,
    value: f64,
) -> Result<(), DiffusionError> {
    if value >= 0.0 && value.is_finite() {
        return Ok(());
    }
    Err(DiffusionError::Value {
        what,
        cell,
        requirement: "at least 0 and finite",
        value,
    })
}

/// Requires a finite value.
pub(super) fn finite(
    what: &'static str,
    cell: Option<usize>,
    value: f64,
) -> Result<(), DiffusionError> {
    if value.is_finite() {
        return Ok(());
    }
    Err(DiffusionError::Value {
        what,
        cell,
        requirement: "finite",
        value,
    })
}

//! What is wrong with a fault.

use thiserror::Error;

/// The errors of this crate.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum KernelError {
    /// There is no cell.
    #[error("a fault needs at least one cell")]
    NoCells,
    /// An end of the cells that is not finite, or not beyond the other one.
    #[error("the cells lie between {begin:e} m and {end:e} m, which must be finite and increase")]
    Extent {
        /// Where the first cell begins \[m\].
        begin: f64,
        /// Where the last cell ends \[m\].
        end: f64,
    },
    /// A cell of another length than the mean.
    #[error("cell {cell} is {length:e} m long, the mean is {mean:e} m: a kernel needs even cells")]
    Uneven {
        /// The cell, from 0.
        cell: usize,
        /// Its length \[m\].
        length: f64,
        /// The mean of all \[m\].
        mean: f64,
    },
    /// A parameter out of its range.
    #[error("{parameter} must be {range}, is {value:e}")]
    Parameter {
        /// Its name.
        parameter: &'static str,
        /// The range.
        range: &'static str,
        /// Its value.
        value: f64,
    },
    /// A fault in a half space that begins above the surface.
    #[error("the fault begins at a depth of {begin:e} m, above the free surface")]
    AboveSurface {
        /// The depth of its upper end \[m\].
        begin: f64,
    },
    /// A section without a cell.
    #[error("no cell has its centre between {from:e} m and {to:e} m")]
    EmptySection {
        /// Where the section begins \[m\].
        from: f64,
        /// Where it ends \[m\].
        to: f64,
    },
}

/// Refuses what is not positive and finite.
pub(crate) fn positive(parameter: &'static str, value: f64) -> Result<(), KernelError> {
    if value > 0.0 && value.is_finite() {
        return Ok(());
    }
    Err(KernelError::Parameter {
        parameter,
        range: "positive and finite",
        value,
    })
}

//! Errors for friction of many cells.

use std::fmt;

use thiserror::Error;

use crate::FrictionError;

/// A parameter of [`QuasiDynamicFriction`](crate::QuasiDynamicFriction) that is out of its range.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[non_exhaustive]
pub struct ManyCellsError {
    /// The cell of the parameter, from 0; `None` for one that all cells share.
    pub cell: Option<usize>,
    /// The parameter.
    pub source: FrictionError,
}

impl fmt::Display for ManyCellsError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(cell) = self.cell {
            write!(f, "cell {cell}: ")?;
        }
        self.source.fmt(f)
    }
}

impl From<FrictionError> for ManyCellsError {
    /// The error of a parameter that all cells share.
    fn from(source: FrictionError) -> Self {
        Self { cell: None, source }
    }
}

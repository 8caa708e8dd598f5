//! Positions on a fault.

use pyo3::prelude::*;
use stickslip::fields::Place;

use super::Cells;
use crate::arguments::{finite, wrong_type};
use crate::bodies::PerVertex;
use crate::errors::argument;

/// A position on a line, or along strike and down dip on a plane \[m\].
#[derive(Clone, Copy, IntoPyObject)]
pub(crate) enum Position {
    Along(f64),
    On([f64; 2]),
}

impl<'a, 'py> FromPyObject<'a, 'py> for Position {
    type Error = PyErr;

    fn extract(given: Borrowed<'a, 'py, PyAny>) -> PyResult<Self> {
        match given.extract() {
            Ok(PerVertex::Uniform(position)) => Ok(Self::Along(position)),
            Ok(PerVertex::Each(pair)) if pair.len() == 2 => Ok(Self::On([pair[0], pair[1]])),
            _ => Err(wrong_type(
                "a number on a line [m], or a pair along strike and down dip on a plane",
                &given,
            )),
        }
    }
}

impl Position {
    /// Passes a finite position.
    pub(super) fn checked(self) -> PyResult<Self> {
        match self {
            Self::Along(position) => finite("position", position).map(|_| self),
            Self::On(pair) if pair.iter().all(|x| x.is_finite()) => Ok(self),
            Self::On(pair) => Err(argument("position", "finite", pair)),
        }
    }

    /// The place on the cells of a fault.
    pub(super) fn on(self, name: &str, cells: &Cells) -> PyResult<Place> {
        match (self, cells.is_line()) {
            (Self::Along(position), true) => Ok(position.into()),
            (Self::On(position), false) => Ok(position.into()),
            (Self::On(pair), true) => Err(argument(name, "a number on a line", pair)),
            (Self::Along(position), false) => {
                let requirement = "a pair along strike and down dip on a plane";
                Err(argument(name, requirement, position))
            }
        }
    }
}

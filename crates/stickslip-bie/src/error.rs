//! Errors for values of a fault.

use stickslip_state::Number;
use thiserror::Error;

/// A value of a fault is out of its range.
#[derive(Debug, Clone, PartialEq, Error)]
#[error(
    "{what}{}{}{} must be {requirement}{}, is {}",
    cell.map_or_else(String::new, |cell| format!(" {cell}")),
    plane.map_or_else(String::new, |plane| format!(" of plane {plane}")),
    other_plane.map_or_else(String::new, |plane| format!(" and plane {plane}")),
    bound.map_or_else(String::new, |bound| format!(" {}", Number(bound))),
    Number(*.value)
)]
#[non_exhaustive]
pub struct KernelError {
    /// The value's name.
    pub what: &'static str,
    /// The cell of the value, from 0.
    pub cell: Option<usize>,
    /// The plane of the value in a [`FaultSystem`](crate::FaultSystem), from 0.
    pub plane: Option<usize>,
    /// The second plane of the value.
    pub other_plane: Option<usize>,
    /// The requirement of a legal value, before the bound if there is one: "at least".
    pub requirement: &'static str,
    /// The bound.
    pub bound: Option<f64>,
    /// The value.
    pub value: f64,
}

impl KernelError {
    pub(crate) fn new(what: &'static str, requirement: &'static str, value: f64) -> Self {
        Self {
            what,
            cell: None,
            plane: None,
            other_plane: None,
            requirement,
            bound: None,
            value,
        }
    }

    /// Adds a bound.
    pub(crate) fn bound(self, bound: f64) -> Self {
        Self {
            bound: Some(bound),
            ..self
        }
    }

    /// Adds a cell.
    pub(crate) fn of_cell(self, cell: usize) -> Self {
        Self {
            cell: Some(cell),
            ..self
        }
    }

    /// Adds a plane.
    pub(crate) fn of_plane(self, plane: usize) -> Self {
        Self {
            plane: Some(plane),
            ..self
        }
    }

    /// Adds two planes.
    pub(crate) fn of_planes(self, [plane, other]: [usize; 2]) -> Self {
        Self {
            other_plane: Some(other),
            ..self.of_plane(plane)
        }
    }
}

/// Refuses a value that is not positive and finite.
pub(crate) fn positive(what: &'static str, value: f64) -> Result<(), KernelError> {
    if value > 0.0 && value.is_finite() {
        return Ok(());
    }
    Err(KernelError::new(what, "positive and finite", value))
}

/// Refuses a factor of the radiation damping that is negative or not finite.
pub(crate) fn check_factor(factor: f64) -> Result<(), KernelError> {
    if factor >= 0.0 && factor.is_finite() {
        return Ok(());
    }
    let what = "factor of radiation damping";
    Err(KernelError::new(what, "finite, and at least", factor).bound(0.0))
}

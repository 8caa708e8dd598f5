//! Values of a fault that are out of range.

use thiserror::Error;

/// A value of a fault that is out of its range.
#[derive(Debug, Clone, PartialEq, Error)]
#[error(
    "{what}{} must be {requirement}{}, is {value:e}",
    cell.map_or_else(String::new, |cell| format!(" {cell}")),
    bound.map_or_else(String::new, |bound| format!(" {bound:e}"))
)]
#[non_exhaustive]
pub struct KernelError {
    /// The value's name.
    pub what: &'static str,
    /// The cell that it belongs to, from 0.
    pub cell: Option<usize>,
    /// What holds for a legal value, before the bound if there is one: "at least".
    pub requirement: &'static str,
    /// The number that the value is compared with.
    pub bound: Option<f64>,
    /// The value.
    pub value: f64,
}

impl KernelError {
    pub(crate) fn new(what: &'static str, requirement: &'static str, value: f64) -> Self {
        Self {
            what,
            cell: None,
            requirement,
            bound: None,
            value,
        }
    }

    /// Compared with a number.
    pub(crate) fn bound(self, bound: f64) -> Self {
        Self {
            bound: Some(bound),
            ..self
        }
    }
}

/// Refuses what is not positive and finite.
pub(crate) fn positive(what: &'static str, value: f64) -> Result<(), KernelError> {
    if value > 0.0 && value.is_finite() {
        return Ok(());
    }
    Err(KernelError::new(what, "positive and finite", value))
}

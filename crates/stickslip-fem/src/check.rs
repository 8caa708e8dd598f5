//! Checks of parameters, and errors that several checks share.

use crate::FemError;

impl FemError {
    /// Passes a legal value of a parameter.
    pub(crate) fn check(
        what: &'static str,
        requirement: &'static str,
        value: f64,
        legal: bool,
    ) -> Result<f64, Self> {
        if legal {
            return Ok(value);
        }
        Err(Self::Value {
            what,
            requirement,
            value,
            cell: None,
        })
    }

    /// Passes a value that is positive and finite.
    pub(crate) fn positive(what: &'static str, value: f64) -> Result<f64, Self> {
        let legal = value.is_finite() && value > 0.0;
        Self::check(what, "positive and finite", value, legal)
    }

    /// Passes a value that is finite and not negative.
    pub(crate) fn non_negative(what: &'static str, value: f64) -> Result<f64, Self> {
        let legal = value.is_finite() && value >= 0.0;
        Self::check(what, "finite and non-negative", value, legal)
    }

    /// Adds the cell of a value to the error.
    pub(crate) fn in_cell(mut self, index: usize) -> Self {
        if let Self::Value { cell, .. } = &mut self {
            *cell = Some(index);
        }
        self
    }

    pub(crate) fn empty(what: &'static str) -> Self {
        Self::Empty {
            what,
            name: String::new(),
        }
    }

    pub(crate) fn repeated(what: &'static str, places: [usize; 2]) -> Self {
        Self::Repeated {
            what,
            places,
            name: String::new(),
        }
    }

    pub(crate) fn too_many(what: &'static str, count: u64) -> Self {
        Self::TooMany { what, count }
    }
}

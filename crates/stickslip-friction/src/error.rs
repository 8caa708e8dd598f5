//! Errors for parameters of a friction law.

use stickslip_state::Number;

/// A parameter of a friction law that is out of its range.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error("{what} must be {requirement}, is {}", Number(*.value))]
#[non_exhaustive]
pub struct FrictionError {
    /// The field of the law.
    pub what: &'static str,
    /// The requirement of a legal value.
    pub requirement: &'static str,
    /// Its value.
    pub value: f64,
}

impl FrictionError {
    /// Passes a value that is legal.
    ///
    /// # Errors
    ///
    /// [`FrictionError`] otherwise, with these three.
    pub fn check(
        what: &'static str,
        requirement: &'static str,
        value: f64,
        legal: bool,
    ) -> Result<(), Self> {
        if legal {
            return Ok(());
        }
        Err(Self {
            what,
            requirement,
            value,
        })
    }

    /// Passes a parameter that is finite and positive.
    ///
    /// # Errors
    ///
    /// [`FrictionError`] otherwise.
    pub fn check_positive(what: &'static str, value: f64) -> Result<(), Self> {
        let legal = value.is_finite() && value > 0.0;
        Self::check(what, "finite and positive", value, legal)
    }

    /// Passes a parameter that is finite and non-negative.
    ///
    /// # Errors
    ///
    /// [`FrictionError`] otherwise.
    pub fn check_non_negative(what: &'static str, value: f64) -> Result<(), Self> {
        let legal = value.is_finite() && value >= 0.0;
        Self::check(what, "finite and non-negative", value, legal)
    }
}

//! Errors for parameters of a scheme.

use thiserror::Error;

/// A parameter of a scheme is out of its range.
#[derive(Debug, Clone, PartialEq, Error)]
#[error("{scheme}: {parameter} must lie in {range}, is {value:?}")]
#[non_exhaustive]
pub struct TimeError {
    /// The scheme.
    pub scheme: &'static str,
    /// The name of the parameter.
    pub parameter: &'static str,
    /// The range.
    pub range: &'static str,
    /// Its value.
    pub value: f64,
}

impl TimeError {
    /// Passes a legal value, for schemes of other crates.
    ///
    /// # Errors
    ///
    /// [`TimeError`] otherwise, with these four.
    pub fn check(
        scheme: &'static str,
        parameter: &'static str,
        range: &'static str,
        value: f64,
        legal: bool,
    ) -> Result<(), Self> {
        if legal {
            return Ok(());
        }
        Err(Self {
            scheme,
            parameter,
            range,
            value,
        })
    }

    /// Refuses a spectral radius out of its range.
    pub(crate) fn radius(scheme: &'static str, value: f64) -> Result<(), Self> {
        let legal = (0.0..=1.0).contains(&value);
        Self::check(scheme, "spectral_radius", "[0, 1]", value, legal)
    }
}

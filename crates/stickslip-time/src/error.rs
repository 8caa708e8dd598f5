//! What can be wrong with a scheme.

use thiserror::Error;

/// The errors of this crate.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum TimeError {
    /// A parameter out of its range.
    #[error("{scheme}: {parameter} must lie in {range}, is {value:e}")]
    InvalidParameter {
        /// The scheme.
        scheme: &'static str,
        /// The name of the parameter.
        parameter: &'static str,
        /// The range.
        range: &'static str,
        /// Its value.
        value: f64,
    },
}

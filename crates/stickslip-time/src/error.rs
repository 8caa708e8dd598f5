//! What can be wrong with a scheme.

use thiserror::Error;

/// The errors of this crate.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum TimeError {
    /// A parameter out of its range.
    #[error("{scheme}: {parameter} must lie in (0, 1], is {value}")]
    InvalidParameter {
        /// The scheme.
        scheme: &'static str,
        /// The name of the parameter.
        parameter: &'static str,
        /// Its value.
        value: f64,
    },
}

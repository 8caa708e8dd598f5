//! Fields that cannot advance.

use thiserror::Error;

/// A field that cannot advance.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[error("{what} {value:e} at place {place}")]
pub struct FieldError {
    /// The quantity.
    pub what: &'static str,
    /// Its place in the memory.
    pub place: usize,
    /// Its value.
    pub value: f64,
}

//! Errors of a hierarchical matrix.

use thiserror::Error;

use crate::KernelError;

/// A hierarchical matrix that cannot be made, or changed.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum HMatrixError {
    /// A value is out of its range.
    #[error(transparent)]
    Value(#[from] KernelError),
    /// A number of the matrix is not finite.
    #[error(
        "the entry of receiver {receiver} due to source {source_cell} is {value}: do cells coincide?"
    )]
    Entry {
        /// The receiver.
        receiver: usize,
        /// The source.
        source_cell: usize,
        /// The number.
        value: f64,
    },
    /// The matrix takes more memory than it may.
    #[error(
        "the H-matrix takes about {needed} bytes{}, more than the limit of {limit} bytes: {}",
        if *tolerance > 0.0 { format!(" at a tolerance of {tolerance:e}") } else { " without far blocks".to_owned() },
        fitting.map_or_else(
            || "raise the limit, or take larger cells".to_owned(),
            |fitting| format!("a tolerance of {fitting:e} fits, or raise the limit, or take larger cells")
        )
    )]
    Memory {
        /// The bytes needed, as estimated from some blocks.
        needed: u64,
        /// The limit \[bytes\].
        limit: u64,
        /// The tolerance asked for; 0 without far blocks.
        tolerance: f64,
        /// The smallest power of ten, up to 0.1, that fits as a tolerance.
        fitting: Option<f64>,
    },
    /// A number was to be added to a pair that is not stored by itself.
    #[error(
        "receiver {receiver} and source {source_cell} are far from each other: numbers are added to near pairs alone"
    )]
    FarPair {
        /// The receiver.
        receiver: usize,
        /// The source.
        source_cell: usize,
    },
}

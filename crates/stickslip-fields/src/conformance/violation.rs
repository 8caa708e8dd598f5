//! Violations of the contract of a field.

use thiserror::Error;

use crate::FieldError;

/// A violation of the contract of [`FaultField`](crate::FaultField), with the numbers that show it.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[non_exhaustive]
pub enum FieldViolation {
    /// The advance fails.
    #[error("advance by {dt:e} s fails: {error}")]
    Refused {
        /// The time step \[s\].
        dt: f64,
        /// The error.
        error: FieldError,
    },
    /// A value is not legal.
    #[error("{what} {place} is {value:e}{}, must be {requirement}", after(*dt))]
    Value {
        /// The quantity, such as "memory".
        what: &'static str,
        /// Its place: the number of the vertex, of the source or in the memory.
        place: usize,
        /// The time step \[s\], if there is one.
        dt: Option<f64>,
        /// The value; NaN if none has been written.
        value: f64,
        /// The requirement of a legal value.
        requirement: &'static str,
    },
    /// A value contradicts another one.
    #[error("{what} {place} is {found:e}{}, must be {requirement} {expected:e}", after(*dt))]
    Differs {
        /// The quantity, such as "memory after two halves of a step".
        what: &'static str,
        /// Its place: the number of the vertex, of the source or in the memory.
        place: usize,
        /// The time step \[s\], if there is one.
        dt: Option<f64>,
        /// The value.
        found: f64,
        /// The relation to the reference value.
        requirement: &'static str,
        /// The reference value.
        expected: f64,
    },
    /// The error of an advance that is not exact is not of third order in the time step.
    #[error(
        "two halves of a step of {dt:e} s differ from the whole by {by:e} of the pressure, which falls by {factor:.2} \
         with half the step, must be by about {expected}"
    )]
    Order {
        /// The time step \[s\].
        dt: f64,
        /// The largest difference of the pressures, relative to the largest pressure.
        by: f64,
        /// The factor by which it falls with half the time step.
        factor: f64,
        /// That of methods of second order: 8 with a constant source, 4 with one that changes by as much in any step.
        expected: f64,
    },
}

/// " after a step of .."
fn after(dt: Option<f64>) -> String {
    dt.map_or_else(String::new, |dt| format!(" after a step of {dt:e} s"))
}

//! Violations of the contract of a scheme.

use thiserror::Error;

#[cfg(doc)]
use crate::RateScheme;

/// A violation of the contract of [`RateScheme`], with the numbers that show it.
#[derive(Debug, Clone, PartialEq, Error)]
#[error(
    "{property}: {quantity} is {value:e}{}, must be {requirement}{}",
    at.map_or_else(String::new, |(name, value)| format!(" at {name} = {value:e}")),
    bound.map_or_else(String::new, |bound| format!(" {bound:e}"))
)]
#[non_exhaustive]
pub struct RateSchemeViolation {
    /// The violated property: "stages", "weights", "constant velocity", "consistency", "order", "symmetry" or
    /// "stability", in the words of [`check_rate_scheme`](crate::check_rate_scheme).
    pub property: &'static str,
    /// The quantity that shows it, as `c_u` or "spectral radius of a step".
    pub quantity: &'static str,
    /// The name and value of the varied quantity: the time step "dt" \[s\], the "stage" from 0, or "omega dt" of an
    /// oscillator.
    pub at: Option<(&'static str, f64)>,
    /// The value of the quantity.
    pub value: f64,
    /// The requirement of a legal value, before the bound if there is one: "at most".
    pub requirement: &'static str,
    /// The bound.
    pub bound: Option<f64>,
}

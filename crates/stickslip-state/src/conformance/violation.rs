//! Violations of the contract of a state law.

use std::fmt;

use crate::StateError;

/// One step of a state law: its start, slip rate and length.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Step {
    /// The value of the state before.
    pub from: f64,
    /// The slip rate \[m/s\].
    pub slip_rate: f64,
    /// The time step \[s\].
    pub dt: f64,
}

impl fmt::Display for Step {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self {
            from,
            slip_rate,
            dt,
        } = self;
        write!(f, "from {from:e} at {slip_rate:e} m/s over {dt:e} s")
    }
}

/// A violation found by [`check_state_law`](crate::check_state_law).
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum StateLawViolation {
    /// The law refuses its parameters, a state, or a valid step; or the list of states is empty.
    #[error(transparent)]
    Refused(#[from] StateError),
    /// The evolution is not a number.
    #[error("evolution is not a number at state {state:e}, {slip_rate:e} m/s")]
    EvolutionNotANumber {
        /// The value of the state.
        state: f64,
        /// The slip rate \[m/s\].
        slip_rate: f64,
    },
    /// The evolution increases with the state.
    #[error(
        "evolution increases from {at_lower:e} at state {lower:e} to {at_upper:e} at {upper:e}, {slip_rate:e} m/s"
    )]
    EvolutionIncreases {
        /// The smaller state.
        lower: f64,
        /// The larger state.
        upper: f64,
        /// The slip rate \[m/s\].
        slip_rate: f64,
        /// The evolution at the smaller state.
        at_lower: f64,
        /// The evolution at the larger state.
        at_upper: f64,
    },
    /// The slope of the evolution is positive, not a number, or not its derivative.
    #[error(
        "evolution_state_slope is {slope:e} at state {state:e}, {slip_rate:e} m/s, must be {requirement} {bound:e}"
    )]
    Slope {
        /// The requirement on the slope: "at most" 0, or "the difference quotient".
        requirement: &'static str,
        /// The value of the state.
        state: f64,
        /// The slip rate \[m/s\].
        slip_rate: f64,
        /// The slope \[1/s\].
        slope: f64,
        /// The reference value \[1/s\].
        bound: f64,
    },
    /// A rate of many nodes differs from that of its node by itself.
    #[error(
        "the rate of many nodes is {found:e} at state {state:e}, {slip_rate:e} m/s, must be that of evolution, \
         {expected:e}"
    )]
    ManyNodes {
        /// The value of the state.
        state: f64,
        /// The slip rate \[m/s\].
        slip_rate: f64,
        /// The rate of [`StateLaw::evolutions`](crate::StateLaw::evolutions).
        found: f64,
        /// That of [`StateLaw::evolution`](crate::StateLaw::evolution).
        expected: f64,
    },
    /// A step accepts a slip rate or a time step that is negative or NaN.
    #[error("advance accepts the step {step}")]
    Accepts {
        /// The step.
        step: Step,
    },
    /// A step of backward Euler or at constant rate returns an infinite or NaN state.
    #[error("a step {step} leads to {to:e}")]
    NotFinite {
        /// The step.
        step: Step,
        /// The value of the state after.
        to: f64,
    },
    /// The smaller of two states ends above the larger one.
    #[error("advance {step} leads to {to:e}, from {upper:e} to {to_upper:e}")]
    Order {
        /// The step from the smaller state.
        step: Step,
        /// Its result.
        to: f64,
        /// The larger state.
        upper: f64,
        /// The result of the same step from there.
        to_upper: f64,
    },
    /// A step, or its slope, violates a property.
    #[error("{property}: {found:e} {step}, must be {expected:e}")]
    Step {
        /// The violated property: "state after no time", "backward Euler", "composition of exact steps", "limit of
        /// small steps", "change by evolution", "advance_rate_slope" or "advance_at_constant_rate_rate_slope".
        property: &'static str,
        /// The step.
        step: Step,
        /// The value of the state after the step, its change, or the slope.
        found: f64,
        /// The reference value.
        expected: f64,
    },
}

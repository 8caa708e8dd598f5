//! How a state law can break its contract.

use std::fmt;

use crate::StateError;

/// One step of a state law: where it began, how fast and how long it slid.
#[derive(Clone, Copy, Debug, PartialEq)]
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

/// What [`check_state_law`](crate::check_state_law) found.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum StateLawViolation {
    /// There is no state to check the law at.
    #[error("no states to check the law at")]
    NoStates,
    /// The law refuses its parameters, a state, or a step that it must take.
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
        "evolution increases from {at_lower:e} at state {lower} to {at_upper:e} at {upper:e}, {slip_rate:e} m/s"
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
    /// The slope of the evolution is positive or not a number.
    #[error(
        "evolution_state_slope is {slope:e} at state {state:e}, {slip_rate:e} m/s, not at most 0"
    )]
    SlopeSign {
        /// The value of the state.
        state: f64,
        /// The slip rate \[m/s\].
        slip_rate: f64,
        /// The slope \[1/s\].
        slope: f64,
    },
    /// The slope of the evolution is not its derivative.
    #[error(
        "evolution_state_slope is {slope:e} at state {state:e}, {slip_rate:e} m/s, differences give {difference:e}"
    )]
    Slope {
        /// The value of the state.
        state: f64,
        /// The slip rate \[m/s\].
        slip_rate: f64,
        /// The slope \[1/s\].
        slope: f64,
        /// The difference quotient \[1/s\].
        difference: f64,
    },
    /// A step accepts a slip rate or a time step that is negative or not a number.
    #[error("advance accepts the step {step}")]
    Accepts {
        /// The step.
        step: Step,
    },
    /// A step of no time moves the state.
    #[error("a step {step} leads to {to:e}")]
    MovesInNoTime {
        /// The step.
        step: Step,
        /// The value of the state after.
        to: f64,
    },
    /// A step of backward Euler or at constant rate leads to an infinite state or none.
    #[error("a step {step} leads to {to:e}")]
    NotFinite {
        /// The step.
        step: Step,
        /// The value of the state after.
        to: f64,
    },
    /// A step does not solve the equation of backward Euler.
    #[error("advance {step} leads to {to:e}, bisection to {root:e}")]
    NotBackwardEuler {
        /// The step.
        step: Step,
        /// The value of the state after.
        to: f64,
        /// The solution by bisection.
        root: f64,
    },
    /// Of two states the smaller one ends above the larger one.
    #[error("advance {step} leads to {to:e}, from {upper:e} to {to_upper:e}")]
    Order {
        /// The step from the smaller state.
        step: Step,
        /// Where it leads.
        to: f64,
        /// The larger state.
        upper: f64,
        /// Where the same step leads from there.
        to_upper: f64,
    },
    /// The slope of a step of backward Euler is not its derivative in the slip rate.
    #[error("advance_rate_slope {step} is {slope:e}, differences give {difference:e}")]
    AdvanceSlope {
        /// The step.
        step: Step,
        /// The slope.
        slope: f64,
        /// The difference quotient.
        difference: f64,
    },
    /// The slope of a step at constant rate is not its derivative in the slip rate.
    #[error(
        "advance_at_constant_rate_rate_slope {step} is {slope:e}, differences give {difference:e}"
    )]
    ConstantRateSlope {
        /// The step.
        step: Step,
        /// The slope.
        slope: f64,
        /// The difference quotient.
        difference: f64,
    },
    /// Two exact steps one after the other differ from the whole.
    #[error("advance_exact {step} leads to {to:e}, in two parts to {in_parts:e}")]
    Composition {
        /// The step.
        step: Step,
        /// The value of the state after.
        to: f64,
        /// The same after two parts.
        in_parts: f64,
    },
    /// The exact solution does not begin as the evolution says.
    #[error("advance_exact {step} moves by {moved:e}, evolution says {expected:e}")]
    NotTheEvolution {
        /// The step.
        step: Step,
        /// The change of the state.
        moved: f64,
        /// The rate half way times the time.
        expected: f64,
    },
    /// The exact solution is not the limit of small steps of backward Euler.
    #[error("advance_exact {step} leads to {to:e}, small steps to {limit:e} within {bound:e}")]
    NotTheLimit {
        /// The step.
        step: Step,
        /// The value of the state after.
        to: f64,
        /// The same after many steps of backward Euler.
        limit: f64,
        /// The largest error of those.
        bound: f64,
    },
}

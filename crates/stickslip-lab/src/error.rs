//! Errors of records, models and fits, with the numbers that caused them.

use stickslip_state::{Number, StateError};
use thiserror::Error;

use crate::parameter::Parameter;

/// The error of a record, a curve or a fit.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum LabError {
    /// A value is out of its range.
    #[error("{what} must be {requirement}, is {} at position {position}", Number(*.value))]
    Value {
        /// The quantity.
        what: &'static str,
        /// The requirement of a legal value.
        requirement: &'static str,
        /// The index of the value among its like.
        position: usize,
        /// The value.
        value: f64,
    },
    /// Two lists that belong together differ in length.
    #[error("{what}: {found} values for {expected} samples; give one per sample")]
    Length {
        /// The shorter or longer list.
        what: &'static str,
        /// The number of samples.
        expected: usize,
        /// The number of values.
        found: usize,
    },
    /// The number of states is neither 1 nor 2, or parameters for another number of states are given.
    #[error(
        "{found} states, where {expected} can be taken; give one state law and one b and L per state"
    )]
    States {
        /// The numbers that can be taken.
        expected: &'static str,
        /// The number of states.
        found: usize,
    },
    /// Not more samples than parameters.
    #[error("{samples} samples do not determine {parameters} parameters; widen the window")]
    TooFewSamples {
        /// The number of samples in the window.
        samples: usize,
        /// The number of parameters.
        parameters: usize,
    },
    /// A fit without a record.
    #[error("no record to fit: give at least one")]
    NoRecord,
    /// One of several records cannot be fitted.
    #[error("record {number}: {cause}")]
    Record {
        /// Its number, from 1 on.
        number: usize,
        /// The reason.
        cause: Box<LabError>,
    },
    /// A parameter that all records share was fixed for one of them.
    #[error("all records share {parameter}: fix it for the fit, not for one record")]
    Shared {
        /// The parameter.
        parameter: Parameter,
    },
    /// The load point keeps its velocity over all samples.
    #[error(
        "the load point has the velocity {} m/s from the first to the last sample: the window must contain a velocity step or a hold",
        Number(*.velocity)
    )]
    NoVelocityStep {
        /// The velocity \[m/s\].
        velocity: f64,
    },
    /// No parameter has this name.
    #[error(
        "no parameter is called `{name}`: use a, b1, b2, L1, L2, k, mu0, trend, step_offset, Vc1, Vc2, c1, c2, initial_stress, initial_state1 or initial_state2"
    )]
    Name {
        /// The name.
        name: String,
    },
    /// No state law has this name.
    #[error(
        "no state law is called `{name}`: use aging, slip, perrin-rice-zheng, kato-tullis or nagata"
    )]
    LawName {
        /// The name.
        name: String,
    },
    /// A parameter that the law of its state does not have.
    #[error(
        "the {law} law has no parameter {parameter}: leave it out, or choose its law (Vc: kato-tullis, c: nagata)"
    )]
    OtherLaw {
        /// The parameter.
        parameter: Parameter,
        /// The law of its state.
        law: &'static str,
    },
    /// The record has no hold with samples before, in and behind it.
    #[error("no hold in the record: give a load history with a velocity of 0 between two slides")]
    NoHold,
    /// A state law without a steady state, or with a parameter out of its range.
    #[error(transparent)]
    State(#[from] StateError),
    /// The slip rate grows beyond any bound: the machine is softer than critical.
    #[error(
        "slip instability at t = {} s: the stiffness {} 1/m is below critical; increase the stiffness or L",
        Number(*.time), Number(*.stiffness)
    )]
    Unstable {
        /// The time \[s\].
        time: f64,
        /// `K/sigma_n` \[1/m\].
        stiffness: f64,
    },
    /// No start leads to a curve: all are unstable.
    #[error(
        "none of {starts} starts has a stable curve: give the stiffness in 1/m, or a guess with a larger L"
    )]
    NoStart {
        /// The number of starts.
        starts: usize,
    },
    /// The fit was interrupted before it had any parameters.
    #[error("the fit was interrupted before it had a curve: it has no parameters yet")]
    Interrupted,
    /// The fit did not converge.
    #[error(
        "the fit is {} standard errors away from a minimum after {steps} steps: give a guess with a larger L",
        Number(*.offset)
    )]
    NotConverged {
        /// The number of attempted steps.
        steps: usize,
        /// The relative offset: the distance to the minimum of the linear model over the radius of its confidence
        /// region.
        offset: f64,
    },
}

impl LabError {
    /// Passes a legal value, number `position` of its list.
    ///
    /// # Errors
    ///
    /// [`Value`](Self::Value) otherwise.
    pub fn check(
        what: &'static str,
        requirement: &'static str,
        position: usize,
        value: f64,
        legal: bool,
    ) -> Result<(), Self> {
        if legal {
            return Ok(());
        }
        Err(Self::Value {
            what,
            requirement,
            position,
            value,
        })
    }

    /// Passes a number that is finite and positive.
    ///
    /// # Errors
    ///
    /// [`Value`](Self::Value) otherwise.
    pub fn check_positive(what: &'static str, position: usize, value: f64) -> Result<(), Self> {
        let legal = value > 0.0 && value.is_finite();
        Self::check(what, "finite and positive", position, value, legal)
    }

    /// Passes a finite number.
    ///
    /// # Errors
    ///
    /// [`Value`](Self::Value) otherwise.
    pub fn check_finite(what: &'static str, position: usize, value: f64) -> Result<(), Self> {
        Self::check(what, "finite", position, value, value.is_finite())
    }
}

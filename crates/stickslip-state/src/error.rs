//! What can go wrong, with the numbers that did.

/// A scalar equation that [`increasing_root`](crate::increasing_root) could not solve.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum RootError {
    /// The function is not a number there.
    #[error("the function is not a number at {argument:e}")]
    NotANumber {
        /// Where it was evaluated.
        argument: f64,
    },
    /// The function keeps its sign as far as floating point numbers reach.
    #[error("no change of sign between {start:e} and {argument:e}")]
    NoSignChange {
        /// Where the search began.
        start: f64,
        /// The last argument tried.
        argument: f64,
    },
}

/// A state law with unusable parameters, or a step it could not take.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum StateError {
    /// A parameter that must be finite and positive is not.
    #[error("{parameter} = {value:e} is not finite and positive")]
    NotPositive {
        /// The field of the law.
        parameter: &'static str,
        /// Its value.
        value: f64,
    },
    /// The slip rate is negative, infinite or not a number.
    #[error("slip rate {slip_rate:e} m/s is not finite and non-negative")]
    SlipRate {
        /// The slip rate \[m/s\].
        slip_rate: f64,
    },
    /// The time step is negative, infinite or not a number.
    #[error("time step {dt:e} s is not finite and non-negative")]
    TimeStep {
        /// The time step \[s\].
        dt: f64,
    },
    /// The state is infinite or not a number.
    #[error("state {value:e} is not finite")]
    State {
        /// The value of the state.
        value: f64,
    },
    /// The state `theta` is negative.
    #[error("state theta = {theta:e} s is negative")]
    NegativeTheta {
        /// The state \[s\].
        theta: f64,
    },
    /// The equation of backward Euler has no solution in floating point.
    #[error("state {from:e} cannot be advanced by {dt:e} s at {slip_rate:e} m/s: {source}")]
    Advance {
        /// The value of the state before the step.
        from: f64,
        /// The slip rate \[m/s\].
        slip_rate: f64,
        /// The time step \[s\].
        dt: f64,
        /// What the scalar solver met.
        source: RootError,
    },
}

impl StateError {
    /// Passes a parameter that is finite and positive.
    ///
    /// # Errors
    ///
    /// [`NotPositive`](Self::NotPositive) otherwise.
    pub fn check_positive(parameter: &'static str, value: f64) -> Result<(), Self> {
        if value.is_finite() && value > 0.0 {
            Ok(())
        } else {
            Err(Self::NotPositive { parameter, value })
        }
    }

    /// Passes the value of a state that is finite.
    ///
    /// # Errors
    ///
    /// [`State`](Self::State) otherwise.
    pub fn check_state(value: f64) -> Result<(), Self> {
        if value.is_finite() {
            Ok(())
        } else {
            Err(Self::State { value })
        }
    }

    /// Passes a slip rate \[m/s\] and a time step \[s\] that are finite and non-negative.
    ///
    /// # Errors
    ///
    /// [`SlipRate`](Self::SlipRate) or [`TimeStep`](Self::TimeStep) otherwise.
    pub fn check_step(slip_rate: f64, dt: f64) -> Result<(), Self> {
        if !(slip_rate.is_finite() && slip_rate >= 0.0) {
            Err(Self::SlipRate { slip_rate })
        } else if !(dt.is_finite() && dt >= 0.0) {
            Err(Self::TimeStep { dt })
        } else {
            Ok(())
        }
    }
}

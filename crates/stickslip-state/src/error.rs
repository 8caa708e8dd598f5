//! Errors of state laws, with the numbers that caused them.

use crate::Number;

/// Errors of a state law: unusable parameters, or a step or equation without a solution.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum StateError {
    /// A parameter, a slip rate, a time step or a state is out of its range.
    #[error("{what} must be {requirement}, is {}", Number(*.value))]
    Value {
        /// The field of the law, or the quantity with its unit.
        what: &'static str,
        /// The requirement of a legal value.
        requirement: &'static str,
        /// The value.
        value: f64,
    },
    /// [`increasing_root`](crate::increasing_root) found no root: the function is NaN, or keeps its sign over all
    /// floating point numbers.
    #[error(
        "no root found from {} on: the function is {} at {}; start nearer to the root",
        Number(*.start), Number(*.value), Number(*.argument)
    )]
    NoRoot {
        /// The start of the search.
        start: f64,
        /// The last tried argument.
        argument: f64,
        /// The value of the function there.
        value: f64,
    },
    /// The equation of backward Euler has no solution in floating point.
    #[error(
        "state {} cannot be advanced by {} s at {} m/s: the residual is {} at state {}; reduce dt",
        Number(*.from), Number(*.dt), Number(*.slip_rate), Number(*.value), Number(*.argument)
    )]
    Advance {
        /// The value of the state before the step.
        from: f64,
        /// The slip rate \[m/s\].
        slip_rate: f64,
        /// The time step \[s\].
        dt: f64,
        /// The last tried state.
        argument: f64,
        /// The residual of the equation there.
        value: f64,
    },
}

const NON_NEGATIVE: &str = "finite and non-negative";

impl StateError {
    /// Passes a value that is legal.
    ///
    /// # Errors
    ///
    /// [`Value`](Self::Value) otherwise.
    pub fn check(
        what: &'static str,
        requirement: &'static str,
        value: f64,
        legal: bool,
    ) -> Result<(), Self> {
        if legal {
            return Ok(());
        }
        Err(Self::Value {
            what,
            requirement,
            value,
        })
    }

    /// Passes a parameter that is finite and positive.
    ///
    /// # Errors
    ///
    /// [`Value`](Self::Value) otherwise.
    pub fn check_positive(what: &'static str, value: f64) -> Result<(), Self> {
        let legal = value.is_finite() && value > 0.0;
        Self::check(what, "finite and positive", value, legal)
    }

    /// Passes the value of a state that is finite.
    ///
    /// # Errors
    ///
    /// [`Value`](Self::Value) otherwise.
    pub fn check_state(value: f64) -> Result<(), Self> {
        Self::check("state", "finite", value, value.is_finite())
    }

    /// Passes a slip rate \[m/s\] and a time step \[s\] that are finite and non-negative.
    ///
    /// # Errors
    ///
    /// [`Value`](Self::Value) otherwise.
    pub fn check_step(slip_rate: f64, dt: f64) -> Result<(), Self> {
        let legal = |value: f64| value.is_finite() && value >= 0.0;
        Self::check("slip rate [m/s]", NON_NEGATIVE, slip_rate, legal(slip_rate))?;
        Self::check("time step [s]", NON_NEGATIVE, dt, legal(dt))
    }

    /// The same error as the failure of a step from a state, at a slip rate \[m/s\], over a time \[s\].
    #[must_use]
    pub fn in_step(self, from: f64, slip_rate: f64, dt: f64) -> Self {
        match self {
            Self::NoRoot {
                argument, value, ..
            } => Self::Advance {
                from,
                slip_rate,
                dt,
                argument,
                value,
            },
            other => other,
        }
    }
}

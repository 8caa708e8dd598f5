//! How a friction law can break its contract.

use crate::FrictionError;

/// What [`check_friction_law`](crate::check_friction_law) found.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum FrictionLawViolation {
    /// There is no state to check the law at.
    #[error("no states to check the law at")]
    NoStates,
    /// The law refuses its parameters.
    #[error(transparent)]
    Refused(#[from] FrictionError),
    /// The coefficient is negative, infinite or not a number.
    #[error("coefficient is {coefficient:e} at {slip_rate:e} m/s, state {state:e}")]
    Coefficient {
        /// The value of the state.
        state: f64,
        /// The slip rate \[m/s\].
        slip_rate: f64,
        /// The coefficient.
        coefficient: f64,
    },
    /// The coefficient decreases with the slip rate.
    #[error(
        "coefficient decreases from {at_slower:e} at {slower:e} m/s to {at_faster:e} at {faster:e} m/s, state {state:e}"
    )]
    CoefficientDecreases {
        /// The value of the state.
        state: f64,
        /// The smaller slip rate \[m/s\].
        slower: f64,
        /// The larger slip rate \[m/s\].
        faster: f64,
        /// The coefficient at the smaller rate.
        at_slower: f64,
        /// The coefficient at the larger rate.
        at_faster: f64,
    },
    /// The slope of the coefficient is negative or not a number.
    #[error(
        "coefficient_rate_slope is {slope:e} at {slip_rate:e} m/s, state {state:e}, not at least 0"
    )]
    SlopeSign {
        /// The value of the state.
        state: f64,
        /// The slip rate \[m/s\].
        slip_rate: f64,
        /// The slope \[s/m\].
        slope: f64,
    },
    /// The slope of the coefficient is not its derivative.
    #[error(
        "coefficient_rate_slope is {slope:e} at {slip_rate:e} m/s, state {state:e}, differences give {difference:e}"
    )]
    Slope {
        /// The value of the state.
        state: f64,
        /// The slip rate \[m/s\].
        slip_rate: f64,
        /// The slope \[s/m\].
        slope: f64,
        /// The difference quotient \[s/m\].
        difference: f64,
    },
    /// Coefficient and slope are others together than one by one.
    #[error(
        "coefficient_and_rate_slope is ({coefficient:e}, {slope:e}) at {slip_rate:e} m/s, state {state:e}, one by one ({coefficient_alone:e}, {slope_alone:e})"
    )]
    Together {
        /// The value of the state.
        state: f64,
        /// The slip rate \[m/s\].
        slip_rate: f64,
        /// The coefficient.
        coefficient: f64,
        /// The slope \[s/m\].
        slope: f64,
        /// What `coefficient` returns.
        coefficient_alone: f64,
        /// What `coefficient_rate_slope` returns \[s/m\].
        slope_alone: f64,
    },
    /// The slope of the coefficient in the state is not its derivative.
    #[error(
        "coefficient_state_slope is {slope:e} at {slip_rate:e} m/s, state {state:e}, differences give {difference:e}"
    )]
    StateSlope {
        /// The value of the state.
        state: f64,
        /// The slip rate \[m/s\].
        slip_rate: f64,
        /// The slope.
        slope: f64,
        /// The difference quotient.
        difference: f64,
    },
    /// The potential is not 0 at rest.
    #[error("potential is {potential:e} at rest, state {state:e}, not 0")]
    PotentialAtRest {
        /// The value of the state.
        state: f64,
        /// The potential \[m/s\].
        potential: f64,
    },
    /// The potential lies above a chord, or is not a number.
    #[error(
        "potential is {potential:e} at {slip_rate:e} m/s, state {state:e}, on the chord {chord:e}"
    )]
    NotConvex {
        /// The value of the state.
        state: f64,
        /// The slip rate \[m/s\].
        slip_rate: f64,
        /// The potential \[m/s\].
        potential: f64,
        /// The mean of the potential at rest and at twice the rate \[m/s\].
        chord: f64,
    },
    /// The potential is not the integral of the coefficient.
    #[error(
        "potential is {potential:e} at {slip_rate:e} m/s, state {state:e}, the integral {integral:e}"
    )]
    NotTheIntegral {
        /// The value of the state.
        state: f64,
        /// The slip rate \[m/s\].
        slip_rate: f64,
        /// The potential \[m/s\].
        potential: f64,
        /// The integral of the coefficient by quadrature \[m/s\].
        integral: f64,
    },
    /// A contact moves that can hold.
    #[error(
        "slip_rate is {slip_rate:e} m/s under {drive:e}, state {state:e}, though friction at rest is {strength:e}"
    )]
    DoesNotStick {
        /// The value of the state.
        state: f64,
        /// The viscosity \[s/m\].
        viscosity: f64,
        /// The drive.
        drive: f64,
        /// The slip rate \[m/s\].
        slip_rate: f64,
        /// The coefficient at rest.
        strength: f64,
    },
    /// A slip rate does not solve the local problem.
    #[error(
        "slip_rate is {slip_rate:e} m/s for viscosity {viscosity:e} s/m, drive {drive:e}, state {state:e}, bisection gives {root:e} m/s"
    )]
    NotBalanced {
        /// The value of the state.
        state: f64,
        /// The viscosity \[s/m\].
        viscosity: f64,
        /// The drive.
        drive: f64,
        /// The slip rate \[m/s\].
        slip_rate: f64,
        /// The solution by bisection \[m/s\].
        root: f64,
    },
}

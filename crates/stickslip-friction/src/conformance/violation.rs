//! Violations of the contract of a friction law or a convex potential.

use crate::FrictionError;

/// A violation found by [`check_friction_law`](crate::check_friction_law) or
/// [`check_convex_potential`](crate::check_convex_potential). Points of a potential are given by their speed \[m/s\].
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum FrictionViolation {
    /// The law refuses its parameters, or the list of states is empty.
    #[error(transparent)]
    Refused(#[from] FrictionError),
    /// A function of slip rate and state is out of its range: negative, infinite or NaN.
    #[error("{what} is {value:e} at {slip_rate:e} m/s, state {state:e}, must be {requirement}")]
    Value {
        /// The function: "coefficient", "coefficient_rate_slope" or "potential".
        what: &'static str,
        /// The requirement of a legal value.
        requirement: &'static str,
        /// The value of the state.
        state: f64,
        /// The slip rate \[m/s\].
        slip_rate: f64,
        /// The value of the function.
        value: f64,
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
    /// A function of slip rate and state contradicts another one.
    #[error(
        "{what} is {found:e} at {slip_rate:e} m/s, state {state:e}, must be {requirement} {expected:e}"
    )]
    Differs {
        /// The function: "coefficient_rate_slope", "coefficient_state_slope", "potential", or the part of
        /// `coefficient_and_rate_slope` and `response` that differs from its separate evaluation.
        what: &'static str,
        /// The relation: to "the difference quotient", "the integral", at most "the chord", or to "that alone".
        requirement: &'static str,
        /// The value of the state.
        state: f64,
        /// The slip rate \[m/s\].
        slip_rate: f64,
        /// The value of the function.
        found: f64,
        /// The reference value.
        expected: f64,
    },
    /// A slip rate does not solve the local problem: it is not 0 although friction at rest bears the drive, or does not
    /// balance the forces.
    #[error(
        "slip_rate is {slip_rate:e} m/s for viscosity {viscosity:e} s/m, drive {drive:e}, friction at rest \
         {strength:e}, state {state:e}, must be {expected:e} m/s"
    )]
    SlipRate {
        /// The value of the state.
        state: f64,
        /// The viscosity \[s/m\].
        viscosity: f64,
        /// The drive.
        drive: f64,
        /// The coefficient at rest.
        strength: f64,
        /// The slip rate \[m/s\].
        slip_rate: f64,
        /// The solution: 0, or by bisection \[m/s\].
        expected: f64,
    },
    /// A quantity of a potential at one point contradicts the others.
    #[error("{what} is {found:e} at speed {speed:e} m/s, must be {requirement} {expected:e}")]
    Potential {
        /// The quantity: "value", "lower slope", "slope of the gradient", "asymmetry of the Hessian", "eigenvalue of
        /// the Hessian", "entry of the Hessian" or "component of keep_smooth".
        what: &'static str,
        /// The relation.
        requirement: &'static str,
        /// The speed of the point.
        speed: f64,
        /// The quantity.
        found: f64,
        /// The reference value.
        expected: f64,
    },
    /// A potential is not convex: the value at the middle of a segment lies above the mean of its ends, "the chord", or a
    /// value below the tangent at another point.
    #[error(
        "value is {value:e}, must be {requirement} {bound:e}, of the points at speeds {from:e} and {to:e} m/s"
    )]
    NotConvex {
        /// The relation: "at most the chord" in the middle, or "at least the tangent" at the second end.
        requirement: &'static str,
        /// The speed at one end.
        from: f64,
        /// The speed at the other end.
        to: f64,
        /// The value \[W\].
        value: f64,
        /// The bound \[W\].
        bound: f64,
    },
    /// The result of `minimize` does not balance the forces, or another point nearby has a lower energy.
    #[error(
        "{what} of minimize is {found:e} at speed {speed:e} m/s under {force:e} N, must be at most {bound:e}"
    )]
    Minimizer {
        /// The quantity: "force \[N\] outside of the subdifferential" or "energy \[W\]".
        what: &'static str,
        /// The speed of the minimiser.
        speed: f64,
        /// The norm of the force.
        force: f64,
        /// The quantity at the minimiser.
        found: f64,
        /// The rounding error, or the energy of another point nearby.
        bound: f64,
    },
}

impl FrictionViolation {
    /// A function of slip rate and state that is out of its range.
    pub(super) fn value(
        what: &'static str,
        requirement: &'static str,
        [state, slip_rate]: [f64; 2],
        value: f64,
    ) -> Self {
        Self::Value {
            what,
            requirement,
            state,
            slip_rate,
            value,
        }
    }

    /// A function of slip rate and state that differs from another one.
    pub(super) fn differs(
        what: &'static str,
        requirement: &'static str,
        [state, slip_rate]: [f64; 2],
        [found, expected]: [f64; 2],
    ) -> Self {
        Self::Differs {
            what,
            requirement,
            state,
            slip_rate,
            found,
            expected,
        }
    }

    /// A quantity of a potential.
    pub(super) fn potential(
        what: &'static str,
        requirement: &'static str,
        speed: f64,
        [found, expected]: [f64; 2],
    ) -> Self {
        Self::Potential {
            what,
            requirement,
            speed,
            found,
            expected,
        }
    }
}

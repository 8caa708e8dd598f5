//! How a convex potential can break its contract.

/// What [`check_convex_potential`](crate::check_convex_potential) found; points are given by their
/// speed \[m/s\].
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum PotentialViolation {
    /// The value is not a number.
    #[error("value is not a number at speed {speed:e} m/s")]
    NotANumber {
        /// The speed of the point.
        speed: f64,
    },
    /// The value at the middle of a segment lies above the mean of its ends.
    #[error("value is {value:e} between speeds {from:e} and {to:e} m/s, on the chord {chord:e}")]
    NotConvex {
        /// The speed at one end.
        from: f64,
        /// The speed at the other end.
        to: f64,
        /// The value in the middle \[W\].
        value: f64,
        /// The mean of the values at the ends \[W\].
        chord: f64,
    },
    /// The slopes along a direction are no interval.
    #[error("slope_along goes from {lower:e} to {upper:e} at speed {speed:e} m/s")]
    Interval {
        /// The speed of the point.
        speed: f64,
        /// The lower slope.
        lower: f64,
        /// The upper slope.
        upper: f64,
    },
    /// A tangent lies above the value.
    #[error(
        "value is {value:e} at speed {to:e} m/s, on the tangent at speed {from:e} m/s {tangent:e}"
    )]
    Subgradient {
        /// The speed where the tangent touches.
        from: f64,
        /// The speed where the two are compared.
        to: f64,
        /// The value \[W\].
        value: f64,
        /// The tangent \[W\].
        tangent: f64,
    },
    /// The gradient of the local model is not the slope.
    #[error("gradient has the slope {gradient:e} at speed {speed:e} m/s, slope_along {slope:e}")]
    Gradient {
        /// The speed of the point.
        speed: f64,
        /// The slope of the model.
        gradient: f64,
        /// The slope of the potential.
        slope: f64,
    },
    /// The Hessian is not symmetric or has a negative eigenvalue.
    #[error(
        "Hessian at speed {speed:e} m/s has asymmetry {asymmetry:e}, eigenvalue {eigenvalue:e}"
    )]
    Hessian {
        /// The speed of the point.
        speed: f64,
        /// The largest entry of the skew part.
        asymmetry: f64,
        /// The smallest eigenvalue.
        eigenvalue: f64,
    },
    /// The Hessian is not the derivative of the gradient.
    #[error(
        "Hessian has the entry {entry:e} at speed {speed:e} m/s, differences give {difference:e}"
    )]
    Curvature {
        /// The speed of the point.
        speed: f64,
        /// The entry of the Hessian.
        entry: f64,
        /// The difference quotient of the gradient.
        difference: f64,
    },
    /// The minimiser does not balance the forces.
    #[error(
        "minimize leaves a force {excess:e} N outside the subdifferential, at speed {speed:e} m/s under {force:e} N"
    )]
    NotOptimal {
        /// The speed of the minimiser.
        speed: f64,
        /// The norm of the force.
        force: f64,
        /// The force in some direction beyond the slopes of the potential.
        excess: f64,
    },
    /// Another point has a lower energy.
    #[error("minimize has the energy {energy:e}, a point nearby {lower:e}, under {force:e} N")]
    NotMinimal {
        /// The norm of the force.
        force: f64,
        /// The energy of the minimiser \[W\].
        energy: f64,
        /// The energy of the other point \[W\].
        lower: f64,
    },
    /// A correction comes back longer, or with a component turned around.
    #[error("keep_smooth turns the component {component:e} into {kept:e} at speed {speed:e} m/s")]
    Correction {
        /// The speed of the point.
        speed: f64,
        /// A component of the correction.
        component: f64,
        /// What was kept of it.
        kept: f64,
    },
}

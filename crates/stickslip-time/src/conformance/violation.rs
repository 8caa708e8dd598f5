//! How a scheme breaks its contract.

use thiserror::Error;

#[cfg(doc)]
use crate::RateScheme;

/// How a scheme breaks the contract of [`RateScheme`], with the numbers that show it.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum RateSchemeViolation {
    /// A weight is not what a factor of a matrix, or of a motion, has to be.
    #[error("dt = {dt:e}: {name} is {value:e}, not finite and {range}")]
    Weight {
        /// The time step \[s\].
        dt: f64,
        /// `c_u`, `c_a`, or the quantity that the weight belongs to.
        name: &'static str,
        /// Its value.
        value: f64,
        /// The range it has to be in.
        range: &'static str,
    },
    /// The stages do not lead through a step.
    #[error("stage {stage}: {name} is {value:e}")]
    Stage {
        /// The stage, from 0.
        stage: usize,
        /// Which number of it.
        name: &'static str,
        /// Its value.
        value: f64,
    },
    /// A motion of constant velocity is not reproduced.
    #[error("dt = {dt:e}: at constant velocity {component} is {found:e}, not {expected:e}")]
    ConstantVelocity {
        /// The time step \[s\].
        dt: f64,
        /// The component of the new motion.
        component: &'static str,
        /// What the scheme says.
        found: f64,
        /// What it is.
        expected: f64,
    },
    /// On a smooth motion the error of a step falls too slowly with the time step.
    #[error("{component} is of order {order:.2} in dt on a smooth motion, not {expected}")]
    NotConsistent {
        /// The component of the new motion.
        component: &'static str,
        /// The observed order.
        order: f64,
        /// The order from which the scheme converges.
        expected: f64,
    },
    /// The scheme is of a lower order than it says.
    #[error("of order {observed:.2} on a driven oscillator, not {claimed}")]
    Order {
        /// The observed order.
        observed: f64,
        /// The order of the facts.
        claimed: usize,
    },
    /// The scheme is not the same forth and back, though it says so.
    #[error("a step forth and one back end {distance:e} from the start")]
    NotSymmetric {
        /// The distance, for a start of size one.
        distance: f64,
    },
    /// The undamped oscillator gains amplitude without bound.
    #[error("omega dt = {frequency:e}: the oscillator grows by a factor of {growth} a step")]
    Unstable {
        /// Angular frequency times step.
        frequency: f64,
        /// The spectral radius of a step, above one.
        growth: f64,
    },
}

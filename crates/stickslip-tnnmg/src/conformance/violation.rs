//! How a solver breaks its contract.

use thiserror::Error;

#[cfg(doc)]
use crate::NonsmoothSolver;
use crate::SolveError;

use super::SampleFriction;

/// How a solver breaks the contract of [`NonsmoothSolver`], with the numbers that show it.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum SolverViolation {
    /// A problem that has a solution was not solved.
    #[error("{friction:?}: not solved: {error}")]
    Failed {
        /// The kind of friction.
        friction: SampleFriction,
        /// What the solver says.
        error: SolveError,
    },
    /// The result is not the minimiser.
    #[error("{friction:?}: {distance:e} from the minimiser, tolerance {tolerance:e}")]
    NotMinimizer {
        /// The kind of friction.
        friction: SampleFriction,
        /// The distance in the stopping norm.
        distance: f64,
        /// The tolerance asked for.
        tolerance: f64,
    },
    /// The energy is larger than that of the start.
    #[error("{friction:?}: the energy rose from {before:e} to {after:e}")]
    EnergyRose {
        /// The kind of friction.
        friction: SampleFriction,
        /// The energy of the start.
        before: f64,
        /// The energy of the result.
        after: f64,
    },
    /// A fixed component has another value than at the start.
    #[error("fixed component {component} of vertex {vertex} went from {before:e} to {after:e}")]
    FixedMoved {
        /// The vertex.
        vertex: usize,
        /// The component.
        component: usize,
        /// The datum.
        before: f64,
        /// The value returned.
        after: f64,
    },
    /// A solver that has solved before finds another minimiser from another start.
    #[error("{friction:?}: two calls differ by {distance:e}, tolerance {tolerance:e}")]
    DependsOnHistory {
        /// The kind of friction.
        friction: SampleFriction,
        /// The distance of the results in the stopping norm.
        distance: f64,
        /// The tolerance asked for.
        tolerance: f64,
    },
    /// Solved in parts, the load condensed before and the body following behind, the result is another one.
    #[error("{friction:?}: in parts {distance:e} from the result at once, tolerance {tolerance:e}")]
    DiffersInParts {
        /// The kind of friction.
        friction: SampleFriction,
        /// The distance of the results in the stopping norm.
        distance: f64,
        /// The tolerance asked for.
        tolerance: f64,
    },
    /// A change of the frictional vertices is not measured as the change of the body that follows.
    #[error("{friction:?}: a change of norm {expected:e} measured as {found:e}")]
    ChangeNorm {
        /// The kind of friction.
        friction: SampleFriction,
        /// The norm of the change of the body.
        expected: f64,
        /// What the solver says.
        found: f64,
    },
    /// A field of the wrong length is no error.
    #[error("{field} of {found} entries accepted where {expected} are due")]
    LengthAccepted {
        /// What was too short or too long.
        field: &'static str,
        /// The length that fits.
        expected: usize,
        /// The length given.
        found: usize,
    },
    /// A load that is not a number is no error.
    #[error("a load that is not a number accepted at vertex {vertex}")]
    NotANumberAccepted {
        /// The vertex.
        vertex: usize,
    },
    /// The report counts no iterations.
    #[error("{friction:?}: solved, and no iteration reported")]
    NoIterations {
        /// The kind of friction.
        friction: SampleFriction,
    },
}

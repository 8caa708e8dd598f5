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
    /// The result is another one than it has to be.
    #[error("{friction:?}: {distance:e} from {from}, tolerance {tolerance:e}")]
    Differs {
        /// The kind of friction.
        friction: SampleFriction,
        /// What it is compared with: "the minimiser", "the result from another start", after the same solver has solved
        /// from there, or "the result at once", for a load that is condensed before and a body that is extended behind.
        from: &'static str,
        /// The distance in the stopping norm.
        distance: f64,
        /// The tolerance asked for.
        tolerance: f64,
    },
    /// A number is not what it has to be.
    #[error("{friction:?}: the {what} is {found:e}, must be {requirement} {bound:e}")]
    Value {
        /// The kind of friction.
        friction: SampleFriction,
        /// The number: "energy of the result", "measured norm of a change" of the frictional vertices, or "number of
        /// iterations reported".
        what: &'static str,
        /// The number found.
        found: f64,
        /// How it is compared.
        requirement: &'static str,
        /// With what: the energy of the start, the norm of the change of the body that follows, or 1.
        bound: f64,
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
}

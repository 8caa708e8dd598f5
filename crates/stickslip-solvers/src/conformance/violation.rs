//! Violations of the contract of a solver.

use thiserror::Error;

#[cfg(doc)]
use crate::NonsmoothSolver;
use crate::SolveError;

use super::SampleFriction;

/// A violation of the contract of [`NonsmoothSolver`], with the numbers that show it.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum SolverViolation {
    /// The solver failed on a problem that has a solution.
    #[error("{friction:?}: not solved: {error}")]
    Failed {
        /// The kind of friction.
        friction: SampleFriction,
        /// The error of the solver.
        error: SolveError,
    },
    /// The result differs from the reference.
    #[error("{friction:?}: {distance:e} from {from}, tolerance {tolerance:e}")]
    Differs {
        /// The kind of friction.
        friction: SampleFriction,
        /// The reference: "the minimiser", "the result from another start", after the same solver has solved from
        /// there, or "the result at once", for a load condensed first and a body extended afterwards.
        from: &'static str,
        /// The distance in the stopping norm.
        distance: f64,
        /// The requested tolerance.
        tolerance: f64,
    },
    /// A number violates its requirement.
    #[error("{friction:?}: the {what} is {found:e}, must be {requirement} {bound:e}")]
    Value {
        /// The kind of friction.
        friction: SampleFriction,
        /// The number: "energy of the result", "measured norm of a change" of the frictional vertices, or "number of
        /// iterations reported".
        what: &'static str,
        /// The number found.
        found: f64,
        /// The relation required.
        requirement: &'static str,
        /// The bound: the energy of the start, the norm of the change of the body that follows, or 1.
        bound: f64,
    },
    /// A fixed component differs from its value at the start.
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
    /// A field of the wrong length was accepted.
    #[error("{field} of {found} entries accepted where {expected} are due")]
    LengthAccepted {
        /// The field that was too short or too long.
        field: &'static str,
        /// The length that fits.
        expected: usize,
        /// The length given.
        found: usize,
    },
    /// A load that is not a number was accepted.
    #[error("a load that is not a number accepted at vertex {vertex}")]
    NotANumberAccepted {
        /// The vertex.
        vertex: usize,
    },
}

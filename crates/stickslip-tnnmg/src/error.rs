//! Why a velocity problem was not solved.

use thiserror::Error;

/// The ways in which a [`NonsmoothSolver`](crate::NonsmoothSolver) fails.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum SolveError {
    /// The iteration stopped before the tolerance was reached.
    #[error(
        "no minimiser after {iterations} iterations: change {change:.3e}, tolerance {tolerance:.3e}"
    )]
    NotConverged {
        /// Iterations spent.
        iterations: usize,
        /// The last change in the stopping norm.
        change: f64,
        /// The change that was asked for.
        tolerance: f64,
    },
    /// An iterate or its norm is not a finite number.
    #[error("iteration {iteration} left the finite numbers: change {change}")]
    NotFinite {
        /// The iteration, from 1.
        iteration: usize,
        /// The change in the stopping norm.
        change: f64,
    },
    /// A diagonal solver met a row with other entries than the diagonal one.
    #[error("the operator is not diagonal in the row of vertex {vertex}")]
    NotDiagonal {
        /// The vertex.
        vertex: usize,
    },
    /// The diagonal block of a vertex is not positive definite on its free components.
    #[error("the operator's diagonal block at vertex {vertex} is not positive definite")]
    IndefiniteBlock {
        /// The vertex.
        vertex: usize,
    },
    /// Conjugate gradients met a direction in which the operator is not positive.
    #[error(
        "iteration {iteration}: the operator is not positive definite, curvature {curvature:e}"
    )]
    IndefiniteDirection {
        /// The iteration, from 1.
        iteration: usize,
        /// `d . B d` of the direction.
        curvature: f64,
    },
    /// The matrix of the coarsest level has no Cholesky factor.
    #[error("the coarse matrix is not positive definite: pivot {pivot} of {unknowns}")]
    IndefiniteCoarseMatrix {
        /// The failing pivot in elimination order.
        pivot: usize,
        /// The number of coarse unknowns.
        unknowns: usize,
    },
    /// The symbolic factorisation of the coarse matrix failed, for want of memory or index range.
    #[error("the coarse matrix of {unknowns} unknowns and {entries} entries cannot be analysed")]
    CoarseAnalysis {
        /// The number of coarse unknowns.
        unknowns: usize,
        /// The number of stored entries.
        entries: usize,
    },
    /// The operator has no Cholesky factor on its free components.
    #[error(
        "the operator is not positive definite: pivot {pivot} of {unknowns}, at vertex {vertex}"
    )]
    IndefiniteOperator {
        /// The failing pivot in elimination order.
        pivot: usize,
        /// The number of free components.
        unknowns: usize,
        /// The vertex that the pivot belongs to.
        vertex: usize,
    },
    /// A direct solution does not solve: rounding alone made the operator's factor.
    #[error("the operator is singular to rounding: {residual:e} is left of a load of {load:e}")]
    Singular {
        /// The Euclidean norm of `r - B x` on the free components.
        residual: f64,
        /// That of `r`.
        load: f64,
    },
    /// The symbolic factorisation of the operator failed, for want of memory or index range.
    #[error("the operator of {unknowns} unknowns and {entries} entries cannot be analysed")]
    Analysis {
        /// The number of unknowns.
        unknowns: usize,
        /// The number of stored entries.
        entries: usize,
    },
    /// Operator and potential together have a direction of negative curvature.
    #[error("iteration {iteration}: the energy is not convex at frictional vertex {vertex}")]
    NotConvex {
        /// The vertex at which elimination meets it.
        vertex: usize,
        /// The iteration, from 1.
        iteration: usize,
    },
    /// A factorisation would take more memory than it may.
    #[error("a factor of {unknowns} unknowns takes {needed} bytes, {allowed} are allowed")]
    MemoryLimit {
        /// The number of free components.
        unknowns: usize,
        /// The memory that one factor takes, with what is shared by all \[byte\].
        needed: usize,
        /// The limit \[byte\].
        allowed: usize,
    },
    /// A field, mask or transfer does not fit the operator.
    #[error("{expected} vertices expected, {found} found")]
    SizeMismatch {
        /// The length that fits.
        expected: usize,
        /// The length given.
        found: usize,
    },
    /// Frictional vertices are not strictly increasing or out of range.
    #[error("frictional vertex {vertex} at position {position} is out of order or range")]
    UnsortedVertices {
        /// Its index.
        vertex: usize,
        /// Its place in the list.
        position: usize,
    },
}

//! Why a velocity problem was not solved.

use thiserror::Error;

/// The ways in which a [`NonsmoothSolver`](crate::NonsmoothSolver) fails.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum SolveError {
    /// The iteration stopped before the tolerance was reached.
    #[error(
        "no minimiser after {iterations} iterations: change {change:.3e}, tolerance {tolerance:.3e}; a smaller step or a direct solver (Condensed, Cholesky) may do"
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
    #[error(
        "iteration {iteration} left the finite numbers: change {change:e}; a load or an operator of this size cannot be used"
    )]
    NotFinite {
        /// The iteration, from 1.
        iteration: usize,
        /// The change in the stopping norm.
        change: f64,
    },
    /// A diagonal solver met a row with other entries than the diagonal one.
    #[error(
        "the operator is not diagonal in the row of vertex {vertex}: it takes Condensed or Tnnmg"
    )]
    NotDiagonal {
        /// The vertex.
        vertex: usize,
    },
    /// The diagonal block of a vertex is not positive definite on its free components.
    #[error(
        "the operator's diagonal block at vertex {vertex} is not positive definite: the vertex belongs to no cell, or a material is out of its range"
    )]
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
    #[error(
        "the coarse matrix is not positive definite, pivot {pivot} of {unknowns}: a material is out of its range, or cells differ too much for multigrid and a direct solver (Condensed, Cholesky) may do"
    )]
    IndefiniteCoarseMatrix {
        /// The failing pivot in elimination order.
        pivot: usize,
        /// The number of coarse unknowns.
        unknowns: usize,
    },
    /// The symbolic factorisation of the coarse matrix failed, for want of memory or index range.
    #[error(
        "the coarse matrix of {unknowns} unknowns and {entries} entries cannot be analysed: start from a coarser mesh"
    )]
    CoarseAnalysis {
        /// The number of coarse unknowns.
        unknowns: usize,
        /// The number of stored entries.
        entries: usize,
    },
    /// The operator has no Cholesky factor on its free components.
    #[error(
        "the operator is not positive definite, pivot {pivot} of {unknowns} at vertex {vertex}: a material or a viscosity is out of its range"
    )]
    IndefiniteOperator {
        /// The failing pivot in elimination order.
        pivot: usize,
        /// The number of free components.
        unknowns: usize,
        /// The vertex that the pivot belongs to.
        vertex: usize,
    },
    /// A motion of the body that deforms nothing is left free by everything that could hold it.
    #[error(
        "nothing holds the body: it moves freely at vertex {vertex}; prescribe components, or give it inertia or friction"
    )]
    Unsupported {
        /// A vertex that moves.
        vertex: usize,
    },
    /// A body that friction alone holds slides, and friction does not stop it.
    #[error(
        "friction does not hold the body: after {iterations} iterations it drifts on at vertex {vertex}, by {change:.3e} an iteration; lower the load, prescribe components, or give it inertia"
    )]
    Adrift {
        /// A vertex that moves.
        vertex: usize,
        /// Iterations spent.
        iterations: usize,
        /// The last change in the stopping norm.
        change: f64,
    },
    /// A direct solution does not solve: rounding alone made the operator's factor.
    #[error(
        "the operator is singular to rounding: {residual:e} is left of a load of {load:e}; is the body held?"
    )]
    Singular {
        /// The Euclidean norm of `r - B x` on the free components.
        residual: f64,
        /// That of `r`.
        load: f64,
    },
    /// The symbolic factorisation of the operator failed, for want of memory or index range.
    #[error(
        "the operator of {unknowns} unknowns and {entries} entries cannot be analysed: a solver without a factor (Tnnmg, MultigridSolver) may do"
    )]
    Analysis {
        /// The number of unknowns.
        unknowns: usize,
        /// The number of stored entries.
        entries: usize,
    },
    /// Operator and potential together have a direction of negative curvature.
    #[error(
        "iteration {iteration}: the energy is not convex at frictional vertex {vertex}; a smaller step may do"
    )]
    NotConvex {
        /// The vertex at which elimination meets it.
        vertex: usize,
        /// The iteration, from 1.
        iteration: usize,
    },
    /// A factorisation would take more memory than it may.
    #[error(
        "a factor of {unknowns} unknowns takes {needed} bytes or more, {allowed} are allowed: raise the limit, or take a solver without a factor (Tnnmg, MultigridSolver)"
    )]
    MemoryLimit {
        /// The number of free components.
        unknowns: usize,
        /// The memory that one factor takes at least, with what is shared by all \[byte\].
        needed: usize,
        /// The limit \[byte\].
        allowed: usize,
    },
    /// A field, mask or transfer does not fit the operator.
    #[error("{expected} vertices expected, {found} found: was it prepared for another problem?")]
    SizeMismatch {
        /// The length that fits.
        expected: usize,
        /// The length given.
        found: usize,
    },
    /// Transfers lead to another mesh than the problem's, maybe one of equal size.
    #[error("the transfers lead to mesh {found:016x}, the problem is one on mesh {expected:016x}")]
    OtherMesh {
        /// The fingerprint of the problem's mesh.
        expected: u64,
        /// That of the transfers.
        found: u64,
    },
    /// A transfer does not begin where the one before ends.
    #[error("transfer {level} begins at {columns} vertices, the one before ends at {rows}")]
    TransferMismatch {
        /// Its place in the list, from 0.
        level: usize,
        /// The rows of the one before.
        rows: usize,
        /// Its columns.
        columns: usize,
    },
    /// A weight of a transfer is infinite or not a number.
    #[error("transfer {level} has the weight {weight:e} in row {row}, column {column}")]
    TransferWeight {
        /// Its place in the list, from 0.
        level: usize,
        /// The fine vertex.
        row: usize,
        /// The coarse vertex.
        column: usize,
        /// The weight.
        weight: f64,
    },
    /// Frictional vertices are not strictly increasing or out of range.
    #[error(
        "frictional vertex {vertex} at position {position} is out of order or range: sort them"
    )]
    UnsortedVertices {
        /// Its index.
        vertex: usize,
        /// Its place in the list.
        position: usize,
    },
}

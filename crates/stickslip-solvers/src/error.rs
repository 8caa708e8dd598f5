//! Why a velocity problem was not solved.

use thiserror::Error;

use crate::MeshMismatch;

/// The ways in which a [`NonsmoothSolver`](crate::NonsmoothSolver) fails.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum SolveError {
    /// The iteration stopped before the tolerance was reached.
    #[error(
        "no minimiser after {iterations} iterations: change {change:.3e}, tolerance {tolerance:.3e}; reduce dt or use a direct solver (Condensed, Cholesky)"
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
        "NaN or infinity in iteration {iteration}: change {change:e}; check the load and the operator, whose values may be too large"
    )]
    NotFinite {
        /// The iteration, from 1.
        iteration: usize,
        /// The change in the stopping norm.
        change: f64,
    },
    /// The solver of a simulation or scene that was cloned, of a type that cannot be: see
    /// [`NonsmoothSolver::boxed_clone`](crate::NonsmoothSolver::boxed_clone).
    #[error(
        "the clone has no solver, since that of the original cannot be cloned: give it one by `set_solver`, or a scene one in equilibrium by building it again"
    )]
    NotCloned,
    /// A diagonal solver met a row with other entries than the diagonal one.
    #[error("the operator is not diagonal in the row of vertex {vertex}: use Condensed or Tnnmg")]
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
        "the operator is not positive definite: curvature {curvature:e} in iteration {iteration}; check the materials and viscosities"
    )]
    IndefiniteDirection {
        /// The iteration, from 1.
        iteration: usize,
        /// `d . B d` of the direction.
        curvature: f64,
    },
    /// A matrix has no Cholesky factor on its free components.
    #[error(
        "the {what} is not positive definite, pivot {pivot} of {unknowns} at vertex {vertex}: a material or a viscosity is out of its range; cells that differ too much for multigrid take a direct solver (Condensed, Cholesky)"
    )]
    IndefiniteMatrix {
        /// The matrix: "operator" or "coarse matrix".
        what: &'static str,
        /// The failing pivot in elimination order.
        pivot: usize,
        /// The number of free components.
        unknowns: usize,
        /// The vertex that the pivot belongs to, of the matrix's own mesh.
        vertex: usize,
    },
    /// A motion of the body that deforms nothing is left free by everything that could hold it.
    #[error(
        "the stiffness matrix is singular: a rigid-body motion is unconstrained at vertex {vertex}; fix components, or give the body inertia or friction"
    )]
    RigidBodyMode {
        /// A vertex that moves.
        vertex: usize,
    },
    /// A body that friction alone holds slides, and friction does not stop it.
    #[error(
        "load exceeds frictional resistance, no equilibrium: after {iterations} iterations vertex {vertex} still moves, by {change:.3e} per iteration; lower the load, fix components, or give the body inertia"
    )]
    NoEquilibrium {
        /// A vertex that moves.
        vertex: usize,
        /// Iterations spent.
        iterations: usize,
        /// The last change in the stopping norm.
        change: f64,
    },
    /// A direct solution does not solve: rounding alone made the operator's factor.
    #[error(
        "the operator is singular to rounding: the residual is {residual:e} for a load of {load:e}; fix components of the body"
    )]
    Singular {
        /// The Euclidean norm of `r - B x` on the free components.
        residual: f64,
        /// That of `r`.
        load: f64,
    },
    /// The symbolic factorisation of a matrix failed, for want of memory or index range.
    #[error(
        "the {what} of {unknowns} unknowns and {entries} entries cannot be analysed: take a solver without a factor (Tnnmg, MultigridSolver) or a coarser coarse mesh"
    )]
    Analysis {
        /// The matrix: "operator" or "coarse matrix".
        what: &'static str,
        /// The number of unknowns.
        unknowns: usize,
        /// The number of stored entries.
        entries: usize,
    },
    /// Operator and potential together have a direction of negative curvature.
    #[error(
        "the energy is not convex at frictional vertex {vertex} in iteration {iteration}: reduce dt"
    )]
    NotConvex {
        /// The vertex at which elimination meets it.
        vertex: usize,
        /// The iteration, from 1.
        iteration: usize,
    },
    /// A factorisation would take more memory than it may.
    #[error(
        "a factor of {unknowns} unknowns takes {needed} bytes or more, {allowed} are allowed: raise the limit, or use a solver without a factor (Tnnmg, MultigridSolver)"
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
    #[error("{expected} vertices expected, {found} found: prepare the solver for this problem")]
    SizeMismatch {
        /// The length that fits.
        expected: usize,
        /// The length given.
        found: usize,
    },
    /// The solver was made for another mesh than the problem's, maybe one of equal size.
    #[error(transparent)]
    Mesh(#[from] MeshMismatch),
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
    #[error(
        "transfer {level}: the weight in row {row}, column {column} must be finite, is {weight:e}"
    )]
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

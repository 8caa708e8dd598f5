//! Errors of a velocity problem.

use thiserror::Error;

use crate::MeshMismatch;

/// Errors of a [`NonsmoothSolver`](crate::NonsmoothSolver).
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum SolveError {
    /// The iteration stopped before the tolerance was reached.
    #[error(
        "no minimiser after {iterations} iterations: change {change:.3e}, tolerance {tolerance:.3e}; reduce dt, or use another solver"
    )]
    NotConverged {
        /// The number of iterations.
        iterations: usize,
        /// The last change in the stopping norm.
        change: f64,
        /// The requested change.
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
    /// The clone of a simulation or scene has no solver, since the type of the original cannot be cloned: see
    /// [`NonsmoothSolver::boxed_clone`](crate::NonsmoothSolver::boxed_clone).
    #[error(
        "the clone has no solver, since that of the original cannot be cloned: give it one by `set_solver`, or a scene one in equilibrium by building it again"
    )]
    NotCloned,
    /// A diagonal solver got a row with off-diagonal entries.
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
    /// Conjugate gradients found a direction of negative or zero curvature.
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
        "the {what} is not positive definite, pivot {pivot} of {unknowns} at vertex {vertex}: a material or a viscosity is out of its range, or cells differ too much for multigrid"
    )]
    IndefiniteMatrix {
        /// The matrix: "operator" or "coarse matrix".
        what: &'static str,
        /// The failing pivot in elimination order.
        pivot: usize,
        /// The number of free components.
        unknowns: usize,
        /// The vertex of the pivot, on the matrix's own mesh.
        vertex: usize,
    },
    /// A rigid-body motion is unconstrained.
    #[error(
        "the stiffness matrix is singular: a rigid-body motion is unconstrained at vertex {vertex}; fix components, or vertices of a reduced body, or give a static equilibrium friction and a motion inertia"
    )]
    RigidBodyMode {
        /// A vertex that moves.
        vertex: usize,
    },
    /// No equilibrium: the load exceeds the frictional resistance of a body supported by friction alone.
    #[error(
        "load exceeds frictional resistance, no equilibrium: after {iterations} iterations vertex {vertex} still moves, by {change:.3e} per iteration; lower the load, fix components, or give the body inertia"
    )]
    NoEquilibrium {
        /// A vertex that moves.
        vertex: usize,
        /// The number of iterations.
        iterations: usize,
        /// The last change in the stopping norm.
        change: f64,
    },
    /// A direct solution failed: the operator is singular to rounding.
    #[error(
        "the operator is singular to rounding: the residual is {residual:e} for a load of {load:e}; fix components of the body"
    )]
    Singular {
        /// The Euclidean norm of `r - B x` on the free components.
        residual: f64,
        /// The Euclidean norm of `r`.
        load: f64,
    },
    /// The symbolic factorisation of a matrix failed, for lack of memory or index range.
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
    /// The sum of operator and potential has a direction of negative curvature.
    #[error(
        "the energy is not convex at frictional vertex {vertex} in iteration {iteration}: reduce dt"
    )]
    NotConvex {
        /// The vertex where elimination found it.
        vertex: usize,
        /// The iteration, from 1.
        iteration: usize,
    },
    /// A factorisation exceeds the memory limit.
    #[error(
        "a factor of {unknowns} unknowns takes {needed} bytes or more, {allowed} are allowed: raise the limit, or use a solver without a factor (Tnnmg, MultigridSolver)"
    )]
    MemoryLimit {
        /// The number of free components.
        unknowns: usize,
        /// The least memory of one factor with the data shared by all \[byte\].
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
    /// The mesh of the solver differs from that of the problem, possibly one of equal size.
    #[error(transparent)]
    Mesh(#[from] MeshMismatch),
    /// A transfer does not start at the level where the one before ends.
    #[error("transfer {level} begins at {columns} vertices, the one before ends at {rows}")]
    TransferMismatch {
        /// Its position in the list, from 0.
        level: usize,
        /// The number of rows of the one before.
        rows: usize,
        /// Its number of columns.
        columns: usize,
    },
    /// A weight of a transfer is infinite or NaN.
    #[error(
        "transfer {level}: the weight in row {row}, column {column} must be finite, is {weight:e}"
    )]
    TransferWeight {
        /// Its position in the list, from 0.
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
        /// Its position in the list.
        position: usize,
    },
}

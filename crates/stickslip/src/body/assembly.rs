//! The matrix of a step, and the solver of its velocity problem.

use nalgebra::{SMatrix, SVector};
use stickslip_solvers::{
    Basis, Counters, Energy, Matrix, MeshId, Potentials, SolveError, SolveReport, Stopping,
};

use super::any_solver::AnySolver;
use crate::SceneError;

/// A velocity problem beside its matrix: load, friction and fixed components.
#[derive(Clone, Copy)]
pub(crate) struct Boundary<'a, const C: usize> {
    pub(crate) load: &'a [SVector<f64, C>],
    pub(crate) potentials: &'a dyn Potentials<C>,
    /// The frictional vertices.
    pub(crate) vertices: &'a [usize],
    pub(crate) fixed: &'a [[bool; C]],
}

impl<'a, const C: usize> Boundary<'a, C> {
    pub(super) fn with<Op>(self, operator: &'a Op) -> Energy<'a, Op, C> {
        Energy {
            operator,
            load: self.load,
            potentials: self.potentials,
            vertices: self.vertices,
            fixed: self.fixed,
        }
    }
}

/// The accuracy of a solution, see [`Stopping`].
#[derive(Clone, Copy)]
pub(crate) struct Goal {
    pub(crate) tolerance: f64,
    pub(crate) relative: f64,
    pub(crate) equivalence: f64,
    pub(crate) max_iterations: usize,
}

impl Goal {
    pub(super) fn in_norm<Op>(self, norm: &Op) -> Stopping<'_, Op> {
        Stopping {
            norm,
            tolerance: self.tolerance,
            relative: self.relative,
            equivalence: self.equivalence,
            max_iterations: self.max_iterations,
        }
    }
}

/// What an explicit step needs to solve for the vertices without friction itself, see
/// [`FreeVertices`](stickslip_solvers::FreeVertices).
#[derive(Clone, Copy)]
pub(crate) struct Free<'a, const C: usize> {
    /// The diagonals of the inverse blocks of all vertices [m/(N s)].
    pub(crate) compliances: &'a [SVector<f64, C>],
    /// The vertices that are not free, increasing.
    pub(crate) others: &'a [usize],
}

/// The matrix `B = c_a M + C + c_u A` of a step, the norm of the coupling, and the solver: the only code that is written
/// per format of a matrix.
pub(crate) trait Body<const C: usize>: Send {
    /// `B`.
    fn step(&self) -> &dyn Matrix<C>;

    /// The matrix of the norm for velocity changes.
    fn norm(&self) -> &dyn Matrix<C>;

    /// Whether the norm has a matrix of its own.
    fn has_norm(&self) -> bool;

    /// Allocates `B` for an implicit or an explicit scheme, which leaves out the stiffness; drops the norm.
    fn allocate(&mut self, implicit: bool);

    /// Makes `A + M` the norm; `M` alone in an explicit scheme.
    fn measure_absolutely(&mut self, implicit: bool);

    /// Adds blocks at vertices to the norm, which is the stiffness if it has no matrix of its own.
    fn add_to_norm(&mut self, blocks: &mut dyn Iterator<Item = (usize, SMatrix<f64, C, C>)>);

    /// Combines `B` for `c_u` and `c_a`; without the stiffness and the lagged viscosities in an explicit scheme.
    fn combine(&mut self, implicit: bool, factors: (f64, f64));

    /// Adds numbers on the diagonal of `B` at vertices, until it is combined again.
    fn add_to_diagonal(&mut self, vertices: &[usize], added: &[f64]);

    /// Prepares the solver for `B`.
    fn prepare(&mut self, problem: &Boundary<'_, C>) -> Result<(), SolveError>;

    /// Whether the solver condenses a load once for several problems, see
    /// [`FrictionalSolver`](stickslip_solvers::FrictionalSolver).
    fn condenses(&mut self) -> bool;

    /// Condenses a load, if the solver does so.
    fn condense(
        &mut self,
        problem: &Boundary<'_, C>,
        v: &[SVector<f64, C>],
    ) -> Result<(), SolveError>;

    /// Prepares for measured changes, if the solver can.
    fn measure(&mut self, problem: &Boundary<'_, C>);

    /// Moves `v` to the minimiser; of a solver that condenses, at the frictional vertices.
    fn minimize(
        &mut self,
        problem: &Boundary<'_, C>,
        goal: Goal,
        v: &mut [SVector<f64, C>],
    ) -> Result<SolveReport, SolveError>;

    /// The vertices that an explicit step solves for itself, of a prepared solver.
    fn free_vertices(&mut self) -> Option<Free<'_, C>>;

    /// Moves `v` to the minimiser at the vertices that are not free.
    fn minimize_others(
        &mut self,
        problem: &Boundary<'_, C>,
        goal: Goal,
        v: &mut [SVector<f64, C>],
    ) -> Result<SolveReport, SolveError>;

    /// The norm of a change of the velocity.
    fn change_norm(
        &mut self,
        problem: &Boundary<'_, C>,
        change: &[SVector<f64, C>],
    ) -> Result<f64, SolveError>;

    /// Moves the interior after the frictional vertices, if the solver condenses.
    fn extend(&mut self, v: &mut [SVector<f64, C>]) -> Result<(), SolveError>;

    /// Whether `B` stays positive definite with slopes added at the frictional vertices; `None` if the solver cannot tell. In
    /// several processes, with the rows of this one.
    fn is_definite_with(&mut self, slopes: &[f64]) -> Option<bool>;

    /// Replaces the solver.
    fn set_solver(&mut self, solver: AnySolver) -> Result<(), SceneError>;

    /// Changes the solver to the unknowns of a basis.
    fn change_basis(&mut self, basis: &Basis<C>);

    /// The mesh of the solver.
    fn mesh(&self) -> Option<MeshId>;

    /// The work of the solver.
    fn counters(&self) -> Counters;

    /// A body with the same matrices; its solver has to be prepared.
    fn boxed_clone(&self) -> Box<dyn Body<C>>;
}

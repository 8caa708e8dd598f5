//! The matrix of a step, and the solver of its velocity problem.

use std::sync::Arc;

use nalgebra::{SMatrix, SVector};
use stickslip_solvers::{
    Basis, Counters, Energy, Matrix, MeshId, NonsmoothSolver, Operator, Potentials, SolveError,
    SolveReport, Stopping,
};

use super::AnySolver;
use super::formatted::Formatted;
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
    fn with<Op>(self, operator: &'a Op) -> Energy<'a, Op, C> {
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

    /// The norm of a change of the velocity.
    fn change_norm(
        &mut self,
        problem: &Boundary<'_, C>,
        change: &[SVector<f64, C>],
    ) -> Result<f64, SolveError>;

    /// Moves the interior after the frictional vertices, if the solver condenses.
    fn extend(&mut self, v: &mut [SVector<f64, C>]) -> Result<(), SolveError>;

    /// Whether `B` stays positive definite with slopes added at the frictional vertices; `None` if the solver does not
    /// condense.
    fn is_condensed_definite_with(&mut self, slopes: &[f64]) -> Option<bool>;

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

/// The body of matrices in one format.
pub(super) struct OperatorBody<Op: Operator<C>, const C: usize> {
    matrices: Arc<Formatted<Op, C>>,
    step: Op,
    norm: Option<Op>,
    solver: Box<dyn NonsmoothSolver<Op, C>>,
}

impl<Op: Operator<C>, const C: usize> OperatorBody<Op, C> {
    /// A body for an implicit or an explicit scheme.
    pub(super) fn new(
        matrices: Arc<Formatted<Op, C>>,
        solver: AnySolver,
        implicit: bool,
    ) -> Result<Self, SceneError> {
        Ok(Self {
            step: step_of(&matrices, implicit),
            norm: None,
            solver: solver.of()?,
            matrices,
        })
    }

    fn norm_or_step(&self) -> &Op {
        self.norm.as_ref().unwrap_or(&self.step)
    }
}

/// `M + C + A`, without the stiffness in an explicit scheme.
fn step_of<Op: Operator<C>, const C: usize>(matrices: &Formatted<Op, C>, implicit: bool) -> Op {
    let stiffness = implicit.then_some((1.0, matrices.energy()));
    let viscosity = matrices.prompt(implicit).map(|own| (1.0, own));
    let terms: Vec<_> = stiffness.into_iter().chain(viscosity).collect();
    let mass = matrices.mass.as_ref().map(|mass| (1.0, mass));
    Op::combination_with(&terms, mass)
}

impl<Op: Operator<C>, const C: usize> Body<C> for OperatorBody<Op, C> {
    fn step(&self) -> &dyn Matrix<C> {
        &self.step
    }

    fn norm(&self) -> &dyn Matrix<C> {
        self.norm_or_step()
    }

    fn has_norm(&self) -> bool {
        self.norm.is_some()
    }

    fn allocate(&mut self, implicit: bool) {
        self.step = step_of(&self.matrices, implicit);
        self.norm = None;
    }

    fn measure_absolutely(&mut self, implicit: bool) {
        let stiffness = implicit.then_some((1.0, self.matrices.energy()));
        let mass = self.matrices.mass.as_ref().map(|mass| (1.0, mass));
        self.norm = Some(Op::combination_with(stiffness.as_slice(), mass));
    }

    fn add_to_norm(&mut self, blocks: &mut dyn Iterator<Item = (usize, SMatrix<f64, C, C>)>) {
        let norm = self
            .norm
            .get_or_insert_with(|| Op::combination(&[(1.0, self.matrices.energy())]));
        for (vertex, block) in blocks {
            norm.add_to_diagonal(vertex, &block);
        }
    }

    fn combine(&mut self, implicit: bool, (c_u, c_a): (f64, f64)) {
        let stiffness = (c_u, self.matrices.energy());
        let mass = self.matrices.mass.as_ref().map(|mass| (c_a, mass));
        let viscosity = self.matrices.prompt(implicit).map(|own| (1.0, own));
        match (implicit, viscosity) {
            (true, None) => self.step.set_combination_with(&[stiffness], mass),
            (true, Some(viscosity)) => {
                self.step
                    .set_combination_with(&[stiffness, viscosity], mass);
            }
            (false, viscosity) => self.step.set_combination_with(viscosity.as_slice(), mass),
        }
    }

    fn add_to_diagonal(&mut self, vertices: &[usize], added: &[f64]) {
        for (&vertex, &added) in vertices.iter().zip(added) {
            let block = SMatrix::from_diagonal_element(added);
            self.step.add_to_diagonal(vertex, &block);
        }
    }

    fn prepare(&mut self, problem: &Boundary<'_, C>) -> Result<(), SolveError> {
        self.solver.prepare(&problem.with(&self.step))
    }

    fn condenses(&mut self) -> bool {
        self.solver.frictional().is_some()
    }

    fn condense(
        &mut self,
        problem: &Boundary<'_, C>,
        v: &[SVector<f64, C>],
    ) -> Result<(), SolveError> {
        let frictional = self.solver.frictional();
        frictional.map_or(Ok(()), |solver| {
            solver.condense(&problem.with(&self.step), v)
        })
    }

    fn measure(&mut self, problem: &Boundary<'_, C>) {
        if let Some(solver) = self.solver.frictional() {
            let norm = self.norm.as_ref().unwrap_or(&self.step);
            solver.measure(&problem.with(&self.step), norm);
        }
    }

    fn minimize(
        &mut self,
        problem: &Boundary<'_, C>,
        goal: Goal,
        v: &mut [SVector<f64, C>],
    ) -> Result<SolveReport, SolveError> {
        let stopping = Stopping {
            norm: self.norm.as_ref().unwrap_or(&self.step),
            tolerance: goal.tolerance,
            relative: goal.relative,
            equivalence: goal.equivalence,
            max_iterations: goal.max_iterations,
        };
        let energy = problem.with(&self.step);
        match self.solver.frictional() {
            None => self.solver.minimize(&energy, &stopping, v),
            Some(solver) => solver.minimize_condensed(&energy, &stopping, v),
        }
    }

    fn change_norm(
        &mut self,
        problem: &Boundary<'_, C>,
        change: &[SVector<f64, C>],
    ) -> Result<f64, SolveError> {
        let norm = self.norm.as_ref().unwrap_or(&self.step);
        match self.solver.frictional() {
            None => Ok(norm.norm(change)),
            Some(solver) => solver.change_norm(&problem.with(&self.step), norm, change),
        }
    }

    fn extend(&mut self, v: &mut [SVector<f64, C>]) -> Result<(), SolveError> {
        let frictional = self.solver.frictional();
        frictional.map_or(Ok(()), |solver| solver.extend(v))
    }

    fn is_condensed_definite_with(&mut self, slopes: &[f64]) -> Option<bool> {
        let solver = self.solver.frictional()?;
        Some(solver.is_definite_with(slopes))
    }

    fn set_solver(&mut self, solver: AnySolver) -> Result<(), SceneError> {
        self.solver = solver.of()?;
        Ok(())
    }

    fn change_basis(&mut self, basis: &Basis<C>) {
        self.solver.change_basis(basis);
    }

    fn mesh(&self) -> Option<MeshId> {
        self.solver.mesh()
    }

    fn counters(&self) -> Counters {
        self.solver.counters()
    }

    fn boxed_clone(&self) -> Box<dyn Body<C>> {
        let copy = |own: &Op| Op::combination(&[(1.0, own)]);
        Box::new(Self {
            matrices: Arc::clone(&self.matrices),
            step: copy(&self.step),
            norm: self.norm.as_ref().map(copy),
            solver: self.solver.boxed_clone(),
        })
    }
}

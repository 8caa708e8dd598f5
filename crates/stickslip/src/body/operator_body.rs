//! The body of matrices in one format.

use std::sync::Arc;

use nalgebra::{SMatrix, SVector};
use stickslip_solvers::{
    Basis, Counters, Matrix, MeshId, NonsmoothSolver, Operator, SolveError, SolveReport,
};

use super::any_solver::AnySolver;
use super::assembly::{Body, Boundary, Free, Goal};
use super::formatted::Formatted;
use crate::SceneError;

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
        let stopping = goal.in_norm(self.norm.as_ref().unwrap_or(&self.step));
        let energy = problem.with(&self.step);
        match self.solver.frictional() {
            None => self.solver.minimize(&energy, &stopping, v),
            Some(solver) => solver.minimize_condensed(&energy, &stopping, v),
        }
    }

    fn free_vertices(&mut self) -> Option<Free<'_, C>> {
        let solver = self.solver.free_vertices()?;
        Some(Free {
            compliances: solver.compliances(),
            others: solver.others(),
        })
    }

    fn minimize_others(
        &mut self,
        problem: &Boundary<'_, C>,
        goal: Goal,
        v: &mut [SVector<f64, C>],
    ) -> Result<SolveReport, SolveError> {
        let stopping = goal.in_norm(self.norm.as_ref().unwrap_or(&self.step));
        let energy = problem.with(&self.step);
        match self.solver.free_vertices() {
            None => self.solver.minimize(&energy, &stopping, v),
            Some(solver) => solver.minimize_others(&energy, &stopping, v),
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

    fn is_definite_with(&mut self, slopes: &[f64]) -> Option<bool> {
        self.solver.is_definite_with(slopes)
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

//! The matrices of a scene in one format.

use std::sync::Arc;

use nalgebra::SVector;
use stickslip_solvers::{Basis, LinearSolver, Matrix, MeshId, Operator, SolveError};

use super::any_solver::AnySolver;
use super::assembly::Body;
use super::matrices::Matrices;
use super::operator_body::OperatorBody;
use super::viscosity::Lagged;
use crate::SceneError;
use crate::scene::{MASS, STIFFNESS, VISCOSITY};

/// The matrices of a scene, and the solver for its initial equilibrium.
pub(crate) struct Formatted<Op: Operator<C>, const C: usize> {
    pub(super) stiffness: Op,
    pub(super) symmetric_part: Option<Op>,
    pub(super) mass: Option<Op::Mass>,
    /// The viscosities one by one, and their sum if there are several.
    pub(super) viscosities: Vec<Op>,
    pub(super) viscosity: Option<Op>,
    /// The viscosities that lag in explicit steps.
    pub(super) lagged: Option<Lagged<Op>>,
    pub(super) equilibrium: Option<EquilibriumSolver<Op, C>>,
}

/// The solver for the initial equilibrium, which one thread uses.
pub(super) struct EquilibriumSolver<Op, const C: usize> {
    pub(super) mesh: Option<MeshId>,
    pub(super) solver: std::sync::Mutex<Box<dyn LinearSolver<Op, C>>>,
}

impl<Op: Operator<C>, const C: usize> Formatted<Op, C> {
    /// `A` of the elastic energy, in its format.
    pub(super) fn energy(&self) -> &Op {
        self.symmetric_part.as_ref().unwrap_or(&self.stiffness)
    }

    /// The sum of all viscosities, in their format.
    pub(super) fn sum(&self) -> Option<&Op> {
        self.viscosity.as_ref().or(self.viscosities.first())
    }

    /// The viscosity that is part of the matrix of a step, in its format.
    pub(super) fn prompt(&self, implicit: bool) -> Option<&Op> {
        match &self.lagged {
            Some(lagged) if !implicit => lagged.prompt.as_ref(),
            _ => self.sum(),
        }
    }
}

fn plain<M: Matrix<C>, const C: usize>(matrix: Option<&M>) -> Option<&dyn Matrix<C>> {
    matrix.map(|matrix| matrix as &dyn Matrix<C>)
}

impl<Op: Operator<C>, const C: usize> Matrices<C> for Formatted<Op, C> {
    fn stiffness(&self) -> &dyn Matrix<C> {
        &self.stiffness
    }

    fn symmetric_part(&self) -> Option<&dyn Matrix<C>> {
        plain(self.symmetric_part.as_ref())
    }

    fn mass(&self) -> Option<&dyn Matrix<C>> {
        plain(self.mass.as_ref())
    }

    fn viscosity(&self) -> Option<&dyn Matrix<C>> {
        plain(self.sum())
    }

    fn viscosity_at(&self, number: usize) -> Option<&dyn Matrix<C>> {
        plain(self.viscosities.get(number))
    }

    fn relaxation(&self) -> Option<f64> {
        self.lagged.as_ref().and_then(|lagged| lagged.relaxation)
    }

    fn lagged(&self) -> &[usize] {
        self.lagged.as_ref().map_or(&[], |lagged| &lagged.places)
    }

    fn prompt_viscosity(&self, implicit: bool) -> Option<&dyn Matrix<C>> {
        plain(self.prompt(implicit))
    }

    fn find_energy(&mut self, asymmetric: Option<&SceneError>) -> Result<(), SceneError> {
        let Some(asymmetric) = asymmetric else {
            return Ok(());
        };
        if self.mass.is_none() && self.equilibrium.is_none() {
            self.symmetric_part = self.stiffness.symmetric_part();
        }
        match self.symmetric_part {
            Some(_) => Ok(()),
            None => Err(asymmetric.clone()),
        }
    }

    fn sum_viscosities(&mut self) {
        self.lagged = self.find_lagged();
        if self.viscosities.len() > 1 {
            let terms: Vec<_> = self.viscosities.iter().map(|term| (1.0, term)).collect();
            self.viscosity = Some(Op::combination(&terms));
        }
    }

    fn change_basis(&mut self, basis: &Basis<C>, turned: bool) -> Result<(), SceneError> {
        if let Some(equilibrium) = &mut self.equilibrium {
            equilibrium.own().change_basis(basis);
        }
        if turned {
            return Ok(());
        }
        let changed =
            |what, changed: bool| changed.then_some(()).ok_or(SceneError::NoBasis { what });
        for stiffness in std::iter::once(&mut self.stiffness).chain(&mut self.symmetric_part) {
            changed(STIFFNESS, stiffness.change_basis(basis))?;
        }
        if let Some(mass) = &mut self.mass {
            changed(MASS, mass.change_basis(basis))?;
        }
        let prompt = self.lagged.iter_mut().flat_map(|lagged| &mut lagged.prompt);
        let viscosities = self.viscosities.iter_mut().chain(&mut self.viscosity);
        for viscosity in viscosities.chain(prompt) {
            changed(VISCOSITY, viscosity.change_basis(basis))?;
        }
        Ok(())
    }

    fn starts_in_equilibrium(&self) -> bool {
        self.equilibrium.is_some()
    }

    fn mesh_of_equilibrium(&self) -> Option<MeshId> {
        self.equilibrium.as_ref().and_then(|own| own.mesh)
    }

    fn solve_equilibrium(
        &mut self,
        fixed: &[[bool; C]],
        load: &[SVector<f64, C>],
        displacement: &mut [SVector<f64, C>],
    ) -> Result<(), SolveError> {
        let Some(equilibrium) = &mut self.equilibrium else {
            return Ok(());
        };
        let solver = equilibrium.own();
        solver.prepare(&self.stiffness, fixed)?;
        solver.solve(&self.stiffness, load, displacement)
    }

    fn into_body(
        mut self: Box<Self>,
        solver: AnySolver,
        implicit: bool,
    ) -> Result<(Arc<dyn Matrices<C>>, Box<dyn Body<C>>), SceneError> {
        if implicit && !Op::has_rows() {
            return Err(SceneError::unsupported(
                SceneError::IMPLICIT,
                "the rows of the stiffness: assemble it by `elasticity`, or take CentralDifferences",
            ));
        }
        self.equilibrium = None;
        let matrices = Arc::new(*self);
        let body = OperatorBody::new(Arc::clone(&matrices), solver, implicit)?;
        Ok((matrices, Box::new(body)))
    }
}

impl<Op, const C: usize> EquilibriumSolver<Op, C> {
    fn own(&mut self) -> &mut dyn LinearSolver<Op, C> {
        let solver = self.solver.get_mut();
        &mut **solver.unwrap_or_else(std::sync::PoisonError::into_inner)
    }
}

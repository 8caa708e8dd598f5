//! The change of a scene to the basis of its surfaces.

use std::iter;

use stickslip_solvers::{Basis, LinearSolver, Operator};

use crate::scene::{Initial, MASS, STIFFNESS, VISCOSITY};
use crate::{Scene, SceneError};

impl<Op: Operator<C>, const C: usize> Scene<Op, C> {
    /// Changes operators and initial conditions to the unknowns of a basis.
    pub(crate) fn change_basis(&mut self, basis: &Basis<C>) -> Result<(), SceneError> {
        // Of several processes all change the operators, or none.
        if !self.stiffness.ranks().any(!basis.is_empty()) {
            return Ok(());
        }
        if !self.turned {
            let changed =
                |what, changed: bool| changed.then_some(()).ok_or(SceneError::NoBasis { what });
            for stiffness in iter::once(&mut self.stiffness).chain(&mut self.symmetric_part) {
                changed(STIFFNESS, stiffness.change_basis(basis))?;
            }
            if let Some(mass) = &mut self.mass {
                changed(MASS, mass.change_basis(basis))?;
            }
            let prompt = self.lagged.iter_mut().flat_map(|lagged| &mut lagged.prompt);
            let viscosities = self.viscosity.iter_mut().chain(&mut self.viscosities);
            for viscosity in viscosities.chain(prompt) {
                changed(VISCOSITY, viscosity.change_basis(basis))?;
            }
        }
        let Initial {
            equilibrium,
            displacement,
            velocity,
            acceleration,
            ..
        } = &mut self.initial;
        if let Some(solver) = equilibrium {
            solver.change_basis(basis);
        }
        for field in [displacement, velocity, acceleration] {
            if !field.is_empty() {
                basis.field_to_basis(field);
            }
        }
        Ok(())
    }
}

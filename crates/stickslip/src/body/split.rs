//! A scene as its matrices, in their format, and the rest, without it.

use std::sync::Mutex;

use stickslip_solvers::Operator;

use super::formatted::{EquilibriumSolver, Formatted};
use super::matrices::Matrices;
use crate::Scene;
use crate::scene::Conditions;

impl<Op: Operator<C>, const C: usize> Scene<Op, C> {
    /// The matrices, and all else.
    pub(crate) fn split(self) -> (Box<dyn Matrices<C>>, Conditions<C>) {
        let matrices = Formatted {
            stiffness: self.stiffness,
            symmetric_part: None,
            mass: self.mass,
            viscosities: self.viscosity,
            viscosity: None,
            lagged: None,
            equilibrium: self.equilibrium.map(|solver| EquilibriumSolver {
                mesh: solver.mesh(),
                solver: Mutex::new(solver),
            }),
        };
        (Box::new(matrices), self.conditions)
    }
}

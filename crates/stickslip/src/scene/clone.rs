//! Copies of a scene.

use stickslip_solvers::Operator;

use super::Scene;

/// Matrices and fields are copied, laws and functions of time are shared. A solver of
/// [`in_equilibrium`](Scene::in_equilibrium) of a type that cannot be cloned is missing in the clone; the construction
/// of a simulation then refuses the clone.
impl<Op, const C: usize> Clone for Scene<Op, C>
where
    Op: Operator<C, Mass: Clone> + Clone,
{
    fn clone(&self) -> Self {
        Self {
            stiffness: self.stiffness.clone(),
            mass: self.mass.clone(),
            viscosity: self.viscosity.clone(),
            equilibrium: self.equilibrium.as_ref().map(|solver| solver.boxed_clone()),
            conditions: self.conditions.clone(),
        }
    }
}

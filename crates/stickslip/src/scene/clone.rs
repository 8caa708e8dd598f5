//! Copies of a scene.

use stickslip_solvers::Operator;

use super::{Initial, Scene};

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
            viscosities: self.viscosities.clone(),
            lagged: self.lagged.clone(),
            loads: self.loads.clone(),
            contacts: self.contacts.clone(),
            prescribed: self.prescribed.clone(),
            periodic: self.periodic.clone(),
            initial: self.initial.clone(),
            clamping: self.clamping.clone(),
            mesh: self.mesh,
            assembled: self.assembled.clone(),
            walls: self.walls.clone(),
            open_walls: self.open_walls,
            turned: self.turned,
            wrong: self.wrong.clone(),
            asymmetric: self.asymmetric.clone(),
            symmetric_part: self.symmetric_part.clone(),
        }
    }
}

impl<Op, const C: usize> Clone for Initial<Op, C> {
    fn clone(&self) -> Self {
        Self {
            time: self.time,
            equilibrium: self.equilibrium.as_ref().map(|solver| solver.boxed_clone()),
            displacement: self.displacement.clone(),
            balanced: self.balanced,
            velocity: self.velocity.clone(),
            acceleration: self.acceleration.clone(),
        }
    }
}

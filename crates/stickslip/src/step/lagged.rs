//! The force of viscosities that couple vertices, in explicit steps.

use super::{Problem, Workspace};
use crate::StepState;

impl<const C: usize> Workspace<C> {
    /// Subtracts the force of the lagged viscosities from the load, at the mean velocity of a step of `dt` \[s\]: in an
    /// explicit scheme the new displacement is known, `v_o + dt/2 a_o = (u - u_o)/dt`.
    pub(super) fn subtract_lagged(&mut self, p: &Problem<C>, start: &StepState<C>, dt: f64) {
        if self.operators.implicit || self.mean_velocity.is_empty() {
            return;
        }
        let ends = self.end.displacement.iter().zip(&start.displacement);
        for (mean, (new, old)) in self.mean_velocity.iter_mut().zip(ends) {
            *mean = (new - old) / dt;
        }
        for viscosity in p.matrices.lagged_viscosities() {
            viscosity.multiply_add(-1.0, &self.mean_velocity, &mut self.load);
        }
    }
}

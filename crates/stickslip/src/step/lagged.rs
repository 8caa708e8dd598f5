//! The elastic force, and that of viscosities that couple vertices in explicit steps.

use super::free::seen;
use super::local_steps::weights_after;
use super::{Problem, Workspace};
use crate::StepState;

impl<const C: usize> Workspace<C> {
    /// Subtracts the elastic force from the load; in explicit steps with lagged viscosities of `eta` times the stiffness their
    /// force, too, by the same product: `A (u + eta (u - u_o)/dt)` in a step of `dt` \[s\].
    pub(super) fn subtract_elastic(&mut self, p: &Problem<C>, start: &StepState<C>, dt: f64) {
        let share = self.relaxation_share(p, dt);
        let seen = seen(
            &self.end.displacement,
            start,
            &mut self.mean_velocity,
            share,
        );
        let weights = weights_after(start.clock.step() + 1);
        let stiffness = p.matrices.stiffness();
        stiffness.multiply_add_levels(&weights, -1.0, seen, &mut self.load);
    }

    /// Subtracts the force of the lagged viscosities from the load, at the mean velocity of a step of `dt` \[s\]: in an
    /// explicit scheme the new displacement is known, `v_o + dt/2 a_o = (u - u_o)/dt`.
    pub(super) fn subtract_lagged(&mut self, p: &Problem<C>, start: &StepState<C>, dt: f64) {
        if !self.lags() || p.matrices.relaxation().is_some() {
            return;
        }
        let ends = self.end.displacement.iter().zip(&start.displacement);
        for (mean, (new, old)) in self.mean_velocity.iter_mut().zip(ends) {
            *mean = (new - old) / dt;
        }
        let weights = weights_after(start.clock.step() + 1);
        for viscosity in p.matrices.lagged_viscosities() {
            viscosity.multiply_add_levels(&weights, -1.0, &self.mean_velocity, &mut self.load);
        }
    }

    /// The relaxation time of lagged viscosities of which it is known, in steps of `dt` \[s\].
    pub(super) fn relaxation_share(&self, p: &Problem<C>, dt: f64) -> Option<f64> {
        let relaxation = p.matrices.relaxation().filter(|_| self.lags());
        relaxation.map(|relaxation| relaxation / dt)
    }

    /// Whether viscosities lag in the steps of the scheme.
    pub(super) fn lags(&self) -> bool {
        !self.operators.implicit && !self.mean_velocity.is_empty()
    }
}

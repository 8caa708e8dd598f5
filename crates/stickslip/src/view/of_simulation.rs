//! The last step of a simulation, as views read it.

use super::{GlobalFields, StepView};
use crate::body::Matrices;
use crate::contact::ContactSet;
use crate::placement::Constraints;
use crate::scene::Loads;
use crate::step::{Span, has_inertia, weights_after};
use crate::{Simulation, StepState};
use nalgebra::SVector;
use stickslip_solvers::MeshId;

impl<const C: usize> StepView<C> for Simulation<C> {
    fn state(&self) -> &StepState<C> {
        &self.state
    }

    fn contacts(&self) -> &ContactSet<C> {
        &self.work.contacts
    }

    fn loads(&self) -> &Loads<C> {
        &self.problem.loads
    }

    fn constraints(&self) -> &Constraints<C> {
        &self.problem.constraints
    }

    fn matrices(&self) -> &dyn Matrices<C> {
        &*self.problem.matrices
    }

    fn mesh(&self) -> Option<MeshId> {
        self.problem.mesh
    }

    fn fields(&self) -> &GlobalFields<C> {
        &self.fields
    }

    fn lag(&self) -> f64 {
        if self.work.operators.implicit || !self.problem.matrices.any_lags() {
            0.0
        } else {
            0.5 * self.state.last_step
        }
    }

    fn data_time(&self) -> f64 {
        Span::seen(&self.state.clock, &self.problem.stops)
    }

    fn diagonal_stiffness(&self, vertex: usize) -> f64 {
        let (p, w) = (&self.problem, &self.work);
        if self.state.last_step == 0.0 {
            // The velocity is given.
            return f64::INFINITY;
        }
        let formula = p.method.scheme.update_formula(self.state.last_step);
        let factors = (
            formula.displacement.new_velocity,
            formula.acceleration.new_velocity,
        );
        let block = w.operators.block(&*p.matrices, factors, vertex);
        block.diagonal().max()
    }

    fn unbalanced_at(&self, vertices: &[usize], forces: &mut [SVector<f64, C>]) {
        let (w, state) = (&self.work, &self.state);
        if w.balanced == Some(state.clock) {
            // `r - B v` is the same with fewer products, and differs from friction by what the solver left.
            for (force, &vertex) in forces.iter_mut().zip(vertices) {
                let product = w.operators.step().product_at(vertex, &state.velocity);
                *force = w.load[vertex] - product;
            }
            return;
        }
        self.left_at(vertices, forces);
    }

    fn work_share(&self) -> f64 {
        let (scheme, report) = (&self.problem.method.scheme, &self.state.report);
        let single = scheme.properties().stages.len() == 1;
        let implicit = report.damped || single && scheme.update_formula(1.0).is_implicit_euler();
        if has_inertia(&**scheme) && implicit {
            1.0
        } else {
            0.5
        }
    }

    fn unbalanced_behind_impact(&self, vertices: &[usize], forces: &mut [SVector<f64, C>]) {
        if self.work.impact {
            self.left_at(vertices, forces);
        }
    }
}

impl<const C: usize> Simulation<C> {
    /// `l - M a - C v - A u` at some vertices, by its products \[N\].
    fn left_at(&self, vertices: &[usize], forces: &mut [SVector<f64, C>]) {
        let (p, state) = (&self.problem, &self.state);
        let load = self.applied_load();
        if p.matrices.stiffness().levels() > 1 {
            self.left_in_cycle(load, vertices, forces);
            return;
        }
        for (force, &vertex) in forces.iter_mut().zip(vertices) {
            let stiffness = p.matrices.stiffness();
            let mut left = load[vertex] - stiffness.product_at(vertex, &state.displacement);
            if let Some(mass) = p.matrices.mass() {
                left -= mass.product_at(vertex, &state.acceleration);
            }
            if let Some(viscosity) = p.matrices.viscosity() {
                left -= viscosity.product_at(vertex, &state.velocity);
            }
            let lag = self.lag();
            if lag > 0.0 {
                for viscosity in p.matrices.lagged_viscosities() {
                    left += viscosity.product_at(vertex, &state.acceleration) * lag;
                }
            }
            *force = left;
        }
    }

    /// The same with the forces that act after the steps of a cycle of local steps.
    fn left_in_cycle(
        &self,
        load: &[SVector<f64, C>],
        vertices: &[usize],
        forces: &mut [SVector<f64, C>],
    ) {
        let (matrices, state) = (&self.problem.matrices, &self.state);
        let weights = weights_after(state.clock.step());
        let mut left = load.to_vec();
        let (u, v, a) = (&state.displacement, &state.velocity, &state.acceleration);
        (matrices.stiffness()).multiply_add_levels(&weights, -1.0, u, &mut left);
        if let Some(mass) = matrices.mass() {
            mass.multiply_add(-1.0, a, &mut left);
        }
        if let Some(viscosity) = matrices.viscosity() {
            viscosity.multiply_add_levels(&weights, -1.0, v, &mut left);
        }
        let lag = self.lag();
        if lag > 0.0 {
            for viscosity in matrices.lagged_viscosities() {
                viscosity.multiply_add_levels(&weights, lag, a, &mut left);
            }
        }
        for (force, &vertex) in forces.iter_mut().zip(vertices) {
            *force = left[vertex];
        }
    }
}

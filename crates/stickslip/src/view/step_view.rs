//! The source of a snapshot.

use nalgebra::SVector;
use stickslip_solvers::Operator;

use super::GlobalFields;
use crate::contact::ContactSet;
use crate::scene::{Constraints, Loads, Matrices};
use crate::step::{Span, has_inertia};
use crate::{Simulation, StepState};

/// The data from which a snapshot is taken.
pub(crate) trait StepView<const C: usize> {
    fn state(&self) -> &StepState<C>;

    fn contacts(&self) -> &ContactSet<C>;

    fn loads(&self) -> &Loads<C>;

    fn constraints(&self) -> &Constraints<C>;

    fn matrices(&self) -> &dyn Matrices<C>;

    /// The fields in coordinates; without local axes and links they are those of the state.
    fn fields(&self) -> &GlobalFields<C>;

    /// The time at which its data were evaluated: on the left side of a stop \[s\].
    fn data_time(&self) -> f64;

    /// How long before its end the last step saw the velocity of lagged viscosities \[s\]: they resist `v - lag a`.
    fn lag(&self) -> f64 {
        0.0
    }

    /// The change of the force on a vertex per change of its velocity [N s/m].
    fn diagonal_stiffness(&self, vertex: usize) -> f64;

    /// `l - M a - C v - A u` at each of `vertices`: the forces in balance with friction and reactions \[N\].
    fn unbalanced_at(&self, vertices: &[usize], forces: &mut [SVector<f64, C>]);

    /// The same at one vertex.
    fn unbalanced(&self, vertex: usize) -> SVector<f64, C> {
        let mut force = [SVector::zeros()];
        self.unbalanced_at(&[vertex], &mut force);
        force[0]
    }

    /// The share of the force at the end of the last step in the mean force that did its work.
    fn work_share(&self) -> f64 {
        0.5
    }

    /// The forces of [`unbalanced_at`](Self::unbalanced_at) from which the next step starts, if an impact parts both.
    fn unbalanced_behind_impact(&self, _vertices: &[usize], _forces: &mut [SVector<f64, C>]) {}

    /// Rotates a vector at a vertex from its local frame to coordinates.
    fn to_coordinates(&self, vertex: usize, vector: SVector<f64, C>) -> SVector<f64, C> {
        self.fields().basis().axes.to_coordinates(vertex, vector)
    }

    /// Whether a component has a Dirichlet condition.
    fn is_fixed(&self, vertex: usize, component: usize) -> bool {
        self.constraints().fixed[vertex][component]
    }

    /// Whether a component has a prescribed velocity.
    fn is_moved(&self, vertex: usize, component: usize) -> bool {
        self.constraints().is_moved(vertex, component)
    }

    /// Kinetic and elastic energy, `v . M v / 2` and `u . A u / 2` [J; J/m in 2D].
    fn energies(&self) -> [f64; 2] {
        let state = self.state();
        self.matrices()
            .energies(&state.velocity, &state.displacement)
    }
}

impl<Op: Operator<C>, const C: usize> StepView<C> for Simulation<Op, C> {
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
        &self.problem.scene
    }

    fn fields(&self) -> &GlobalFields<C> {
        &self.fields
    }

    fn lag(&self) -> f64 {
        if self.work.operators.implicit || self.problem.scene.lagged.is_none() {
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
        let block = w.operators.block(&p.scene, factors, vertex);
        block.diagonal().max()
    }

    fn unbalanced_at(&self, vertices: &[usize], forces: &mut [SVector<f64, C>]) {
        let (w, state) = (&self.work, &self.state);
        if w.balanced == Some(state.clock) {
            // `r - B v` is the same with fewer products, and differs from friction by what the solver left.
            for (force, &vertex) in forces.iter_mut().zip(vertices) {
                let product = w.operators.step.product_at(vertex, &state.velocity);
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

impl<Op: Operator<C>, const C: usize> Simulation<Op, C> {
    /// `l - M a - C v - A u` at some vertices, by its products \[N\].
    fn left_at(&self, vertices: &[usize], forces: &mut [SVector<f64, C>]) {
        let (p, state) = (&self.problem, &self.state);
        let load = self.applied_load();
        for (force, &vertex) in forces.iter_mut().zip(vertices) {
            let stiffness = &p.scene.stiffness;
            let mut left = load[vertex] - stiffness.product_at(vertex, &state.displacement);
            if let Some(mass) = &p.scene.mass {
                left -= mass.product_at(vertex, &state.acceleration);
            }
            for viscosity in &p.scene.viscosity {
                left -= viscosity.product_at(vertex, &state.velocity);
            }
            let lag = self.lag();
            if lag > 0.0 {
                for viscosity in p.scene.lagged_viscosities() {
                    left += viscosity.product_at(vertex, &state.acceleration) * lag;
                }
            }
            *force = left;
        }
    }
}

//! The local error of a step in slip rates and states.

use nalgebra::SVector;
use stickslip_friction::modulus;
use stickslip_solvers::{Potentials, decouple};

use super::RungeKutta;
use super::balance::numbered;
use super::tableau::{ERROR, STAGES, WEIGHTS};
use crate::integrate::VertexError;
use crate::integrate::distance::rate_distance;
use crate::numerics::NUMERICS;
use crate::sums::largest;
use crate::{ErrorControl, LocalError};

impl<const C: usize> RungeKutta<C> {
    /// The largest error of the slip of the step, relative to it, of vertices whose rate falls by more than a step
    /// resolves, where friction reads it: behind the step the rate may be rest by any slip.
    fn slip_error(&self, floor: f64) -> VertexError {
        let mut found = VertexError::default();
        let ratio = NUMERICS.resolved_ratio.powi(2);
        for (k, &vertex) in self.contacts.vertices.iter().enumerate() {
            let [before, after] = [&self.slopes[0].displacement, &self.now.velocity]
                .map(|velocity| velocity[vertex].norm_squared());
            let falls = before > ratio * after && self.contacts.reads_rate(k);
            if !falls || self.soft.has(vertex) || self.constraints.fixed[vertex].contains(&true) {
                continue;
            }
            let slopes = self.slopes.iter().zip(ERROR);
            // The second slope enters no error.
            let slopes = slopes.filter(|(_, weight)| *weight != 0.0);
            let error: SVector<f64, C> = slopes
                .map(|(slope, weight)| slope.displacement[vertex] * weight)
                .sum();
            let moved = self.now.displacement[vertex] - self.last.displacement[vertex];
            let moved = modulus(&moved).max(f64::MIN_POSITIVE);
            let counts = before.sqrt() / (before.sqrt() + floor);
            let error = modulus(&error) * self.now.last_step / moved * counts;
            found.raise(error, vertex, || moved);
        }
        found
    }

    /// The largest error of all contacts, from the differences of displacements and states that the step has stored;
    /// replaces them by the differences of the velocities. Their sensitivity is that of the linearised local problem.
    pub(super) fn local_error(&mut self, control: &ErrorControl) -> LocalError {
        let velocity = &self.now.velocity;
        // A single vertex is as fast as the fastest.
        let mut floor = control.slip_rate_floor;
        if velocity.len() > 1 {
            let fastest = largest(velocity.iter().map(|v| v.norm_squared())).sqrt();
            floor = floor.max(control.relative_slip_rate_floor * fastest);
        }
        let mut found = LocalError {
            slip: self.slip_error(floor),
            ..LocalError::default()
        };
        let force = &mut self.slopes[1].displacement;
        force.fill(SVector::zeros());
        if self.soft.are_any() {
            (self.elastic).add_error_of(self.matrices.stiffness(), &self.error.displacement, force);
        } else {
            self.elastic.add_error(-1.0, self.now.last_step, force);
        }
        if let Some(clamping) = self.contacts.clamping() {
            clamping.change_of(&self.error.displacement, &mut self.clamped);
        } else {
            self.clamped.fill(0.0);
        }
        let weights = [&ERROR[..], &WEIGHTS[STAGES - 1]];
        (self.contacts).add_pressure_error(weights, self.now.last_step, &mut self.clamped);
        // The slip rate of a soft cell follows from the others: its slip counts.
        for vertex in self.soft.vertices(&self.contacts.vertices) {
            force[vertex].fill(0.0);
            if let Some(clamped) = self.clamped.get_mut(vertex) {
                *clamped = 0.0;
            }
            let shares = self.contacts.contacts.iter().zip(&self.now.contacts);
            let slips =
                shares.filter_map(|(contact, at)| Some(at.slip[contact.position_of(vertex)?]));
            let slip = slips.fold(0.0, f64::max);
            let error = modulus(&self.error.displacement[vertex]) / (slip + control.slip_floor);
            found.slip.raise(error, vertex, || slip);
        }
        if let Some(many_cells) = &self.many_cells {
            let contacts = (self.contacts.contacts.as_slice(), &self.now);
            let errors = (
                force.as_slice(),
                self.error.states.as_slice(),
                self.clamped.as_slice(),
            );
            return found.larger(many_cells.local_error(contacts, errors, floor));
        }
        for (contact, at, first) in numbered(&self.contacts, &self.now) {
            if !self.clamped.is_empty() {
                for (k, &vertex) in contact.part.vertices.iter().enumerate() {
                    let slip = contact.tangential(k, &velocity[vertex]);
                    let slip_rate = modulus(&slip);
                    let (coefficient, _) = contact.trial.coefficient_and_rate_slope(k, slip_rate);
                    if slip_rate > 0.0 {
                        let strength = contact.part.weights[k] * coefficient;
                        force[vertex] -= slip * (strength * self.clamped[vertex] / slip_rate);
                    }
                }
            }
            if at.states.is_empty() {
                continue;
            }
            for (k, &vertex) in contact.part.vertices.iter().enumerate() {
                let (state, error) = (contact.trial.state(k), self.error.states[first + k]);
                let slip = contact.tangential(k, &velocity[vertex]);
                let slip_rate = modulus(&slip);
                let response = contact.trial.response(k, slip_rate);
                let weakening =
                    contact.part.weights[k] * contact.normal_stress[k] * response.state_slope;
                if slip_rate > 0.0 {
                    force[vertex] -= slip * (weakening * error / slip_rate);
                }
                let distance = contact.trial.laws().distance(state, state - error);
                found.state.raise(distance, vertex, || state);
            }
        }
        let fixed = &self.constraints.fixed;
        for (k, (&vertex, damping)) in self.contacts.vertices.iter().zip(&self.damping).enumerate()
        {
            let v = velocity[vertex];
            let mut resistance = damping + self.contacts.local_model(k, &v).hessian;
            let mut force = force[vertex];
            if fixed[vertex].contains(&true) {
                resistance = decouple(&resistance, &fixed[vertex]);
                for c in (0..C).filter(|&c| fixed[vertex][c]) {
                    force[c] = 0.0;
                }
            }
            let deviation = match resistance.cholesky() {
                Some(factor) => factor.solve(&force),
                // It sticks.
                None => SVector::zeros(),
            };
            let [slip, other] = [v, v - deviation].map(|v| self.contacts.slip_velocity(k, &v));
            // Where friction does not read the rate, one that viscosity hardly feels beside its strength is rest.
            let spent = self.contacts.closed_strength(k) / damping.diagonal().max();
            let floor = if self.contacts.reads_rate(k) || !spent.is_finite() {
                floor
            } else {
                floor.max(control.relative_slip_rate_floor * spent)
            };
            let distance = rate_distance(slip, other, floor);
            found.slip_rate.raise(distance, vertex, || modulus(&slip));
        }
        for (vertex, inverse) in &self.smooth {
            let v = velocity[*vertex];
            let distance = rate_distance(v, v - inverse * force[*vertex], floor);
            found.motion = largest([found.motion, control.motion * distance].into_iter());
        }
        found
    }
}

//! The local error of a step in slip rates and states.

use nalgebra::SVector;
use stickslip_friction::modulus;
use stickslip_solvers::{Potentials, decouple};

use super::RungeKutta;
use super::contacts::numbered;
use super::scalar::AtEnd;
use super::tableau::{ERROR, STAGES, WEIGHTS};
use crate::contact::DiscreteContact;
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
        for (k, &vertex) in self.scene.contacts.vertices.iter().enumerate() {
            let [before, after] = [&self.stages.slopes[0].displacement, &self.now.velocity]
                .map(|velocity| velocity[vertex].norm_squared());
            let falls = before > ratio * after && self.scene.contacts.reads_rate(k);
            if !falls
                || self.soft.has(vertex)
                || self.scene.constraints.fixed[vertex].contains(&true)
            {
                continue;
            }
            let slopes = self.stages.slopes.iter().zip(ERROR);
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

    /// The largest error of all contacts, from the differences of displacements and states that the step has stored.
    /// The sensitivity of slip rates is that of the linearised local problem.
    pub(super) fn local_error(&mut self, control: &ErrorControl) -> LocalError {
        // A single vertex is as fast as the fastest.
        let mut floor = control.slip_rate_floor;
        if self.now.velocity.len() > 1 {
            let speeds = self.now.velocity.iter().map(|v| v.norm_squared());
            floor = floor.max(control.relative_slip_rate_floor * largest(speeds).sqrt());
        }
        let mut found = LocalError {
            slip: self.slip_error(floor),
            ..LocalError::default()
        };
        // The second slope enters no error.
        let mut forces = std::mem::take(&mut self.stages.slopes[1].displacement);
        self.find_force_errors(&mut forces);
        // The slip rate of a soft cell follows from the others: its slip counts.
        for vertex in self.soft.vertices(&self.scene.contacts.vertices) {
            forces[vertex].fill(0.0);
            if let Some(clamped) = self.stages.clamped.get_mut(vertex) {
                *clamped = 0.0;
            }
            let shares = self.scene.contacts.contacts.iter().zip(&self.now.contacts);
            let slips =
                shares.filter_map(|(contact, at)| Some(at.slip[contact.position_of(vertex)?]));
            let slip = slips.fold(0.0, f64::max);
            let error = modulus(&self.stages.error.displacement[vertex]);
            let error = error / (slip + control.slip_floor);
            found.slip.raise(error, vertex, || slip);
        }
        for ((contact, at, first), scalar) in
            numbered(&self.scene.contacts, &self.now).zip(&self.local.scalar)
        {
            let states = &self.stages.error.states[first..first + at.states.len()];
            let Some(scalar) = scalar else {
                self.add_friction_errors(contact, states, &mut forces, &mut found.state);
                continue;
            };
            let at_end = AtEnd {
                velocity: &self.now.velocity,
                forces: &self.drive.forces,
                force_errors: &forces,
                clamped: &self.stages.clamped,
            };
            let floor = |k: usize| {
                if contact.reads_rate {
                    floor
                } else {
                    self.floor_at(scalar.numbers[k], floor, control)
                }
            };
            let at_rest =
                |k: usize, force: &SVector<f64, C>| self.deviation(scalar.numbers[k], force);
            let error = scalar.local_error(contact, &at_end, states, &floor, &at_rest);
            found = found.larger(error);
        }
        for &k in &self.local.coupled {
            let vertex = self.scene.contacts.vertices[k];
            let v = self.now.velocity[vertex];
            let deviation = self.deviation(k, &forces[vertex]);
            let [slip, other] =
                [v, v - deviation].map(|v| self.scene.contacts.slip_velocity(k, &v));
            let distance = rate_distance(slip, other, self.floor_at(k, floor, control));
            found.slip_rate.raise(distance, vertex, || modulus(&slip));
        }
        for (vertex, inverse) in &self.local.smooth {
            let v = self.now.velocity[*vertex];
            let distance = rate_distance(v, v - inverse * forces[*vertex], floor);
            found.motion = largest([found.motion, control.motion * distance].into_iter());
        }
        self.stages.slopes[1].displacement = forces;
        found
    }

    /// The errors of the elastic forces, and of the normal stresses.
    fn find_force_errors(&mut self, forces: &mut [SVector<f64, C>]) {
        forces.fill(SVector::zeros());
        let stages = &mut self.stages;
        let (error, clamped, dt) = (&stages.error, &mut stages.clamped, self.now.last_step);
        if self.soft.are_any() {
            (self.elastic).add_error_of(self.matrices.stiffness(), &error.displacement, forces);
        } else {
            self.elastic.add_error(-1.0, dt, forces);
        }
        if let Some(clamping) = self.scene.contacts.clamping() {
            clamping.change_of(&error.displacement, clamped);
        } else {
            clamped.fill(0.0);
        }
        let weights = [&ERROR[..], &WEIGHTS[STAGES - 1]];
        (self.scene.contacts).add_pressure_error(weights, [&self.last, &self.now], clamped);
    }

    /// Adds what the errors of states and normal stresses do to the friction of a contact, vertex by vertex, and raises the
    /// error of the states.
    fn add_friction_errors(
        &self,
        contact: &DiscreteContact<C>,
        states: &[f64],
        forces: &mut [SVector<f64, C>],
        found: &mut VertexError,
    ) {
        for (k, &vertex) in contact.part.vertices.iter().enumerate() {
            let slip = contact.tangential(k, &self.now.velocity[vertex]);
            let (slip_rate, mut change) = (modulus(&slip), 0.0);
            if let Some(clamped) = self.stages.clamped.get(vertex) {
                let (coefficient, _) = contact.trial.coefficient_and_rate_slope(k, slip_rate);
                change += contact.part.weights[k] * coefficient * clamped;
            }
            if let Some(error) = states.get(k) {
                let (state, laws) = (contact.trial.state(k), contact.trial.laws());
                found.raise(laws.distance(state, state - error), vertex, || state);
                let weakening = contact.trial.response(k, slip_rate).state_slope * error;
                change += contact.part.weights[k] * contact.normal_stress[k] * weakening;
            }
            if slip_rate > 0.0 {
                forces[vertex] -= slip * (change / slip_rate);
            }
        }
    }

    /// The change of the velocity of a frictional vertex with an error of its force.
    fn deviation(&self, k: usize, force: &SVector<f64, C>) -> SVector<f64, C> {
        let (contacts, mut force) = (&self.scene.contacts, *force);
        let vertex = contacts.vertices[k];
        let model = contacts.local_model(k, &self.now.velocity[vertex]);
        let mut resistance = self.local.damping[k] + model.hessian;
        let fixed = &self.scene.constraints.fixed[vertex];
        if fixed.contains(&true) {
            resistance = decouple(&resistance, fixed);
            for c in (0..C).filter(|&c| fixed[c]) {
                force[c] = 0.0;
            }
        }
        match resistance.cholesky() {
            Some(factor) => factor.solve(&force),
            // It sticks.
            None => SVector::zeros(),
        }
    }

    /// The floor of slip rates at a frictional vertex. Where friction does not read the rate, one that viscosity hardly feels
    /// beside its strength is rest.
    fn floor_at(&self, k: usize, floor: f64, control: &ErrorControl) -> f64 {
        let contacts = &self.scene.contacts;
        if contacts.reads_rate(k) {
            return floor;
        }
        let spent = contacts.closed_strength(k) / self.local.damping[k].diagonal().max();
        if spent.is_finite() {
            floor.max(control.relative_slip_rate_floor * spent)
        } else {
            floor
        }
    }
}

//! The stability limit of steps that their error limits, for the message of a run that ends for it.

use nalgebra::{SMatrix, SVector};
use stickslip_friction::modulus;

use super::RungeKutta;
use super::contacts::numbered;
use super::tableau::REAL_STABILITY;
use crate::numerics::NUMERICS;
use crate::sums::all_directions;

/// A change of slip rates and states, or its rate.
struct Change<const C: usize> {
    velocity: Vec<SVector<f64, C>>,
    states: Vec<f64>,
}

/// A state at a vertex: its direction of slip, the change of friction by the state \[N\], and those of the state's rate by
/// slip rate [1/m] and state [1/s].
struct Response<const C: usize> {
    vertex: usize,
    along: SVector<f64, C>,
    friction: f64,
    by_rate: f64,
    by_state: f64,
}

impl<const C: usize> RungeKutta<C> {
    /// The largest stable step at the accepted state \[s\]: the limit of the method over the largest modulus of an eigenvalue
    /// of the linearised equation,
    /// ```text
    /// D dV' = -A dV - friction_alpha dalpha',   dalpha' = g_V dV + g_alpha dalpha
    /// ```
    ///
    /// with `D = C + dfriction/dV`, by power iteration. None where nothing relaxes.
    pub(super) fn find_stable_step(&mut self) -> Option<f64> {
        // What is in force may be of a step that was rejected.
        self.begin().ok()?;
        for (contact, at) in self
            .scene
            .contacts
            .contacts
            .iter_mut()
            .zip(&self.now.contacts)
        {
            for (k, &state) in at.states.iter().enumerate() {
                contact.trial.states_mut()[k] = state;
            }
        }
        let mut blocks = vec![[SMatrix::zeros(); 2]; self.now.velocity.len()];
        self.find_resistances(&mut blocks);
        let responses = self.responses();
        let mut scales = vec![0.0; blocks.len()];
        for (scale, velocity) in scales.iter_mut().zip(&self.now.velocity) {
            *scale = modulus(velocity);
        }
        let mut now = Change {
            velocity: vec![SVector::zeros(); blocks.len()],
            states: responses.iter().map(|own| own.along.sum()).collect(),
        };
        all_directions(&mut now.velocity, &self.scene.constraints.fixed);
        for (velocity, scale) in now.velocity.iter_mut().zip(&scales) {
            *velocity *= *scale;
        }
        let mut next = Change {
            velocity: now.velocity.clone(),
            states: now.states.clone(),
        };
        // The mean of the later ones: the factors of a pair of complex eigenvalues go up and down.
        let (mut sum, half) = (0.0, NUMERICS.lanczos_steps);
        for step in 0..2 * half {
            let size = now.size(&scales);
            if !(size > 0.0 && size.is_finite()) {
                return None;
            }
            if step > half {
                sum += size.ln();
            }
            now.velocity.iter_mut().for_each(|own| *own /= size);
            now.states.iter_mut().for_each(|own| *own /= size);
            self.relax(&blocks, &responses, &now, &mut next);
            std::mem::swap(&mut now, &mut next);
        }
        let rate = (sum / (half - 1) as f64).exp();
        Some(REAL_STABILITY / rate)
    }

    /// The rate of a change.
    fn relax(
        &self,
        blocks: &[[SMatrix<f64, C, C>; 2]],
        responses: &[Response<C>],
        now: &Change<C>,
        rate: &mut Change<C>,
    ) {
        rate.velocity.fill(SVector::zeros());
        (self.matrices.stiffness()).multiply_add(-1.0, &now.velocity, &mut rate.velocity);
        for (k, own) in responses.iter().enumerate() {
            let slip_rate = own.along.dot(&now.velocity[own.vertex]);
            rate.states[k] = own.by_rate * slip_rate + own.by_state * now.states[k];
            rate.velocity[own.vertex] -= own.along * (own.friction * rate.states[k]);
        }
        for (velocity, [_, inverse]) in rate.velocity.iter_mut().zip(blocks) {
            *velocity = inverse * *velocity;
        }
    }

    /// The responses of all states, in their order.
    fn responses(&self) -> Vec<Response<C>> {
        let mut responses = Vec::new();
        for (contact, at, _) in numbered(&self.scene.contacts, &self.now) {
            let laws = contact.trial.laws();
            for (k, &state) in at.states.iter().enumerate() {
                let vertex = contact.part.vertices[k];
                let slip = contact.tangential(k, &self.now.velocity[vertex]);
                let rate = modulus(&slip);
                let weight = contact.part.weights[k] * contact.normal_stress[k];
                let evolution = |rate: f64, state: f64| laws.evolution(k, rate, state);
                let by = NUMERICS.difference;
                let [faster, older] = [rate * by, state.abs().max(1.0) * by];
                let slope = |change: f64, over: f64| if over > 0.0 { change / over } else { 0.0 };
                responses.push(Response {
                    vertex,
                    along: if rate > 0.0 { slip / rate } else { slip },
                    friction: weight * contact.trial.response(k, rate).state_slope,
                    by_rate: slope(
                        evolution(rate + faster, state) - evolution(rate, state),
                        faster,
                    ),
                    by_state: slope(
                        evolution(rate, state + older) - evolution(rate, state - older),
                        2.0 * older,
                    ),
                });
            }
        }
        responses
    }
}

impl<const C: usize> Change<C> {
    /// Its size over the slip rates.
    fn size(&self, scales: &[f64]) -> f64 {
        let velocities = self.velocity.iter().zip(scales);
        let moving = velocities.filter(|(_, scale)| **scale > 0.0);
        let squares = moving.map(|(velocity, scale)| (velocity / *scale).norm_squared());
        let states = self.states.iter().map(|state| state * state);
        squares.chain(states).sum::<f64>().sqrt()
    }
}

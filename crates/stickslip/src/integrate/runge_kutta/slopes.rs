//! The right-hand side of the equation at a stage.

use nalgebra::SVector;
use stickslip_friction::modulus;

use super::RungeKutta;
use super::contacts::{freeze, numbered};
use crate::StepError;

impl<const C: usize> RungeKutta<C> {
    /// The slopes of a stage at a time, with its elastic forces known. An error names what is not finite first.
    pub(super) fn evaluate(&mut self, stage: usize, time: f64) -> Result<(), StepError> {
        let evaluated = self.find_slopes(stage, time);
        evaluated.map_err(|error| self.source_of(stage, time, error))
    }

    /// The same: normal stresses, states, forces, velocities in balance, rates of the states.
    pub(super) fn find_slopes(&mut self, stage: usize, time: f64) -> Result<(), StepError> {
        let (scene, drive, stages) = (&mut self.scene, &mut self.drive, &mut self.stages);
        let (at, slope) = (&stages.motion, &mut stages.slopes[stage]);
        drive.balanced = None;
        (scene.contacts).set_normal_stress(time, &at.displacement)?;
        freeze(
            &mut scene.contacts,
            &self.now,
            &at.states,
            &mut slope.states,
        )?;
        let elastic = &self.elastic.at_stages[stage];
        drive.find(time, (&scene.loads, &scene.contacts), elastic);
        if !scene.constraints.held.is_empty() {
            let velocity = &mut slope.displacement;
            velocity.fill(SVector::zeros());
            scene.constraints.prescribe(time, velocity)?;
            (scene.contacts).prescribe(&scene.constraints.fixed, velocity);
        }
        let forces = (drive.forces.as_slice(), self.matrices.viscosity());
        let all_finite = (self.local).balance(&scene.contacts, &scene.constraints, forces, slope);
        self.find_evolutions(stage, time, all_finite)
    }

    /// The rates of the states of a stage where they are not known with its velocities. An error is a vertex whose rates are
    /// not finite.
    fn find_evolutions(&mut self, stage: usize, time: f64, known: bool) -> Result<(), StepError> {
        let slope = &mut self.stages.slopes[stage];
        let (velocity, forces) = (&slope.displacement, &self.drive.forces);
        for &(vertex, _) in &self.local.smooth {
            let speed = modulus(&velocity[vertex]);
            if !speed.is_finite() {
                return Err(failed(vertex, time, [speed, 0.0, 0.0]));
            }
        }
        let contacts = numbered(&self.scene.contacts, &self.now).zip(&self.local.scalar);
        for ((contact, at, first), scalar) in contacts.filter(|(_, own)| own.is_none() || !known) {
            let follows = contact.trial.follows_normal_stress();
            let states = &mut slope.states[first..first + at.states.len()];
            for (k, &vertex) in contact.part.vertices.iter().enumerate() {
                let (rate, state) = (contact.slip_rate(k, velocity), contact.trial.state(k));
                let evolution = contact.trial.laws().evolution(k, rate, state);
                // A maximum with zero, as in Tresca's law, forgets what is not a number.
                let given = forces[vertex].sum() + contact.normal_stress[k];
                if !(given.is_finite() && rate.is_finite() && evolution.is_finite()) {
                    return Err(failed(vertex, time, [rate, state, evolution]));
                }
                if let Some(own) = states.get_mut(k).filter(|_| scalar.is_none()) {
                    // It has the derivative of the state in force in the one stored.
                    *own = if follows { evolution / *own } else { evolution };
                }
            }
        }
        Ok(())
    }
}

fn failed(vertex: usize, time: f64, [slip_rate, state, evolution]: [f64; 3]) -> StepError {
    StepError::Stage {
        vertex,
        time,
        slip_rate,
        state,
        evolution,
    }
}

//! From the last accepted step to the velocity problem of the next one, and back.

use nalgebra::SVector;
use stickslip_friction::FrictionLaw;
use stickslip_state::{StateLaw, StateVariable};
use stickslip_time::{Coefficients, RateScheme};
use stickslip_tnnmg::Operator;

use crate::accepted::Accepted;
use crate::scene::Load;
use crate::simulation::Simulation;
use crate::state_update::StepStart;
use crate::{StateUpdate, StepError};

impl<Op, L, S, R, const C: usize> Simulation<Op, L, S, R, C>
where
    Op: Operator<C>,
    L: FrictionLaw + Clone,
    S: StateLaw + Clone,
    L::State: From<S::State>,
    R: RateScheme,
{
    /// `r = l - M a^ - A u^`, and the start of the coupling.
    pub(crate) fn predict(&mut self, dt: f64, time: f64) -> Result<(), StepError> {
        predict_motion(
            &self.scheme,
            dt,
            &self.now,
            &mut self.predicted_displacement,
            &mut self.predicted_acceleration,
        );
        self.prescribe(time)?;
        if !self.now.carried.is_empty() {
            self.move_by_mean_velocity(dt);
        }
        let load = &mut self.trial.load;
        fill_load(&self.scene.load, time, load);
        let displacement = &self.predicted_displacement;
        self.scene.stiffness.multiply_add(-1.0, displacement, load);
        if let Some(mass) = &self.scene.mass {
            mass.multiply_add(-1.0, &self.predicted_acceleration, load);
        }
        // One pass without a branch; who it was is asked only if somebody was.
        let sound = load.iter().flatten();
        if sound.fold(true, |sound, value| sound & value.is_finite()) {
            return Ok(());
        }
        finite("load", load, 0..load.len())
    }

    /// The start of the coupling: the last velocity, and that of the new time where it is prescribed.
    fn prescribe(&mut self, time: f64) -> Result<(), StepError> {
        let velocities = &mut self.trial.velocity;
        velocities.copy_from_slice(&self.now.velocity);
        for &vertex in &self.held {
            for c in (0..C).filter(|&c| self.fixed[vertex][c]) {
                velocities[vertex][c] = 0.0;
            }
        }
        for moved in &self.scene.moved {
            let velocity = (moved.velocity)(time);
            for &vertex in &moved.patch.vertices {
                for c in (0..C).filter(|&c| moved.components[c]) {
                    velocities[vertex][c] = velocity[c];
                }
            }
            finite("prescribed velocity", velocities, &moved.patch.vertices)?;
        }
        Ok(())
    }

    /// Where the velocity is prescribed, its mean over the step moves the displacement. A scheme that
    /// carries an acceleration along would take it from before a jump of the data, and what it moves too
    /// far stays for good.
    fn move_by_mean_velocity(&mut self, dt: f64) {
        let c_u = self.scheme.coefficients(dt).displacement;
        for &vertex in &self.held {
            for c in (0..C).filter(|&c| self.fixed[vertex][c]) {
                let (old, new) = (self.now.velocity[vertex][c], self.trial.velocity[vertex][c]);
                let moved = self.now.displacement[vertex][c] + 0.5 * dt * (old + new);
                self.predicted_displacement[vertex][c] = moved - c_u * new;
            }
        }
    }

    /// Normal stress of the new time, and what the state starts from.
    pub(crate) fn load_friction(&mut self, dt: f64, time: f64) -> Result<(), StepError> {
        if let Some(history) = &self.scene.friction.stress_history {
            for (k, stress) in self.trial.normal_stress.iter_mut().enumerate() {
                *stress = *self.scene.friction.normal_stress.at(k);
            }
            history(time, &mut self.trial.normal_stress);
            for (k, &stress) in self.trial.normal_stress.iter().enumerate() {
                if !stress.is_finite() {
                    return Err(StepError::Data {
                        what: "normal stress",
                        vertex: self.vertices[k],
                        value: stress,
                    });
                }
                self.trial.potentials[k].law.normal_stress = stress.abs();
            }
        }
        if size_of::<S::State>() > 0 {
            for (k, potential) in self.trial.potentials.iter_mut().enumerate() {
                potential.law.state = self.now.states[k];
                potential.law.guess.set(None);
                potential.law.start = StepStart {
                    state: self.now.states[k],
                    slip_rate: self.now.velocity[self.vertices[k]].norm(),
                    dt,
                    // A stage of a Runge-Kutta method is backward Euler, for the state too.
                    update: match self.scheme.stages() {
                        Some(_) => StateUpdate::BackwardEuler,
                        None => self.state_update,
                    },
                };
            }
        }
        Ok(())
    }

    /// `u`, `v`, `a` and the state of the new time take the place of the old ones.
    pub(crate) fn accept(&mut self, dt: f64, coefficients: &Coefficients) {
        // Before anything of the old motion is overwritten.
        for i in 0..self.now.carried.len() {
            for c in 0..C {
                let (from, v) = (self.now.motion(i, c), self.trial.velocity[i][c]);
                self.now.carried[i][c] = self.scheme.carry(dt, from, v).unwrap_or(0.0);
            }
        }
        let c_u = coefficients.displacement;
        let fields = self.trial.velocity.iter().zip(&self.predicted_displacement);
        for (u, (v, predicted)) in self.now.displacement.iter_mut().zip(fields) {
            *u = v * c_u + predicted;
        }
        let c_a = coefficients.acceleration;
        let fields = self.trial.velocity.iter().zip(&self.predicted_acceleration);
        for (a, (v, predicted)) in self.now.acceleration.iter_mut().zip(fields) {
            *a = v * c_a + predicted;
        }
        for (earlier, &vertex) in self.now.earlier.iter_mut().zip(&self.vertices) {
            *earlier = self.now.velocity[vertex];
        }
        std::mem::swap(&mut self.now.velocity, &mut self.trial.velocity);
        for (state, potential) in self.now.states.iter_mut().zip(&self.trial.potentials) {
            *state = potential.law.state;
        }
    }
}

/// What the scheme knows of displacement and acceleration before the velocity; `acceleration` is empty
/// without mass.
fn predict_motion<R: RateScheme, T: StateVariable, const C: usize>(
    scheme: &R,
    dt: f64,
    now: &Accepted<T, C>,
    displacement: &mut [SVector<f64, C>],
    acceleration: &mut [SVector<f64, C>],
) {
    for (i, displacement) in displacement.iter_mut().enumerate() {
        let predicted: [_; C] = std::array::from_fn(|c| scheme.predict(dt, now.motion(i, c)));
        *displacement = SVector::from_fn(|c, _| predicted[c].displacement);
        if let Some(acceleration) = acceleration.get_mut(i) {
            *acceleration = SVector::from_fn(|c, _| predicted[c].acceleration);
        }
    }
}

pub(crate) fn fill_load<const C: usize>(load: &Load<C>, time: f64, target: &mut [SVector<f64, C>]) {
    match load {
        Load::None => target.fill(SVector::zeros()),
        Load::Constant(load) => target.copy_from_slice(load),
        Load::History(history) => {
            target.fill(SVector::zeros());
            history(time, target);
        }
    }
}

fn finite<const C: usize>(
    what: &'static str,
    field: &[SVector<f64, C>],
    vertices: impl IntoIterator<Item = impl std::borrow::Borrow<usize>>,
) -> Result<(), StepError> {
    for vertex in vertices {
        let vertex = *vertex.borrow();
        if let Some(&value) = field[vertex].iter().find(|value| !value.is_finite()) {
            return Err(StepError::Data {
                what,
                vertex,
                value,
            });
        }
    }
    Ok(())
}

//! The integrator as a stepper: error estimate, undo, restore.

use nalgebra::SVector;
use stickslip_friction::modulus;
use stickslip_tnnmg::{Operator, Potentials};

use super::RungeKutta;
use crate::contact::ContactSet;
use crate::run::local_error::rate_distance;
use crate::scene::Loads;
use crate::step::Source;
use crate::{
    ControlState, ErrorControl, Failure, LocalError, SceneError, Snapshot, StepReport, StepState,
    Stepper, VertexError,
};

impl<const C: usize> Source<C> for RungeKutta<C> {
    fn contacts(&self) -> &ContactSet<C> {
        &self.contacts
    }

    fn loads(&self) -> &Loads<C> {
        &self.loads
    }

    fn is_fixed(&self, _: usize, _: usize) -> bool {
        false
    }

    /// The slip rate is the closed form of the balance: neither is better known than the other.
    fn resistance(&self, _: usize) -> f64 {
        f64::INFINITY
    }

    fn unbalanced_at(&self, _: &[usize], forces: &mut [SVector<f64, C>]) {
        let (u, v) = (self.now.displacement[0], self.now.velocity[0]);
        let force = self.drive(self.now.clock.time(), u) - self.viscosity.product_at(0, &[v]);
        forces.fill(force);
    }

    fn energies(&self) -> [f64; 2] {
        [0.0, 0.5 * self.stiffness.quadratic(&self.now.displacement)]
    }

    fn add_viscous_force(&self, v: &[SVector<f64, C>], force: &mut [SVector<f64, C>]) -> bool {
        self.viscosity.multiply_add(1.0, v, force);
        self.viscosity.amax() > 0.0
    }

    #[cfg(feature = "serde")]
    fn describe(&self, _: f64, fingerprint: &mut crate::checkpoint::Fingerprint) {
        fingerprint.operator("the stiffness matrix", &self.stiffness);
        fingerprint.operator("the viscosity matrix", &self.viscosity);
    }
}

impl<const C: usize> Stepper<C> for RungeKutta<C> {
    fn step(&mut self, dt: f64) -> Result<StepReport, Failure> {
        self.advance(dt)?;
        Ok(self.now.report)
    }

    /// One step, and its difference to the embedded method of order 4 in the slip rate and the state;
    /// levels and extrapolation do not apply.
    fn step_estimated(&mut self, dt: f64, control: &ErrorControl) -> Result<LocalError, Failure> {
        let (error, state_error) = self.advance(dt)?;
        let v = self.now.velocity[0];
        // By how much the slip rate follows an error of displacement and state: the local problem,
        // linearised.
        let (slip_rate, state) = (modulus(&v), self.state());
        let contact = &self.contacts.contacts[0];
        let sensitivity = (contact.interface)
            .response(0, slip_rate, state)
            .state_slope;
        let weakening = contact.part.weights[0] * contact.normal_stress[0] * sensitivity;
        let mut drive = -(self.stiffness * error);
        if slip_rate > 0.0 {
            drive -= v * (weakening * state_error / slip_rate);
        }
        let resistance = self.viscosity + self.contacts.local_model(0, &v).hessian;
        let deviation = match resistance.cholesky() {
            Some(factor) => factor.solve(&drive),
            // It sticks.
            None => SVector::zeros(),
        };
        let rates = rate_distance(v, v - deviation, control.slip_rate_floor, 0.0);
        let states = contact.interface.distance(state, state - state_error);
        let vertex = contact.part.vertices[0];
        let at = |error, value| VertexError {
            error,
            vertex,
            value,
        };
        Ok(LocalError {
            slip_rate: at(rates, slip_rate),
            state: at(states, state),
            motion: 0.0,
        })
    }

    fn error_order(&self, _control: &ErrorControl) -> usize {
        5
    }

    fn undo(&mut self) {
        self.now.copy_from(&self.last);
        self.accepted = false;
    }

    fn snapshot(&self) -> Snapshot<'_, C> {
        RungeKutta::snapshot(self)
    }

    fn restore(&mut self, state: &StepState<C>) -> Result<(), SceneError> {
        state.check_fits(&self.now)?;
        self.now.copy_from(state);
        self.begin()
    }

    fn remember(&mut self, control: ControlState) {
        self.now.control = control;
    }
}

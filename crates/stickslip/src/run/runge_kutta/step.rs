//! One step: slopes at the stages, their sums.

use nalgebra::SVector;
use stickslip_friction::modulus;
use stickslip_tnnmg::Potentials;

use super::RungeKutta;
use super::tableau::{ERROR, NODES, STAGES, WEIGHTS};
use crate::{Failure, StepError, StepReport};

impl<const C: usize> RungeKutta<C> {
    /// The value of the state, 0 without one.
    pub(super) fn state(&self) -> f64 {
        self.now.contacts[0].states.first().copied().unwrap_or(0.0)
    }

    /// The force on the contact that is not friction: `l - A u`.
    pub(super) fn drive(&self, time: f64, u: SVector<f64, C>) -> SVector<f64, C> {
        let (mut load, mut scratch) = ([SVector::zeros()], [SVector::zeros()]);
        self.loads.fill(time, &mut load, &mut scratch);
        self.contacts.add_tractions(true, &mut load);
        load[0] - self.stiffness * u
    }

    /// What the normal stress in force makes of a state that belongs to that of the accepted step, and the
    /// derivative of that.
    fn moved(&self, state: f64) -> Result<(f64, f64), StepError> {
        let contact = &self.contacts.contacts[0];
        let normal_stress = [
            self.now.contacts[0].normal_stress[0],
            contact.normal_stress[0],
        ];
        let moved = contact.interface.moved(0, state, normal_stress);
        moved.map_err(|unloaded| contact.unloaded(unloaded))
    }

    /// `v` and the rate of the state at a time and displacement. Within a step the state is the one that the
    /// normal stress of its beginning would leave, which does not follow the normal stress.
    pub(super) fn slope(
        &mut self,
        time: f64,
        u: SVector<f64, C>,
        unmoved: f64,
    ) -> Result<(SVector<f64, C>, f64), StepError> {
        self.contacts.contacts[0].set_time(time)?;
        let (state, moved_by) = self.moved(unmoved)?;
        let contact = &mut self.contacts.contacts[0];
        contact.interface.set_state(0, state);
        let drive = self.drive(time, u);
        let v: SVector<f64, C> = self.contacts.minimize(0, &self.viscosity, &drive);
        let slip_rate = modulus(&v);
        let contact = &self.contacts.contacts[0];
        let evolution = contact.interface.evolution(0, slip_rate, state);
        // A maximum with zero, as in Tresca's law, forgets what is not a number.
        let given = drive.norm() + contact.normal_stress[0];
        if given.is_finite() && slip_rate.is_finite() && evolution.is_finite() {
            Ok((v, evolution / moved_by))
        } else {
            Err(StepError::Stage {
                time,
                slip_rate,
                state,
                evolution,
            })
        }
    }

    /// One step; returns the differences of displacement and state to the method of order 4.
    pub(super) fn advance(&mut self, dt: f64) -> Result<(SVector<f64, C>, f64), Failure> {
        let next = self.now.clock.after(dt);
        let failure = |cause| Failure {
            step: next.step(),
            time: next.time(),
            cause,
        };
        if !(dt > 0.0 && dt.is_finite()) {
            return Err(failure(StepError::StepSize { dt }));
        }
        let (time, u, state) = (
            self.now.clock.time(),
            self.now.displacement[0],
            self.state(),
        );
        if std::mem::take(&mut self.accepted) {
            self.slopes[0] = self.slopes[STAGES - 1];
        }
        let (mut to, mut to_state) = (u, state);
        for stage in 1..STAGES {
            (to, to_state) = (u, state);
            for (weight, slope) in WEIGHTS[stage][..stage].iter().zip(&self.slopes) {
                to += slope.0 * (weight * dt);
                to_state += slope.1 * (weight * dt);
            }
            let at = if stage + 1 < STAGES {
                time + NODES[stage] * dt
            } else {
                next.time()
            };
            self.slopes[stage] = self.slope(at, to, to_state).map_err(failure)?;
        }
        let (mut error, mut state_error) = (SVector::zeros(), 0.0);
        for (weight, slope) in ERROR.iter().zip(&self.slopes) {
            error += slope.0 * (weight * dt);
            state_error += slope.1 * (weight * dt);
        }
        let (to_state, moved_by) = self.moved(to_state).map_err(failure)?;
        self.slopes[STAGES - 1].1 *= moved_by;
        state_error *= moved_by;
        self.last.copy_from(&self.now);
        let contact = &mut self.now.contacts[0];
        contact.slip[0] += modulus(&(to - u));
        contact.states.fill(to_state);
        (contact.normal_stress).copy_from_slice(&self.contacts.contacts[0].normal_stress);
        self.now.clock = next;
        self.now.last_step = dt;
        self.now.displacement[0] = to;
        self.now.velocity[0] = self.slopes[STAGES - 1].0;
        self.now.report = StepReport {
            coupling_iterations: STAGES - 1,
            solver_iterations: STAGES - 1,
            ..StepReport::default()
        };
        self.accepted = true;
        Ok((error, state_error))
    }
}

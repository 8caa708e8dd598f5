//! The integrator as a stepper: error estimate, undo, restore.

use nalgebra::SVector;
use stickslip_tnnmg::Operator;

use super::RungeKutta;
use crate::contact::ContactSet;
use crate::scene::Loads;
use crate::step::{Seen, Source};
use crate::{
    ControlState, ErrorControl, Failure, LocalError, SceneError, Snapshot, StepReport, StepState,
    Stepper,
};

impl<Op: Operator<C>, const C: usize> Source<C> for RungeKutta<Op, C> {
    fn contacts(&self) -> &ContactSet<C> {
        &self.contacts
    }

    fn loads(&self) -> &Loads<C> {
        &self.loads
    }

    fn mesh(&self) -> Option<u64> {
        self.scene.mesh
    }

    fn seen(&self) -> Option<&Seen<C>> {
        Some(&self.seen).filter(|seen| !seen.frames().is_empty())
    }

    fn is_fixed(&self, vertex: usize, component: usize) -> bool {
        self.constraints.fixed[vertex][component]
    }

    fn is_moved(&self, vertex: usize, component: usize) -> bool {
        self.constraints.is_moved(vertex, component)
    }

    /// The slip rate is the closed form of the balance: neither is better known than the other.
    fn resistance(&self, _: usize) -> f64 {
        f64::INFINITY
    }

    fn unbalanced_at(&self, vertices: &[usize], forces: &mut [SVector<f64, C>]) {
        let viscous = |vertex: usize| match self.scene.viscosity.first() {
            Some(viscosity) => viscosity.diagonal_block(vertex) * self.now.velocity[vertex],
            None => SVector::zeros(),
        };
        if self.balanced == Some(self.now.clock) {
            for (force, &vertex) in forces.iter_mut().zip(vertices) {
                *force = self.drive[vertex] - viscous(vertex);
            }
            return;
        }
        let size = self.now.velocity.len();
        let mut drive = vec![SVector::zeros(); size];
        let time = self.now.clock.time();
        (self.loads).fill(time, &mut drive, &mut self.loads.scratch(size));
        self.contacts.add_tractions(true, &mut drive);
        for (force, &vertex) in forces.iter_mut().zip(vertices) {
            let product = self
                .scene
                .stiffness
                .product_at(vertex, &self.now.displacement);
            *force = drive[vertex] - product - viscous(vertex);
        }
    }

    fn energies(&self) -> [f64; 2] {
        let elastic = self.scene.stiffness.quadratic(&self.now.displacement);
        [0.0, 0.5 * elastic]
    }

    fn add_viscous_force(&self, v: &[SVector<f64, C>], force: &mut [SVector<f64, C>]) -> bool {
        for viscosity in &self.scene.viscosity {
            viscosity.multiply_add(1.0, v, force);
        }
        !self.scene.viscosity.is_empty()
    }

    fn add_viscous_force_of(
        &self,
        number: usize,
        v: &[SVector<f64, C>],
        force: &mut [SVector<f64, C>],
    ) -> bool {
        let viscosity = self.scene.viscosities.get(number);
        if let Some(viscosity) = viscosity {
            viscosity.multiply_add(1.0, v, force);
        }
        viscosity.is_some()
    }

    #[cfg(feature = "serde")]
    fn describe(&self, time: f64, fingerprint: &mut crate::checkpoint::Fingerprint) {
        fingerprint.words("the mesh", self.scene.mesh);
        fingerprint.operator("the stiffness matrix", &self.scene.stiffness);
        for viscosity in &self.scene.viscosity {
            fingerprint.operator("the viscosity matrix", viscosity);
        }
        self.constraints.describe(time, fingerprint);
    }
}

impl<Op: Operator<C>, const C: usize> Stepper<C> for RungeKutta<Op, C> {
    fn step(&mut self, dt: f64) -> Result<StepReport, Failure> {
        self.advance(dt)?;
        Ok(self.now.report)
    }

    /// One step, and its difference to the embedded method of order 4 in slip rates and states, and in the velocities of
    /// vertices without friction; levels and extrapolation do not apply.
    fn step_estimated(&mut self, dt: f64, control: &ErrorControl) -> Result<LocalError, Failure> {
        self.advance(dt)?;
        Ok(self.local_error(control))
    }

    fn error_order(&self, _control: &ErrorControl) -> usize {
        5
    }

    fn undo(&mut self) {
        self.now.copy_from(&self.last);
        if std::mem::take(&mut self.accepted) {
            self.balanced = None;
        }
        self.seen.show(&self.now);
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

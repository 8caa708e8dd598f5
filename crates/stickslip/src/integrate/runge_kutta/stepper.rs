//! The integrator as a stepper: error estimate, reversal, restoration.

use nalgebra::SVector;
use stickslip_core::compiled;
use stickslip_solvers::MeshId;

use super::RungeKutta;
use crate::body::Matrices;
use crate::contact::ContactSet;
use crate::placement::Constraints;
use crate::scene::Loads;
use crate::step::Span;
use crate::view::{GlobalFields, StepView};
use crate::{
    ControlState, ErrorControl, LocalError, SceneError, Snapshot, StepFailure, StepReport,
    StepState, Stepper,
};

impl<const C: usize> StepView<C> for RungeKutta<C> {
    fn state(&self) -> &StepState<C> {
        &self.now
    }

    fn contacts(&self) -> &ContactSet<C> {
        &self.scene.contacts
    }

    fn loads(&self) -> &Loads<C> {
        &self.scene.loads
    }

    fn constraints(&self) -> &Constraints<C> {
        &self.scene.constraints
    }

    fn matrices(&self) -> &dyn Matrices<C> {
        &*self.matrices
    }

    fn mesh(&self) -> Option<MeshId> {
        self.scene.mesh
    }

    fn fields(&self) -> &GlobalFields<C> {
        &self.scene.seen
    }

    fn data_time(&self) -> f64 {
        Span::seen(&self.now.clock, &self.scene.stops)
    }

    /// Infinite: the slip rate is the closed form of the balance, so that both are equally accurate.
    fn diagonal_stiffness(&self, _: usize) -> f64 {
        f64::INFINITY
    }

    fn unbalanced_at(&self, vertices: &[usize], forces: &mut [SVector<f64, C>]) {
        let viscous = |vertex: usize| match self.matrices.viscosity() {
            Some(viscosity) => viscosity.diagonal_block(vertex) * self.now.velocity[vertex],
            None => SVector::zeros(),
        };
        if self.drive.balanced == Some(self.now.clock) {
            for (force, &vertex) in forces.iter_mut().zip(vertices) {
                *force = self.drive.forces[vertex] - viscous(vertex);
            }
            return;
        }
        let size = self.now.velocity.len();
        let mut drive = vec![SVector::zeros(); size];
        let time = self.data_time();
        (self.scene.loads).fill(time, &mut drive, &mut self.scene.loads.scratch(size));
        self.scene.contacts.add_tractions(&mut drive);
        for (force, &vertex) in forces.iter_mut().zip(vertices) {
            let stiffness = self.matrices.stiffness();
            let product = stiffness.product_at(vertex, &self.now.displacement);
            *force = drive[vertex] - product - viscous(vertex);
        }
    }
}

impl<const C: usize> RungeKutta<C> {
    /// Works with the threads of the pool awake, if the local problems of enough vertices are scalar.
    fn in_threads<R: Send>(&mut self, work: impl FnOnce(&mut Self) -> R + Send) -> R {
        let cells = self.local.scalar_count();
        let mut threads = self.threads;
        let result = threads.work(cells, || work(&mut *self));
        self.threads = threads;
        result
    }
}

impl<const C: usize> Stepper<C> for RungeKutta<C> {
    fn step(&mut self, dt: f64) -> Result<StepReport, StepFailure> {
        step(self, dt)
    }

    /// Takes one step and returns its difference from the embedded method of order 4 in slip rates and states, and in
    /// the velocities of vertices without friction; levels and extrapolation do not apply.
    fn step_estimated(
        &mut self,
        dt: f64,
        control: &ErrorControl,
    ) -> Result<LocalError, StepFailure> {
        step_estimated(self, dt, control)
    }

    fn error_order(&self, _control: &ErrorControl) -> usize {
        5
    }

    fn is_resisted(&self) -> bool {
        self.matrices.is_resisted()
    }

    fn stable_step(&mut self) -> Option<f64> {
        stable_step(self)
    }

    fn is_dense(&self) -> bool {
        RungeKutta::is_dense(self)
    }

    fn show_inside(
        &mut self,
        times: &[f64],
        show: &mut dyn FnMut(Snapshot<'_, C>),
    ) -> Result<(), StepFailure> {
        show_inside(self, times, show)
    }

    fn set_stops(&mut self, stops: &[f64]) {
        self.scene.stops.clear();
        self.scene.stops.extend_from_slice(stops);
    }

    fn undo(&mut self) {
        self.now.copy_from(&self.last);
        if std::mem::take(&mut self.accepted) {
            self.drive.balanced = None;
        }
        self.scene.seen.show(&self.now);
    }

    fn state(&self) -> &StepState<C> {
        &self.now
    }

    fn snapshot(&self) -> Snapshot<'_, C> {
        RungeKutta::snapshot(self)
    }

    fn restore(&mut self, state: &StepState<C>) -> Result<(), SceneError> {
        restore(self, state)
    }

    fn remember(&mut self, control: ControlState) {
        self.now.control = control;
    }
}

compiled! {
    fn step<C>(own: &mut RungeKutta<C>, dt: f64) -> Result<StepReport, StepFailure> {
        own.in_threads(|own| own.advance(dt, false))?;
        Ok(own.now.report)
    }

    fn step_estimated<C>(
        own: &mut RungeKutta<C>,
        dt: f64,
        control: &ErrorControl,
    ) -> Result<LocalError, StepFailure> {
        own.in_threads(|own| {
            own.advance(dt, true)?;
            Ok(own.local_error(control))
        })
    }

    fn show_inside<C>(
        own: &mut RungeKutta<C>,
        times: &[f64],
        show: &mut dyn FnMut(Snapshot<'_, C>),
    ) -> Result<(), StepFailure> {
        RungeKutta::show_inside(own, times, show)
    }

    fn stable_step<C>(own: &mut RungeKutta<C>) -> Option<f64> {
        own.find_stable_step()
    }

    fn restore<C>(own: &mut RungeKutta<C>, state: &StepState<C>) -> Result<(), SceneError> {
        state.check_fits(&own.now)?;
        own.now.copy_from(state);
        own.begin()
    }
}

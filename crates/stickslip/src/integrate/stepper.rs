//! The interface of time steppers.

use std::mem;

use stickslip_core::compiled;

use super::compare::compare;
use crate::{
    ControlState, ErrorControl, LocalError, SceneError, Simulation, Snapshot, StepError,
    StepFailure, StepReport, StepState,
};

/// A scene with any time-stepping method: [`Simulation`], [`RungeKutta`](crate::RungeKutta), or one of the user's own.
/// A `Box<dyn Stepper<C>>` holds any of them; [`Run`](crate::Run) drives it.
pub trait Stepper<const C: usize>: Send {
    /// Takes one step of `dt` \[s\].
    ///
    /// # Errors
    /// [`StepFailure`]; the last accepted step stays in place and another `dt` can be tried.
    fn step(&mut self, dt: f64) -> Result<StepReport, StepFailure>;

    /// Takes a step of `dt` \[s\] and returns its estimated local error, see [`ErrorControl`].
    ///
    /// # Errors
    /// [`StepFailure`]; the last accepted step stays in place and another `dt` can be tried.
    fn step_estimated(
        &mut self,
        dt: f64,
        control: &ErrorControl,
    ) -> Result<LocalError, StepFailure>;

    /// The power of the step with which the estimated error falls.
    fn error_order(&self, control: &ErrorControl) -> usize;

    /// Refuses an error control that the method does not support; accepts all by default.
    ///
    /// # Errors
    /// [`StepError`] with the reason.
    fn check_control(&self, control: &ErrorControl) -> Result<(), StepError> {
        let _ = control;
        Ok(())
    }

    /// Whether the scene has inertia or damping, with which sufficiently small steps resolve a slip instability; true
    /// by default.
    fn is_resisted(&self) -> bool {
        true
    }

    /// The largest stable step at the accepted state \[s\], of an explicit method whose steps only their error limits: a run
    /// that ends for its steps reports it if they have reached it. `None` by default.
    fn stable_step(&mut self) -> Option<f64> {
        None
    }

    /// Whether the method extends into its steps, see [`show_inside`](Self::show_inside); false by default.
    fn is_dense(&self) -> bool {
        false
    }

    /// Shows the motion at increasing `times` \[s\] inside of the last accepted step, to the accuracy of the step, and
    /// keeps its end: later steps have the same bits. A method that [is not dense](Self::is_dense) shows nothing.
    ///
    /// # Errors
    /// [`StepFailure`] for a time without a finite slip rate.
    fn show_inside(
        &mut self,
        times: &[f64],
        show: &mut dyn FnMut(Snapshot<'_, C>),
    ) -> Result<(), StepFailure> {
        let _ = (times, show);
        Ok(())
    }

    /// Sets the times at which data can jump \[s\], increasing: a step that ends at one of them sees the data from the
    /// left, one that begins there from the right. Ignored by default.
    fn set_stops(&mut self, stops: &[f64]) {
        let _ = stops;
    }

    /// Reverts the last [`step_estimated`](Stepper::step_estimated).
    fn undo(&mut self);

    /// The state that the next step depends on.
    fn state(&self) -> &StepState<C>;

    /// A view of the last accepted step.
    fn snapshot(&self) -> Snapshot<'_, C>;

    /// Restores another state of the same scene.
    ///
    /// # Errors
    /// [`SceneError::Length`] for a state of another scene.
    fn restore(&mut self, state: &StepState<C>) -> Result<(), SceneError>;

    /// Stores the memory of the step-size control in the state.
    fn remember(&mut self, control: ControlState);
}

impl<const C: usize> Stepper<C> for Simulation<C> {
    fn step(&mut self, dt: f64) -> Result<StepReport, StepFailure> {
        Simulation::step(self, dt)
    }

    fn step_estimated(
        &mut self,
        dt: f64,
        control: &ErrorControl,
    ) -> Result<LocalError, StepFailure> {
        estimated(self, dt, control)
    }

    fn error_order(&self, control: &ErrorControl) -> usize {
        let method = &self.problem.method;
        control.error_order(method.order(), method.is_symmetric())
    }

    fn check_control(&self, control: &ErrorControl) -> Result<(), StepError> {
        let waves = self.problem.matrices.has_mass() && self.state.velocity.len() > 1;
        let order = self.problem.method.order();
        if control.extrapolate && waves && order > 1 {
            return Err(StepError::Extrapolation { order });
        }
        Ok(())
    }

    fn is_resisted(&self) -> bool {
        self.problem.matrices.is_resisted()
    }

    fn set_stops(&mut self, stops: &[f64]) {
        self.problem.stops.clear();
        self.problem.stops.extend_from_slice(stops);
    }

    fn undo(&mut self) {
        undo(self);
    }

    fn state(&self) -> &StepState<C> {
        Simulation::state(self)
    }

    fn snapshot(&self) -> Snapshot<'_, C> {
        Simulation::snapshot(self)
    }

    fn restore(&mut self, state: &StepState<C>) -> Result<(), SceneError> {
        Simulation::restore(self, state)
    }

    fn remember(&mut self, control: ControlState) {
        let largest_motion = self.state.control.largest_motion;
        self.state.control = ControlState {
            largest_motion,
            ..control
        };
    }
}

compiled! {
    fn estimated<C>(
        own: &mut Simulation<C>,
        dt: f64,
        control: &ErrorControl,
    ) -> Result<LocalError, StepFailure> {
        compare(own, dt, control)
    }

    fn undo<C>(own: &mut Simulation<C>) {
        if let Some(comparison) = &mut own.comparison {
            mem::swap(&mut own.state, &mut comparison.end);
            own.work.balanced = None;
            own.show();
        }
    }
}

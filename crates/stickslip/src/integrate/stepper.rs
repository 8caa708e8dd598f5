//! The interface of time steppers.

use std::mem;
use std::ops::ControlFlow;

use super::compare::compare;
use super::crossing::Crossing;
use super::drive::drive;
use super::{RunReport, Steps};
use stickslip_core::compiled;

use crate::{
    ControlState, ErrorControl, LocalError, SceneError, Simulation, Snapshot, StepError,
    StepFailure, StepReport, StepState,
};

/// A scene with any time-stepping method: [`Simulation`], [`RungeKutta`](crate::RungeKutta), or one of the user's own.
/// A `Box<dyn Stepper<C>>` holds any of them; [`Run`] drives it.
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

impl<S: Stepper<C> + ?Sized, const C: usize> Stepper<C> for &mut S {
    fn step(&mut self, dt: f64) -> Result<StepReport, StepFailure> {
        (**self).step(dt)
    }

    fn step_estimated(
        &mut self,
        dt: f64,
        control: &ErrorControl,
    ) -> Result<LocalError, StepFailure> {
        (**self).step_estimated(dt, control)
    }

    fn error_order(&self, control: &ErrorControl) -> usize {
        (**self).error_order(control)
    }

    fn check_control(&self, control: &ErrorControl) -> Result<(), StepError> {
        (**self).check_control(control)
    }

    fn is_resisted(&self) -> bool {
        (**self).is_resisted()
    }

    fn stable_step(&mut self) -> Option<f64> {
        (**self).stable_step()
    }

    fn set_stops(&mut self, stops: &[f64]) {
        (**self).set_stops(stops);
    }

    fn undo(&mut self) {
        (**self).undo();
    }

    fn state(&self) -> &StepState<C> {
        (**self).state()
    }

    fn snapshot(&self) -> Snapshot<'_, C> {
        (**self).snapshot()
    }

    fn restore(&mut self, state: &StepState<C>) -> Result<(), SceneError> {
        (**self).restore(state)
    }

    fn remember(&mut self, control: ControlState) {
        (**self).remember(control);
    }
}

/// Whether a run continues after a step: the result of an observer, nothing or a [`ControlFlow`].
pub trait IntoControlFlow {
    /// The result as a control flow.
    fn flow(self) -> ControlFlow<()>;
}

impl IntoControlFlow for () {
    fn flow(self) -> ControlFlow<()> {
        ControlFlow::Continue(())
    }
}

impl IntoControlFlow for ControlFlow<()> {
    fn flow(self) -> ControlFlow<()> {
        self
    }
}

/// Runs of any [`Stepper`]; implemented for all of them.
pub trait Run<const C: usize>: Stepper<C> {
    /// Takes the steps of a plan and shows each accepted one to `observe`, which ends the run by
    /// [`ControlFlow::Break`].
    ///
    /// # Errors
    /// A [`StepFailure`] of a constant step that fails in all its substeps, or at once by
    /// [`without_substeps`](Steps::without_substeps); of an adaptive step that fails at every size allowed, or of a run
    /// that stalls ([`StepError::StepTooSmall`], [`StepError::TooManySteps`]); [`StepError::Control`] and
    /// [`StepError::Option`] for a plan that is inconsistent. The last accepted step stays in place.
    fn run<V: IntoControlFlow>(
        &mut self,
        steps: &Steps,
        mut observe: impl FnMut(Snapshot<'_, C>) -> V,
    ) -> Result<RunReport, StepFailure> {
        let mut own = self;
        drive(&mut own, steps, None, &mut |at| observe(at).flow())
    }

    /// Runs until `value` passes zero from below, and ends at the first time at which it is not negative, to
    /// `tolerance` \[s\]: the step is repeated with other sizes until the time is located. Failed constant steps are
    /// not split here.
    ///
    /// The value is known at the ends of steps: one that passes zero and returns within a step is not seen. Steps
    /// shorter than the shortest time above zero see it, by [`with_max_step`](Steps::with_max_step), a smaller constant
    /// step, or declared stops.
    ///
    /// # Errors
    /// Those of [`run`](Run::run); [`StepError::Control`] at the time at which `value` is NaN.
    fn run_to_crossing<V: IntoControlFlow>(
        &mut self,
        steps: &Steps,
        tolerance: f64,
        mut value: impl FnMut(Snapshot<'_, C>) -> f64,
        mut observe: impl FnMut(Snapshot<'_, C>) -> V,
    ) -> Result<RunReport, StepFailure> {
        let crossing = Crossing {
            tolerance,
            value: &mut value,
            last: f64::NAN,
            before: None,
        };
        let mut own = self;
        drive(&mut own, steps, Some(crossing), &mut |at| {
            observe(at).flow()
        })
    }
}

impl<S: Stepper<C> + ?Sized, const C: usize> Run<C> for S {}

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

/// Runs without [`Run`] in scope.
impl<const C: usize> Simulation<C> {
    /// Takes the steps of a plan and shows each accepted one to `observe`, see [`Run::run`].
    ///
    /// # Errors
    /// Those of [`Run::run`].
    pub fn run<V: IntoControlFlow>(
        &mut self,
        steps: &Steps,
        observe: impl FnMut(Snapshot<'_, C>) -> V,
    ) -> Result<RunReport, StepFailure> {
        Run::run(self, steps, observe)
    }

    /// Runs until `value` passes zero from below, see [`Run::run_to_crossing`].
    ///
    /// # Errors
    /// Those of [`Run::run`].
    pub fn run_to_crossing<V: IntoControlFlow>(
        &mut self,
        steps: &Steps,
        tolerance: f64,
        value: impl FnMut(Snapshot<'_, C>) -> f64,
        observe: impl FnMut(Snapshot<'_, C>) -> V,
    ) -> Result<RunReport, StepFailure> {
        Run::run_to_crossing(self, steps, tolerance, value, observe)
    }

    /// The order in time of rate and state together.
    pub fn order(&self) -> usize {
        self.problem.method.order()
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

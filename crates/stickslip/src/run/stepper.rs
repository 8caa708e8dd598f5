//! What goes through time, whatever its method.

use std::ops::ControlFlow;

use super::crossing::Crossing;
use super::drive::drive;
use super::growth::extrapolated_growth;
use super::{RunReport, Steps};
use crate::{
    ControlState, ErrorControl, Failure, LocalError, SceneError, Simulation, Snapshot, StepError,
    StepReport, StepState,
};
use stickslip_tnnmg::Operator;

/// A scene in motion by any method: [`Simulation`], [`RungeKutta`](crate::RungeKutta), or one of your own. A
/// `Box<dyn Stepper<C>>` holds any of them; [`Run`] drives it.
pub trait Stepper<const C: usize>: Send {
    /// Takes one step of `dt` \[s\].
    ///
    /// # Errors
    /// [`Failure`]; the last accepted step stays in place and another `dt` may be tried.
    fn step(&mut self, dt: f64) -> Result<StepReport, Failure>;

    /// Takes a step of `dt` \[s\] and returns its estimated local error, see [`ErrorControl`].
    ///
    /// # Errors
    /// [`Failure`]; the last accepted step stays in place and another `dt` may be tried.
    fn step_estimated(&mut self, dt: f64, control: &ErrorControl) -> Result<LocalError, Failure>;

    /// The power of the step with which the estimated error falls.
    fn error_order(&self, control: &ErrorControl) -> usize;

    /// Refuses an error control that the method cannot take; none by default.
    ///
    /// # Errors
    /// [`StepError`] that says why.
    fn check_control(&self, control: &ErrorControl) -> Result<(), StepError> {
        let _ = control;
        Ok(())
    }

    /// Whether inertia or damping resists the body, so that steps that are small enough follow slip that runs away; true
    /// by default.
    fn is_resisted(&self) -> bool {
        true
    }

    /// Takes the last [`step_estimated`](Stepper::step_estimated) back.
    fn undo(&mut self);

    /// The last accepted step, as seen.
    fn snapshot(&self) -> Snapshot<'_, C>;

    /// Goes to another state of the same scene.
    ///
    /// # Errors
    /// [`SceneError::Foreign`] for one of another scene.
    fn restore(&mut self, state: &StepState<C>) -> Result<(), SceneError>;

    /// Keeps what a run with adaptive steps goes on with, as a part of the state.
    fn remember(&mut self, control: ControlState);
}

/// Whether a run goes on after a step: an observer returns nothing, or says so.
pub trait Verdict {
    /// As a control flow.
    fn flow(self) -> ControlFlow<()>;
}

impl Verdict for () {
    fn flow(self) -> ControlFlow<()> {
        ControlFlow::Continue(())
    }
}

impl Verdict for ControlFlow<()> {
    fn flow(self) -> ControlFlow<()> {
        self
    }
}

/// Runs of any [`Stepper`]; implemented for all of them.
pub trait Run<const C: usize>: Stepper<C> {
    /// Takes the steps of a plan and shows each accepted one to `observe`, which may end the run by
    /// [`ControlFlow::Break`].
    ///
    /// # Errors
    /// A [`Failure`] of the first step that fails, or, with adaptive steps, of one that fails at every size
    /// allowed; with [`StepError::Control`](crate::StepError::Control) for a plan that makes no sense. The last
    /// accepted step stays in place.
    fn run<V: Verdict>(
        &mut self,
        steps: &Steps,
        mut observe: impl FnMut(Snapshot<'_, C>) -> V,
    ) -> Result<RunReport, Failure> {
        drive(self, steps, None, &mut |at| observe(at).flow())
    }

    /// Runs until `value` passes zero from below, and ends with the first time at which it is not negative,
    /// to `tolerance` \[s\]: the step is taken again with other sizes until that is known.
    ///
    /// # Errors
    /// Those of [`run`](Run::run).
    fn run_to_crossing<V: Verdict>(
        &mut self,
        steps: &Steps,
        tolerance: f64,
        mut value: impl FnMut(Snapshot<'_, C>) -> f64,
        mut observe: impl FnMut(Snapshot<'_, C>) -> V,
    ) -> Result<RunReport, Failure> {
        let crossing = Crossing {
            tolerance,
            value: &mut value,
            last: f64::NAN,
            before: None,
        };
        drive(self, steps, Some(crossing), &mut |at| observe(at).flow())
    }
}

impl<S: Stepper<C> + ?Sized, const C: usize> Run<C> for S {}

impl<Op: Operator<C>, const C: usize> Stepper<C> for Simulation<Op, C> {
    fn step(&mut self, dt: f64) -> Result<StepReport, Failure> {
        Simulation::step(self, dt)
    }

    fn step_estimated(&mut self, dt: f64, control: &ErrorControl) -> Result<LocalError, Failure> {
        let error = self.compare(dt, control)?;
        self.seen.show(&self.state);
        Ok(error)
    }

    fn error_order(&self, control: &ErrorControl) -> usize {
        control.error_order(self.order(), self.is_symmetric())
    }

    fn check_control(&self, control: &ErrorControl) -> Result<(), StepError> {
        let waves = self.scene.mass.is_some() && self.state.velocity.len() > 1;
        if !(control.extrapolate && waves) {
            return Ok(());
        }
        let levels = control.levels_for(self.order(), self.is_symmetric());
        let growth = extrapolated_growth(self.scheme(), levels, self.error_power());
        // An eigenvalue of modulus 1 is known to rounding.
        if growth > 1.0 + 1e-6 {
            return Err(StepError::Extrapolation { growth });
        }
        Ok(())
    }

    fn is_resisted(&self) -> bool {
        Simulation::is_resisted(self)
    }

    fn undo(&mut self) {
        if let Some(comparison) = self.comparison.take() {
            self.set_state(&comparison.start);
            self.seen.show(&self.state);
            self.comparison = Some(comparison);
        }
    }

    fn snapshot(&self) -> Snapshot<'_, C> {
        Simulation::snapshot(self)
    }

    fn restore(&mut self, state: &StepState<C>) -> Result<(), SceneError> {
        Simulation::restore(self, state)
    }

    fn remember(&mut self, control: ControlState) {
        // Known to the estimate of the error alone.
        let onset = self.state.control.onset;
        self.state.control = ControlState { onset, ..control };
    }
}

/// The same without a trait in scope.
impl<Op: Operator<C>, const C: usize> Simulation<Op, C> {
    /// Takes the steps of a plan and shows each accepted one to `observe`, see [`Run::run`].
    ///
    /// # Errors
    /// Those of [`Run::run`].
    pub fn run<V: Verdict>(
        &mut self,
        steps: &Steps,
        observe: impl FnMut(Snapshot<'_, C>) -> V,
    ) -> Result<RunReport, Failure> {
        Run::run(self, steps, observe)
    }

    /// Runs until `value` passes zero from below, see [`Run::run_to_crossing`].
    ///
    /// # Errors
    /// Those of [`Run::run`].
    pub fn run_to_crossing<V: Verdict>(
        &mut self,
        steps: &Steps,
        tolerance: f64,
        value: impl FnMut(Snapshot<'_, C>) -> f64,
        observe: impl FnMut(Snapshot<'_, C>) -> V,
    ) -> Result<RunReport, Failure> {
        Run::run_to_crossing(self, steps, tolerance, value, observe)
    }

    /// The order in time of rate and state together.
    pub fn order(&self) -> usize {
        self.method.order(self.contacts.have_state())
    }

    /// The power of the step by which levels are extrapolated.
    pub(crate) fn error_power(&self) -> i32 {
        if self.order() > 1 { 2 } else { 1 }
    }

    /// Whether the error has even powers of the step only.
    pub(crate) fn is_symmetric(&self) -> bool {
        self.method.is_symmetric(self.contacts.have_state())
    }
}

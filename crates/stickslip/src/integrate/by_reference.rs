//! A reference to a stepper is one.

use super::stepper::Stepper;
use crate::{
    ControlState, ErrorControl, LocalError, SceneError, Snapshot, StepError, StepFailure,
    StepReport, StepState,
};

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

    fn is_dense(&self) -> bool {
        (**self).is_dense()
    }

    fn show_inside(
        &mut self,
        times: &[f64],
        show: &mut dyn FnMut(Snapshot<'_, C>),
    ) -> Result<(), StepFailure> {
        (**self).show_inside(times, show)
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

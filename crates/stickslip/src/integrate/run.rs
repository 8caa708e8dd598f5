//! Runs of time steppers.

use std::ops::ControlFlow;

use super::crossing::Crossing;
use super::drive::drive;
use super::sampling::Sampling;
use super::stepper::Stepper;
use super::{RunReport, Steps};
use crate::{Simulation, Snapshot, StepFailure};

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
    /// that stalls ([`StepError::StepTooSmall`](crate::StepError::StepTooSmall),
    /// [`StepError::TooManySteps`](crate::StepError::TooManySteps)); [`StepError::Control`](crate::StepError::Control)
    /// and [`StepError::Option`](crate::StepError::Option) for a plan that is inconsistent. The last accepted step stays
    /// in place.
    fn run<V: IntoControlFlow>(
        &mut self,
        steps: &Steps,
        mut observe: impl FnMut(Snapshot<'_, C>) -> V,
    ) -> Result<RunReport, StepFailure> {
        let mut own = self;
        drive(&mut own, steps, (None, None), &mut |at| observe(at).flow())
    }

    /// Takes the steps of a plan as [`run`](Run::run) does, and shows to `sample` the motion at increasing `times` \[s\],
    /// from the present one to the end.
    ///
    /// [`RungeKutta`](crate::RungeKutta) shows times inside of its steps, which stay as they are, by a continuous extension
    /// of order 4: slip and state as accurate as the steps, slip rates in balance with them. Other methods end a step at
    /// each of the times, and so does `RungeKutta` where the state follows the normal stress or fields have a memory.
    ///
    /// ```
    /// use stickslip::problems::spring_slider::{AGING, FRICTION, LoadPath, SpringSlider};
    /// use stickslip::{Run, RungeKutta, Steps};
    ///
    /// # let load = LoadPath::steady(1e-6);
    /// # let slider = SpringSlider { stiffness: 2.5e8, normal_stress: 1e6, mass: 0.0, damping: 5e6, load };
    /// let mut cycle = RungeKutta::new(slider.steady(FRICTION, AGING, 1.1e-6)?)?;
    /// let times: Vec<f64> = (0..=600).map(f64::from).collect();
    /// let mut slip = Vec::new();
    /// let steps = Steps::adaptive(1e-6).until(600.0);
    /// cycle.run_sampled(&steps, &times, |at| slip.push(at.displacement[0][0]), |_| ())?;
    /// assert_eq!(slip.len(), 601);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// Those of [`run`](Run::run); [`StepError::Control`](crate::StepError::Control) for times that decrease, are not
    /// finite, or lie before the present one.
    #[doc(alias("dense output", "t_eval"))]
    fn run_sampled<V: IntoControlFlow>(
        &mut self,
        steps: &Steps,
        times: &[f64],
        mut sample: impl FnMut(Snapshot<'_, C>),
        mut observe: impl FnMut(Snapshot<'_, C>) -> V,
    ) -> Result<RunReport, StepFailure> {
        let mut own = self;
        let stopping;
        let steps = if own.is_dense() {
            steps
        } else {
            stopping = steps.clone().stopping_at(times.iter().copied());
            &stopping
        };
        let sampling = Sampling {
            times,
            show: &mut sample,
        };
        drive(&mut own, steps, (None, Some(sampling)), &mut |at| {
            observe(at).flow()
        })
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
    /// Those of [`run`](Run::run); [`StepError::Control`](crate::StepError::Control) at the time at which `value` is NaN.
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
        drive(&mut own, steps, (Some(crossing), None), &mut |at| {
            observe(at).flow()
        })
    }
}

impl<S: Stepper<C> + ?Sized, const C: usize> Run<C> for S {}

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

//! The functions of a simulation that are compiled here, for each number of components.

use std::mem;

use stickslip_core::compiled;

use crate::step;
use crate::view::{self, StepView};
use crate::{
    Convexity, Residuals, SceneError, Simulation, StepError, StepFailure, StepReport, StepState,
};

compiled! {
    pub(super) fn take_step<C>(own: &mut Simulation<C>, dt: f64) -> Result<StepReport, StepFailure> {
        let taken = step::step(&own.problem, &mut own.work, &own.state, dt);
        let report = taken.map_err(|cause| {
            let failure = StepFailure::of(&own.state.clock.after(dt), cause);
            failure.placed(|vertex| own.snapshot().place_of(vertex))
        })?;
        mem::swap(&mut own.state, &mut own.work.end);
        own.show();
        Ok(report)
    }

    pub(super) fn restore<C>(own: &mut Simulation<C>, state: &StepState<C>) -> Result<(), SceneError> {
        state.check_fits(&own.state)?;
        own.state.copy_from(state);
        own.work.balanced = None;
        own.show();
        if let Some(comparison) = &mut own.comparison {
            comparison.forget();
        }
        Ok(())
    }

    pub(super) fn copy<C>(own: &Simulation<C>) -> Simulation<C> {
        Simulation {
            problem: own.problem.clone(),
            work: own.work.clone(),
            state: own.state.clone(),
            comparison: own.comparison.clone(),
            fields: own.fields.clone(),
            applied: own.applied.clone(),
        }
    }

    pub(super) fn view_of<C>(own: &Simulation<C>) -> &dyn StepView<C> {
        own
    }

    pub(super) fn convexity<C>(
        own: &mut Simulation<C>,
        dt: f64,
        max_slip_rate: f64,
    ) -> Result<Convexity, StepError> {
        let Simulation {
            problem,
            work,
            state,
            ..
        } = own;
        step::convexity(problem, work, state, dt, max_slip_rate)
    }

    pub(super) fn residuals<C>(own: &Simulation<C>, from: &StepState<C>) -> Residuals {
        view::residuals(own, from)
    }
}

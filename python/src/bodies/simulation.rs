//! Runs of a body.

use std::ops::ControlFlow;
use std::sync::{Mutex, MutexGuard};

use numpy::PyArray1;
use pyo3::exceptions::{PyRuntimeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyBytes;
use stickslip::integrate::{RunReport, Stepper};
use stickslip::{Snapshot, StepState, Steps};

use super::reduced::Whole;
use super::state::BodyState;
use crate::arguments::{count, positive};
use crate::errors::{self, argument};
use crate::exit::Call;
use crate::raised::Raised;
use crate::run::{Ended, run};

/// A body in time. Threads may share it; it runs in one of them at a time.
#[pyclass(frozen, module = "stickslip")]
pub(crate) struct BodySimulation {
    stepper: Mutex<AnyStepper>,
    raised: Raised,
}

/// A simulation by the number of components of its velocity.
pub(super) enum AnyStepper {
    Antiplane(Moving<1>),
    Plane(Moving<2>),
    Space(Moving<3>),
}

/// A simulation, and the way back to the whole body if it is a reduced one.
pub(super) struct Moving<const C: usize> {
    pub(super) stepper: Box<dyn Stepper<C>>,
    pub(super) whole: Option<Whole<C>>,
}

macro_rules! each {
    ($any:expr, $body:ident => $work:expr) => {
        match $any {
            AnyStepper::Antiplane($body) => $work,
            AnyStepper::Plane($body) => $work,
            AnyStepper::Space($body) => $work,
        }
    };
}

#[pymethods]
impl BodySimulation {
    /// Takes steps and yields the body after every few of them, and at the end.
    ///
    ///     for at in simulation.run(until=10.0, dt=1e-3, every=100):
    ///         print(at.time, at.max_slip_rate)
    ///
    /// The interpreter's lock is free during steps; Ctrl-C ends the run between two of them.
    ///
    /// Args:
    ///     until: end [s], after the present time.
    ///     steps: number of steps, in the place of `until` or beside it.
    ///     dt: constant steps [s], > 0; the last one is shortened to `until`.
    ///     rtol: steps by error control instead, with this relative tolerance.
    ///     every: number of steps between two states.
    #[pyo3(signature = (*, until=None, steps=None, dt=None, rtol=None, every=1))]
    fn run(
        slf: Bound<'_, Self>,
        until: Option<f64>,
        steps: Option<usize>,
        dt: Option<f64>,
        rtol: Option<f64>,
        every: usize,
    ) -> PyResult<BodyRun> {
        let mut plan = match (dt, rtol) {
            (Some(dt), None) => Steps::constant(positive("dt", dt)?),
            (None, Some(rtol)) => Steps::adaptive(positive("rtol", rtol)?),
            _ => return Err(PyValueError::new_err("give dt or rtol, one of them")),
        };
        if until.is_none() && steps.is_none() {
            return Err(PyValueError::new_err("give until or steps, or both"));
        }
        if let Some(end) = until {
            let now = slf.get().time()?;
            if !(end.is_finite() && end > now) {
                return Err(argument(
                    "until",
                    &format!("after the present time {now} s"),
                    end,
                ));
            }
            plan = plan.until(end);
        }
        Ok(BodyRun {
            simulation: slf.unbind(),
            plan,
            until,
            left: steps.map(|steps| count("steps", steps)).transpose()?,
            every: count("every", every)?,
        })
    }

    /// Takes one step of `dt` [s] and returns the body after it.
    fn step(&self, py: Python<'_>, dt: f64) -> PyResult<BodyState> {
        self.advance(py, &Steps::constant(positive("dt", dt)?).count(1))?;
        self.now(py)
    }

    /// The body at the present time.
    fn now(&self, py: Python<'_>) -> PyResult<BodyState> {
        each!(&*self.lock()?, body => BodyState::new(py, &body.stepper.snapshot(), body.whole.as_ref()))
    }

    /// The present time [s].
    #[getter]
    fn time(&self) -> PyResult<f64> {
        Ok(each!(&*self.lock()?, body => body.stepper.snapshot().time))
    }

    /// The frequencies of the modes of a reduced body [Hz], the lowest first; none of a whole one.
    #[getter]
    fn frequencies<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray1<f64>>> {
        let frequencies =
            each!(&*self.lock()?, body => body.whole.as_ref().map(|whole| whole.frequencies()));
        Ok(PyArray1::from_vec(py, frequencies.unwrap_or_default()))
    }

    /// All that later steps depend on, as bytes, which can be kept and pickled.
    fn state<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyBytes>> {
        let bytes = each!(&*self.lock()?, body => {
            let state: &StepState<_> = body.stepper.snapshot().state();
            postcard::to_allocvec(state)
        });
        let bytes = bytes.map_err(|error| PyRuntimeError::new_err(error.to_string()))?;
        Ok(PyBytes::new(py, &bytes))
    }

    /// Goes on from a state of the same body with the same parts and contacts: the next steps have the same bits.
    fn restore(&self, py: Python<'_>, state: &[u8]) -> PyResult<()> {
        each!(&mut *self.lock()?, body => {
            let state = postcard::from_bytes(state)
                .map_err(|_| argument("state", "the bytes of a state of such a body", state.len()))?;
            body.stepper.restore(&state).map_err(|error| errors::scene(py, &error))
        })
    }
}

impl BodySimulation {
    pub(super) fn new(stepper: AnyStepper, raised: Raised) -> Self {
        Self {
            stepper: Mutex::new(stepper),
            raised,
        }
    }

    /// The stepper, unless another thread runs it.
    fn lock(&self) -> PyResult<MutexGuard<'_, AnyStepper>> {
        let busy = "the simulation runs in another thread, or in a function that it calls";
        (self.stepper.try_lock()).map_err(|_| PyRuntimeError::new_err(busy))
    }

    /// Takes the steps of a plan.
    fn advance(&self, py: Python<'_>, steps: &Steps) -> PyResult<RunReport> {
        let call = Call::begin()?;
        let mut stepper = self.lock()?;
        let ended = each!(&mut *stepper, body => {
            run((py, &call, &self.raised), &mut *body.stepper, steps, nothing)
        });
        ended.map_err(|ended| match ended {
            Ended::Raised(error) => error,
            Ended::Failed(failure) => errors::failure(py, &failure),
        })
    }
}

fn nothing<const C: usize>(_: &Snapshot<'_, C>) -> PyResult<ControlFlow<()>> {
    Ok(ControlFlow::Continue(()))
}

/// The states of a run, one after the other.
#[pyclass(module = "stickslip")]
pub(crate) struct BodyRun {
    simulation: Py<BodySimulation>,
    plan: Steps,
    until: Option<f64>,
    left: Option<usize>,
    every: usize,
}

#[pymethods]
impl BodyRun {
    fn __iter__(slf: PyRef<'_, Self>) -> PyRef<'_, Self> {
        slf
    }

    fn __next__(&mut self, py: Python<'_>) -> PyResult<Option<BodyState>> {
        let simulation = self.simulation.get();
        let steps = self.left.map_or(self.every, |left| left.min(self.every));
        if steps == 0 {
            return Ok(None);
        }
        if let Some(end) = self.until
            && simulation.time()? >= end
        {
            return Ok(None);
        }
        let report = simulation.advance(py, &self.plan.clone().count(steps))?;
        if let Some(left) = &mut self.left {
            *left = left.saturating_sub(report.accepted);
        }
        if report.accepted == 0 {
            return Ok(None);
        }
        simulation.now(py).map(Some)
    }
}

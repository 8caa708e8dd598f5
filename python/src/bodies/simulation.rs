//! Runs of a body.

use std::ops::ControlFlow;
use std::path::PathBuf;
use std::sync::{Mutex, MutexGuard};

use numpy::PyArray1;
use pyo3::exceptions::{PyRuntimeError, PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyBytes;
use stickslip::integrate::{RunReport, Stepper};
use stickslip::{Snapshot, Steps};

use super::reduced::Whole;
use super::state::BodyState;
use crate::arguments::{count, named, positive};
use crate::errors::{self, argument};
use crate::exit::Call;
use crate::progress::Progress;
use crate::raised::Raised;
use crate::restart::{self, state_bytes};
use crate::run::{Course, Ended, run};

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
    ///     progress: whether a bar of tqdm, if it is installed, or a line shows the time reached, of a run with `until`.
    #[pyo3(signature = (*, until=None, steps=None, dt=None, rtol=None, every=1, progress=false))]
    fn run(
        slf: Bound<'_, Self>,
        #[pyo3(from_py_with = named)] until: Option<f64>,
        #[pyo3(from_py_with = named)] steps: Option<usize>,
        #[pyo3(from_py_with = named)] dt: Option<f64>,
        #[pyo3(from_py_with = named)] rtol: Option<f64>,
        #[pyo3(from_py_with = named)] every: usize,
        #[pyo3(from_py_with = named)] progress: bool,
    ) -> PyResult<BodyRun> {
        let mut plan = match (dt, rtol) {
            (Some(dt), None) => Steps::constant(positive("dt", dt)?),
            (None, Some(rtol)) => Steps::adaptive(positive("rtol", rtol)?),
            _ => return Err(PyValueError::new_err("give dt or rtol, one of them")),
        };
        if until.is_none() && steps.is_none() {
            return Err(PyValueError::new_err("give until or steps, or both"));
        }
        let mut shown = None;
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
            shown = Progress::new(slf.py(), progress, [now, end])?.map(|shown| shown.until(end));
        }
        Ok(BodyRun {
            simulation: slf.unbind(),
            plan,
            until,
            left: steps.map(|steps| count("steps", steps)).transpose()?,
            every: count("every", every)?,
            progress: shown,
        })
    }

    /// Takes one step of `dt` [s] and returns the body after it.
    fn step(&self, py: Python<'_>, #[pyo3(from_py_with = named)] dt: f64) -> PyResult<BodyState> {
        self.advance(py, &Steps::constant(positive("dt", dt)?).count(1), None)?;
        self.now(py)
    }

    /// The body at the present time.
    fn now(&self, py: Python<'_>) -> PyResult<BodyState> {
        each!(&*self.lock()?, body => BodyState::of(py, &body.stepper.snapshot(), body.whole.as_ref()))
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
        each!(&*self.lock()?, body => state_bytes(py, &body.stepper.snapshot()))
    }

    /// Goes on from a state of the same body with the same parts and contacts: the next steps have the same bits.
    fn restore(&self, py: Python<'_>, #[pyo3(from_py_with = named)] state: &[u8]) -> PyResult<()> {
        each!(&mut *self.lock()?, body => restart::restore(py, "state", &mut *body.stepper, state))
    }

    /// Writes a checkpoint: a file from which a simulation of the same body goes on.
    ///
    /// Raises:
    ///     OSError: for a file that cannot be written; an older one stays.
    fn save(&self, py: Python<'_>, #[pyo3(from_py_with = named)] path: PathBuf) -> PyResult<()> {
        each!(&*self.lock()?, body => restart::save(py, &path, &body.stepper.snapshot(), &()))
    }

    /// Goes on from a checkpoint of a simulation of the same body: the next steps have the same bits.
    ///
    /// Raises:
    ///     OSError: for a file that cannot be read.
    ///     FileError: for a file that is damaged or no checkpoint, or that of another body.
    fn load(&self, py: Python<'_>, #[pyo3(from_py_with = named)] path: PathBuf) -> PyResult<()> {
        each!(&mut *self.lock()?, body => restart::load(py, &path, &mut *body.stepper))
    }

    fn __reduce__(&self) -> PyResult<Py<PyAny>> {
        let message =
            "a BodySimulation is not pickled: pickle its state(), and restore it into another one";
        Err(PyTypeError::new_err(message))
    }

    fn __repr__(&self) -> PyResult<String> {
        let (time, vertices) = each!(&*self.lock()?, body => {
            let at = body.stepper.snapshot();
            (at.time, at.velocity.len())
        });
        Ok(format!("BodySimulation({vertices} vertices, time={time})"))
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
    fn advance(
        &self,
        py: Python<'_>,
        steps: &Steps,
        progress: Option<&mut Progress>,
    ) -> PyResult<RunReport> {
        let call = Call::begin()?;
        let mut stepper = self.lock()?;
        let course = Course {
            steps,
            times: &[],
            progress,
        };
        let ended = each!(&mut *stepper, body => {
            run((py, &call, &self.raised), &mut *body.stepper, course, |_| (), nothing)
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
    progress: Option<Progress>,
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
        let report =
            simulation.advance(py, &self.plan.clone().count(steps), self.progress.as_mut())?;
        if let Some(left) = &mut self.left {
            *left = left.saturating_sub(report.accepted);
        }
        if report.accepted == 0 {
            return Ok(None);
        }
        simulation.now(py).map(Some)
    }
}

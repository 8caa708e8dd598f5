//! Runs of a fault.

use std::path::PathBuf;
use std::sync::{Mutex, MutexGuard};

use pyo3::exceptions::{PyRuntimeError, PyTypeError};
use pyo3::prelude::*;
use pyo3::types::PyBytes;
use stickslip::integrate::Stepper;
use stickslip::record::EventCatalogue;
use stickslip::{StepState, Steps};

use super::advance::Plan;
use super::events::table;
use super::receivers::Receivers;
use super::record::FaultRun;
use super::seas::SeasFiles;
use crate::arguments::{Numbers, count, finite, named, positive, sample_times};
use crate::errors::{self, argument};
use crate::exit::Call;
use crate::progress::Progress;
use crate::raised::Raised;
use crate::restart::{self, packed, unpacked};

/// A motion with one component of slip or two, and its catalogue of events.
pub(super) enum Motion {
    One(Box<dyn Stepper<1>>, Option<EventCatalogue<1>>),
    Two(Box<dyn Stepper<2>>, Option<EventCatalogue<2>>),
}

/// Does the same with one component and with two.
macro_rules! each {
    ($any:expr, $stepper:ident, $catalogue:pat => $work:expr) => {
        match $any {
            Motion::One($stepper, $catalogue) => $work,
            Motion::Two($stepper, $catalogue) => $work,
        }
    };
}

/// The number of steps of a call after which it fails by default.
const MAX_STEPS: usize = 2_000_000;

/// A fault in time, by an explicit Runge-Kutta method of order 5. Threads may share it; it runs in one at a time.
#[pyclass(frozen, module = "stickslip")]
pub(crate) struct FaultSimulation {
    motion: Mutex<Motion>,
    /// Shear modulus \[Pa\], and the directions of the components of slip on a plane.
    pub(super) medium: (f64, Vec<[f64; 2]>),
    pub(super) raised: Raised,
}

impl FaultSimulation {
    pub(super) fn new(motion: Motion, medium: (f64, Vec<[f64; 2]>), raised: Raised) -> Self {
        Self {
            motion: Mutex::new(motion),
            medium,
            raised,
        }
    }

    /// The motion, unless another thread runs it.
    fn lock(&self) -> PyResult<MutexGuard<'_, Motion>> {
        let busy = "the simulation runs in another thread, or in its callback";
        (self.motion.try_lock()).map_err(|_| PyRuntimeError::new_err(busy))
    }
}

#[pymethods]
impl FaultSimulation {
    /// Takes adaptive steps from the present time on.
    ///
    /// The interpreter's lock is free between calls of `callback`; Ctrl-C ends the run between two steps.
    ///
    /// Args:
    ///     until: end [s], after the present time.
    ///     every: number of steps between two samples of all cells, and between two calls of `callback`.
    ///     rtol: local error of a step in ln V and in the state.
    ///     max_steps: number of steps of this call after which it fails; None for no limit.
    ///     callback: function of the time [s] and the largest slip rate [m/s], which returns None, or a bool: True ends the
    ///         run.
    ///     threshold: slip rates [m/s] at which an event begins and ends, the second one not larger.
    ///     stops: times [s] at which a step ends.
    ///     seas: SeasFiles to write during the run.
    ///     t_eval: times [s] of the samples, in order, from the present one to `until`, in the place of every few steps: inside
    ///         of steps, which stay as they are, by a continuous extension of the method.
    ///     receivers: points off the fault, whose displacement and velocity are sampled, too.
    ///     progress: whether a bar of tqdm, if it is installed, or a line shows the time reached.
    ///
    /// Returns:
    ///     FaultRun: arrays over time and cells, and the events that end in the call, and the one under way at its end.
    ///         The next call with the same thresholds goes on with that one.
    ///
    /// Raises:
    ///     StepError: for a step that fails; the samples up to there are its `partial`.
    ///     OSError: for a file that cannot be written.
    #[pyo3(signature = (until, *, every=10, rtol=1e-6, max_steps=Some(MAX_STEPS), callback=None, threshold=[1e-2, 1e-3], stops=Numbers(Vec::new()), seas=None, t_eval=None, receivers=None, progress=false),
           text_signature = "($self, until, *, every=10, rtol=1e-06, max_steps=2000000, callback=None, threshold=(0.01, 0.001), stops=[], seas=None, t_eval=None, receivers=None, progress=False)")]
    #[expect(clippy::too_many_arguments, reason = "keywords in Python")]
    fn run(
        &self,
        py: Python<'_>,
        #[pyo3(from_py_with = named)] until: f64,
        #[pyo3(from_py_with = named)] every: usize,
        #[pyo3(from_py_with = named)] rtol: f64,
        #[pyo3(from_py_with = named)] max_steps: Option<usize>,
        callback: Option<Py<PyAny>>,
        #[pyo3(from_py_with = named)] threshold: [f64; 2],
        #[pyo3(from_py_with = named)] stops: Numbers,
        #[pyo3(from_py_with = named)] seas: Option<Bound<'_, SeasFiles>>,
        #[pyo3(from_py_with = named)] t_eval: Option<Numbers>,
        #[pyo3(from_py_with = named)] receivers: Option<Bound<'_, Receivers>>,
        #[pyo3(from_py_with = named)] progress: bool,
    ) -> PyResult<FaultRun> {
        let call = Call::begin()?;
        let every = count("every", every)?;
        let mut motion = self.lock()?;
        let now = each!(&*motion, stepper, _ => stepper.snapshot().time);
        if !(until.is_finite() && until > now) {
            let requirement = format!("after the present time {now} s");
            return Err(argument("until", &requirement, until));
        }
        let max_steps = max_steps.map(|number| count("max_steps", number));
        let max_steps = max_steps.transpose()?.unwrap_or(usize::MAX);
        let [begins, ends] = threshold;
        if positive("threshold[1]", ends)? > positive("threshold[0]", begins)? {
            let requirement = "a pair (begin, end) with end <= begin";
            return Err(argument("threshold", requirement, threshold));
        }
        if let Some(callback) = &callback
            && !callback.bind(py).is_callable()
        {
            return Err(argument(
                "callback",
                "a function",
                callback.bind(py).repr()?.to_string(),
            ));
        }
        let Numbers(stops) = stops;
        for (n, &stop) in stops.iter().enumerate() {
            finite(&format!("stops[{n}]"), stop)?;
        }
        let steps = Steps::adaptive(positive("rtol", rtol)?)
            .with_max_steps(max_steps)
            .stopping_at(stops)
            .until(until);
        let plan = Plan {
            until,
            every,
            steps,
            times: sample_times(t_eval, [now, until])?,
            callback,
            threshold: [begins, ends],
            seas: seas.as_ref().map(Bound::get),
            receivers: receivers.as_ref().map(Bound::get),
            progress: Progress::new(py, progress, [now, until])?,
        };
        each!(&mut *motion, stepper, catalogue => {
            self.advance((py, &call), &mut **stepper, catalogue, plan)
        })
    }

    /// The present time [s].
    #[getter]
    fn time(&self) -> PyResult<f64> {
        Ok(each!(&*self.lock()?, stepper, _ => stepper.snapshot().time))
    }

    /// The events of all runs, also of those before a restart, and the one under way: a structured array as that of a run,
    /// with the thresholds of the last run.
    #[getter]
    fn events<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let events = each!(&*self.lock()?, stepper, catalogue => {
            let mut events = Vec::new();
            if let Some(catalogue) = catalogue {
                events.extend_from_slice(catalogue.events());
                events.extend(catalogue.under_way(&stepper.snapshot()));
            }
            events
        });
        table(py, &events)
    }

    /// All that later steps depend on, and the events, as bytes, which can be kept and pickled.
    fn state<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyBytes>> {
        each!(&*self.lock()?, stepper, catalogue => {
            packed(py, &(stepper.snapshot().state(), catalogue))
        })
    }

    /// Goes on from a state of a simulation with the same arguments: the next steps have the same bits.
    fn restore(&self, py: Python<'_>, #[pyo3(from_py_with = named)] state: &[u8]) -> PyResult<()> {
        each!(&mut *self.lock()?, stepper, catalogue => {
            let (state, events) = unpacked::<(StepState<_>, Option<EventCatalogue<_>>)>("state", state)?;
            let restored = stepper.restore(&state);
            restored.map_err(|error| errors::scene(py, &error))?;
            *catalogue = events;
            Ok(())
        })
    }

    /// Writes a checkpoint: a file from which a simulation with the same arguments goes on.
    ///
    /// Raises:
    ///     OSError: for a file that cannot be written; an older one stays.
    fn save(&self, py: Python<'_>, #[pyo3(from_py_with = named)] path: PathBuf) -> PyResult<()> {
        each!(&*self.lock()?, stepper, catalogue => restart::save(py, &path, &stepper.snapshot(), catalogue))
    }

    /// Goes on from a checkpoint of a simulation with the same arguments: the next steps have the same bits.
    ///
    /// Raises:
    ///     OSError: for a file that cannot be read.
    ///     FileError: for a file that is damaged or no checkpoint, or that of another simulation.
    fn load(&self, py: Python<'_>, #[pyo3(from_py_with = named)] path: PathBuf) -> PyResult<()> {
        each!(&mut *self.lock()?, stepper, catalogue => {
            *catalogue = restart::load(py, &path, &mut **stepper)?;
            Ok(())
        })
    }

    fn __reduce__(&self) -> PyResult<Py<PyAny>> {
        let message =
            "a FaultSimulation is not pickled: pickle its state(), and restore it into another one";
        Err(PyTypeError::new_err(message))
    }

    fn __repr__(&self) -> PyResult<String> {
        let (time, cells) = each!(&*self.lock()?, stepper, _ => {
            let at = stepper.snapshot();
            (at.time, at.contact(0).len())
        });
        Ok(format!("FaultSimulation({cells} cells, time={time})"))
    }
}

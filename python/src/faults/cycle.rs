//! Runs of a fault.

use std::ops::ControlFlow;
use std::sync::{Mutex, MutexGuard};

use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use stickslip::Steps;
use stickslip::integrate::Stepper;
use stickslip::record::{self, EventCatalogue};

use super::record::{FaultRun, Record};
use super::seas::SeasFiles;
use crate::arguments::{count, finite, positive};
use crate::errors::{self, argument};
use crate::exit::{Call, attached};
use crate::raised::Raised;
use crate::run::{Ended, run};

/// The number of events for which a catalogue has memory at first.
const ROOM: usize = 64;

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

/// The plan of a run: its end, samples, thresholds and files.
struct Plan<'a> {
    until: f64,
    every: usize,
    steps: Steps,
    callback: Option<Py<PyAny>>,
    threshold: [f64; 2],
    seas: Option<&'a SeasFiles>,
}

/// A fault in time, by an explicit Runge-Kutta method of order 5. Threads may share it; it runs in one at a time.
#[pyclass(frozen, module = "stickslip")]
pub(crate) struct FaultSimulation {
    motion: Mutex<Motion>,
    /// Shear modulus \[Pa\], and the directions of the components of slip on a plane.
    medium: (f64, Vec<[f64; 2]>),
    raised: Raised,
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
    ///     every: number of steps between two samples of all cells.
    ///     rtol: local error of a step in ln V and in the state.
    ///     max_steps: number of steps of this call after which it fails; None for no limit.
    ///     callback: function of the time [s] and the largest slip rate [m/s], called with each sample; a value of True
    ///         ends the run.
    ///     threshold: slip rates [m/s] at which an event begins and ends, the second one not larger.
    ///     stops: times [s] at which a step ends.
    ///     seas: SeasFiles to write during the run.
    ///
    /// Returns:
    ///     FaultRun: arrays over time and cells, and the events that end in the call, and the one under way at its end.
    ///         The next call with the same thresholds goes on with that one.
    ///
    /// Raises:
    ///     StepError: for a step that fails; the samples up to there are its `partial`.
    ///     OSError: for a file that cannot be written.
    #[pyo3(signature = (until, *, every=10, rtol=1e-6, max_steps=None, callback=None, threshold=(1e-2, 1e-3), stops=Vec::new(), seas=None),
           text_signature = "($self, until, *, every=10, rtol=1e-06, max_steps=None, callback=None, threshold=(0.01, 0.001), stops=[], seas=None)")]
    #[expect(clippy::too_many_arguments, reason = "keywords in Python")]
    fn run(
        &self,
        py: Python<'_>,
        until: f64,
        every: usize,
        rtol: f64,
        max_steps: Option<usize>,
        callback: Option<Py<PyAny>>,
        threshold: (f64, f64),
        stops: Vec<f64>,
        seas: Option<&SeasFiles>,
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
        let (begins, ends) = threshold;
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
            callback,
            threshold: [begins, ends],
            seas,
        };
        each!(&mut *motion, stepper, catalogue => {
            self.advance((py, &call), &mut **stepper, catalogue, &plan)
        })
    }

    /// The present time [s].
    #[getter]
    fn time(&self) -> PyResult<f64> {
        Ok(each!(&*self.lock()?, stepper, _ => stepper.snapshot().time))
    }
}

impl FaultSimulation {
    /// Takes the steps of a plan.
    fn advance<const C: usize>(
        &self,
        (py, call): (Python<'_>, &Call),
        stepper: &mut dyn Stepper<C>,
        kept: &mut Option<EventCatalogue<C>>,
        plan: &Plan<'_>,
    ) -> PyResult<FaultRun> {
        let at = stepper.snapshot();
        let mut record = Record::new(&at);
        // An event that outlasts a call goes on in the next one.
        let catalogue = match kept.take() {
            Some(own) if own.rates() == plan.threshold => Ok(own),
            _ => EventCatalogue::new(&at, 0, plan.threshold, self.medium.0, ROOM),
        };
        let catalogue = kept.insert(catalogue.map_err(|error| errors::scene(py, &error))?);
        let completed = catalogue.events().len();
        let created = (plan.seas).map(|files| files.create(&self.medium, &at));
        let created = created.transpose();
        let mut files = created.map_err(|error| errors::file(py, &error))?;
        let mut taken = 0;
        let report = run((py, call, &self.raised), stepper, &plan.steps, |at| {
            catalogue.record(at);
            taken += 1;
            if let Some(files) = &mut files
                && files.record(at).is_break()
            {
                return Ok(ControlFlow::Break(()));
            }
            if taken % plan.every != 0 && at.time < plan.until {
                return Ok(ControlFlow::Continue(()));
            }
            record.add(at);
            let Some(callback) = &plan.callback else {
                return Ok(ControlFlow::Continue(()));
            };
            let ends = attached(|py| {
                callback
                    .bind(py)
                    .call1((at.time, at.max_slip_rate()))?
                    .is_truthy()
            })?;
            Ok(if ends {
                ControlFlow::Break(())
            } else {
                ControlFlow::Continue(())
            })
        });
        // The rows of a failed run are complete, too.
        let written = files.map_or(Ok(()), record::SeasFiles::finish);
        let mut events = catalogue.events()[completed..].to_vec();
        events.extend(catalogue.under_way(&stepper.snapshot()));
        let samples = FaultRun::new(py, record, &events, taken)?;
        let error = match report {
            Ok(_) => {
                written.map_err(|error| errors::file(py, &error))?;
                return Ok(samples);
            }
            Err(Ended::Raised(error)) => error,
            Err(Ended::Failed(failure)) => errors::failure(py, &failure),
        };
        error.value(py).setattr("partial", samples)?;
        Err(error)
    }
}

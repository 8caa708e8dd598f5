//! Runs of a fault.

use std::ops::ControlFlow;
use std::sync::Mutex;

use pyo3::exceptions::{PyRuntimeError, PyValueError};
use pyo3::prelude::*;
use stickslip::Steps;
use stickslip::integrate::Stepper;
use stickslip::nalgebra::Vector1;
use stickslip::record::EventCatalogue;
use stickslip::state::{LogTheta, Theta};

use super::friction::CellFriction;
use super::function::CellFunction;
use super::geometry::{Geometry, Loading};
use super::laws::Given;
use super::record::{FaultRun, Record};
use super::seas::{Files, SeasFiles};
use crate::arguments::{count, finite, positive};
use crate::bodies::PerVertex;
use crate::errors::{self, argument};
use crate::exit::{Call, attached};
use crate::raised::Raised;
use crate::run::{Ended, run};

/// The number of events for which a catalogue has memory at first.
const ROOM: usize = 64;

/// A fault in time, by an explicit Runge-Kutta method of order 5. Threads may share it; it runs in one at a time.
#[pyclass(frozen, module = "stickslip")]
pub(crate) struct FaultSimulation {
    stepper: Mutex<Box<dyn Stepper<1>>>,
    /// Shear modulus \[Pa\], and the direction of slip on a plane.
    medium: (f64, [f64; 2]),
    raised: Raised,
}

/// A simulation of a fault from the arguments of Python.
pub(super) fn simulation(
    py: Python<'_>,
    (geometry, shear_modulus): (&Geometry, f64),
    laws: Given<'_>,
    ([normal, shear, plate_rate], [theta, log_theta, rate, stress_rate]): (
        [PerVertex; 3],
        [Option<PerVertex>; 4],
    ),
    (opens, [pressure, overstress]): (bool, [Option<Py<PyAny>>; 2]),
) -> PyResult<FaultSimulation> {
    let call = Call::begin()?;
    let cells = geometry.count();
    let positive = |name: &str, values: PerVertex| {
        let legal = |x: f64| x > 0.0 && x.is_finite();
        values.checked(name, cells, "finite and positive", legal)
    };
    let any = |name: &str, values: PerVertex| values.checked(name, cells, "finite", f64::is_finite);
    let raised = Raised::default();
    let laws = laws.laws(cells, &raised)?;
    let states: Vec<LogTheta> = match (theta, log_theta) {
        (Some(theta), None) => {
            let states = positive("theta", theta)?.into_iter();
            states.map(|theta| Theta(theta).into()).collect()
        }
        (None, Some(states)) => {
            let states = any("log_theta", states)?.into_iter();
            states.map(LogTheta).collect()
        }
        _ => {
            return Err(PyValueError::new_err(
                "give theta or log_theta, one of them",
            ));
        }
    };
    let friction = CellFriction {
        laws,
        states,
        normal_stress: any("normal_stress", normal)?,
        shear_stress: any("shear_stress", shear)?,
        opens,
        pressure: CellFunction::given(py, "pressure", pressure, &raised)?,
    };
    let plate_rate = any("plate_rate", plate_rate)?.into_iter();
    let loading = Loading {
        plate_rate: plate_rate.map(Vector1::new).collect(),
        stress_rate: stress_rate
            .map(|rates| any("stress_rate", rates))
            .transpose()?,
        overstress: CellFunction::given(py, "overstress", overstress, &raised)?,
        slip_rate: rate.map(|rates| any("slip_rate", rates)).transpose()?,
    };
    let stepper = call.detach(py, || geometry.stepper(loading, friction));
    if let Some(error) = raised.take() {
        return Err(error);
    }
    Ok(FaultSimulation {
        stepper: Mutex::new(stepper.map_err(|error| errors::scene(py, &error))?),
        medium: (shear_modulus, geometry.direction()),
        raised,
    })
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
    ///     callback: function of the time [s] and the largest slip rate [m/s], called with each sample; a value of True
    ///         ends the run.
    ///     threshold: slip rates [m/s] at which an event begins and ends, the second one not larger.
    ///     stops: times [s] at which a step ends.
    ///     seas: SeasFiles to write during the run.
    ///
    /// Returns:
    ///     FaultRun: arrays over time and cells, and the events.
    ///
    /// Raises:
    ///     StepError: for a step that fails; the samples up to there are its `partial`.
    ///     OSError: for a file that cannot be written.
    #[pyo3(signature = (until, *, every=10, rtol=1e-6, callback=None, threshold=(1e-2, 1e-3), stops=Vec::new(), seas=None),
           text_signature = "($self, until, *, every=10, rtol=1e-06, callback=None, threshold=(0.01, 0.001), stops=[], seas=None)")]
    #[expect(clippy::too_many_arguments, reason = "keywords in Python")]
    fn run(
        &self,
        py: Python<'_>,
        until: f64,
        every: usize,
        rtol: f64,
        callback: Option<Py<PyAny>>,
        threshold: (f64, f64),
        stops: Vec<f64>,
        seas: Option<&SeasFiles>,
    ) -> PyResult<FaultRun> {
        let call = Call::begin()?;
        let every = count("every", every)?;
        let busy = |_| {
            PyRuntimeError::new_err("the simulation runs in another thread, or in its callback")
        };
        let mut stepper = self.stepper.try_lock().map_err(busy)?;
        let now = stepper.snapshot().time;
        if !(until.is_finite() && until > now) {
            let requirement = format!("after the present time {now} s");
            return Err(argument("until", &requirement, until));
        }
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
            .with_max_steps(usize::MAX)
            .stopping_at(stops)
            .until(until);
        let at = stepper.snapshot();
        let mut record = Record::new(&at);
        let catalogue = EventCatalogue::new(&at, 0, [begins, ends], self.medium.0, ROOM);
        let mut catalogue = catalogue.map_err(|error| errors::scene(py, &error))?;
        let created = seas.map(|files| Files::create(files, self.medium, &at));
        let created = created.transpose();
        let mut files = created.map_err(|error| errors::file(py, &error))?;
        let mut taken = 0;
        let report = run((py, &call, &self.raised), &mut **stepper, &steps, |at| {
            catalogue.record(at);
            taken += 1;
            if let Some(files) = &mut files
                && files.record(at).is_break()
            {
                return Ok(ControlFlow::Break(()));
            }
            if taken % every != 0 && at.time < until {
                return Ok(ControlFlow::Continue(()));
            }
            record.add(at);
            let Some(callback) = &callback else {
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
        let written = files.map_or(Ok(()), Files::finish);
        let failure = match report {
            Ok(_) => None,
            Err(Ended::Raised(error)) => return Err(error),
            Err(Ended::Failed(failure)) => Some(failure),
        };
        if failure.is_none() {
            written.map_err(|error| errors::file(py, &error))?;
        }
        let samples = FaultRun::new(py, record, catalogue.events(), taken)?;
        let Some(failure) = failure else {
            return Ok(samples);
        };
        let error = errors::failure(py, &failure);
        error.value(py).setattr("partial", samples)?;
        Err(error)
    }

    /// The present time [s].
    #[getter]
    fn time(&self) -> PyResult<f64> {
        let busy = |_| {
            PyRuntimeError::new_err("the simulation runs in another thread, or in its callback")
        };
        Ok(self.stepper.try_lock().map_err(busy)?.snapshot().time)
    }
}

//! The steps of a run of a fault.

use std::ops::ControlFlow;
use std::sync::{Mutex, PoisonError};

use pyo3::prelude::*;
use stickslip::integrate::Stepper;
use stickslip::record::{self, EventCatalogue};
use stickslip::{Snapshot, Steps};

use super::callback::asked;
use super::cycle::FaultSimulation;
use super::receivers::Receivers;
use super::record::FaultRun;
use super::samples::Record;
use super::seas::SeasFiles;
use crate::errors;
use crate::exit::{Call, attached};
use crate::progress::Progress;
use crate::run::{Course, Ended, run};

/// The number of events for which a catalogue has memory at first.
const ROOM: usize = 64;

/// The plan of a run: its end, samples, thresholds and files.
pub(super) struct Plan<'a> {
    pub(super) until: f64,
    pub(super) every: usize,
    pub(super) steps: Steps,
    pub(super) times: Option<Vec<f64>>,
    pub(super) callback: Option<Py<PyAny>>,
    pub(super) threshold: [f64; 2],
    pub(super) seas: Option<&'a SeasFiles>,
    pub(super) receivers: Option<&'a Receivers>,
    pub(super) progress: Option<Progress>,
}

impl FaultSimulation {
    /// Takes the steps of a plan.
    pub(super) fn advance<const C: usize>(
        &self,
        (py, call): (Python<'_>, &Call),
        stepper: &mut dyn Stepper<C>,
        kept: &mut Option<EventCatalogue<C>>,
        mut plan: Plan<'_>,
    ) -> PyResult<FaultRun> {
        let at = stepper.snapshot();
        let samples_steps = plan.times.is_none();
        if let Some(receivers) = plan.receivers {
            receivers.check(at.displacement.len(), C)?;
        }
        let mut record = Record::of(&at, plan.receivers);
        if samples_steps {
            record.add(&at);
        }
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
        let course = Course {
            steps: &plan.steps,
            times: plan.times.as_deref().unwrap_or_default(),
            progress: plan.progress.as_mut(),
        };
        // Times and steps are shown one after the other.
        let record = Mutex::new(record);
        let add = |at: &Snapshot<'_, C>| {
            if let Ok(mut record) = record.lock() {
                record.add(at);
            }
        };
        let report = run((py, call, &self.raised), stepper, course, add, |at| {
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
            if samples_steps {
                add(at);
            }
            let Some(callback) = &plan.callback else {
                return Ok(ControlFlow::Continue(()));
            };
            attached(|py| asked(callback.bind(py), (at.time, at.max_slip_rate())))
        });
        let mut record = record.into_inner().unwrap_or_else(PoisonError::into_inner);
        if let Some(times) = &plan.times {
            record.at(times);
        }
        // The rows of a failed run are complete, too.
        let written = files.map_or(Ok(()), record::SeasFiles::finish);
        let mut events = catalogue.events()[completed..].to_vec();
        events.extend(catalogue.under_way(&stepper.snapshot()));
        let samples = FaultRun::of(py, record, &events, taken)?;
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

//! The record of a run: the history of one vertex, its events, and the cost of every step.

use std::ops::ControlFlow;
use std::time::Instant;

use serde::{Deserialize, Serialize};
use stickslip::integrate::Stepper;
use stickslip::{Run, SceneError, Snapshot, StepFailure, Steps};

use crate::cli::Problem;
use crate::cost::Statistics;
use crate::onsets::Onsets;
use crate::output::{Output, number};
use crate::plot::Points;
use crate::progress::Progress;
use crate::sample::Sample;

/// The quantities to be recorded.
#[derive(Clone, Copy, Serialize, Deserialize)]
pub struct Recording {
    /// The frictional vertex of the history.
    pub vertex: usize,
    /// The interval of kept steps; the last one always is kept.
    pub every: usize,
    /// The slip rate of the vertex [m/s] from which it counts as slip.
    pub slip: f64,
    /// The slip rates of the vertex [m/s] for the start and the end of an event.
    pub event: (f64, f64),
    /// The end of the run \[s\], for the progress bar.
    pub end: f64,
    /// Whether steps adapt: each is then one of the plan.
    pub adaptive: bool,
}

/// A run and its record, which can be kept in a file and continued.
#[derive(Serialize, Deserialize)]
pub struct Record {
    recording: Recording,
    /// The kept steps.
    pub samples: Vec<Sample>,
    slips: Onsets,
    events: Onsets,
    /// The cost of the steps.
    pub cost: Statistics,
    /// The time of the last step \[s\].
    pub time_end: f64,
    /// The displacement of the vertex at that time, first component \[m\].
    pub displacement_end: f64,
    /// Steps that failed and were split into substeps, of a completed run.
    pub substepped: usize,
    /// The steps of the plan so far; a split step counts once.
    pub planned: usize,
    /// The wall time of the time loop \[s\].
    pub seconds: f64,
    /// The failure of an incomplete run.
    #[serde(skip)]
    pub failure: Option<StepFailure>,
}

impl Record {
    /// Takes the steps and records them under a progress bar.
    pub fn take<const C: usize>(
        recording: Recording,
        simulation: &mut dyn Stepper<C>,
        steps: &Steps,
    ) -> Result<Self, SceneError> {
        let mut record = Self::new(recording, &simulation.snapshot())?;
        let keep = &mut |_: &Self, _: &Snapshot<'_, C>| ControlFlow::Continue(());
        record.go_on(simulation, steps, &mut Progress::default(), keep);
        record.finish(&simulation.snapshot());
        Ok(record)
    }

    /// Opens a record at the start of a run.
    pub fn new<const C: usize>(
        recording: Recording,
        at: &Snapshot<'_, C>,
    ) -> Result<Self, SceneError> {
        const ROOM: usize = 1 << 20;
        let mut record = Self {
            recording,
            samples: Vec::with_capacity(ROOM / recording.every),
            slips: Onsets::new(recording.slip, recording.slip),
            events: Onsets::new(recording.event.0, recording.event.1),
            cost: Statistics::default(),
            time_end: 0.0,
            displacement_end: 0.0,
            substepped: 0,
            planned: 0,
            seconds: 0.0,
            failure: None,
        };
        record.watch(at);
        Ok(record)
    }

    /// The same record with another end of the run \[s\].
    #[must_use]
    pub fn until(mut self, end: f64) -> Self {
        self.recording.end = end;
        self
    }

    /// Takes the steps of a plan; `keep` is called with each after it is recorded, and may end the run. Returns their
    /// number.
    pub fn go_on<const C: usize>(
        &mut self,
        simulation: &mut dyn Stepper<C>,
        steps: &Steps,
        progress: &mut Progress,
        keep: &mut dyn FnMut(&Self, &Snapshot<'_, C>) -> ControlFlow<()>,
    ) -> usize {
        let recording = self.recording;
        let clock = Instant::now();
        let run = simulation.run(steps, |at| {
            self.cost.record(&at);
            self.watch(&at);
            if at.step.is_multiple_of(recording.every) {
                self.samples.push(Sample::of(&at, recording.vertex));
            }
            let rate = at.velocity[recording.vertex][0].abs();
            progress.at(at.time, recording.end, rate);
            self.planned += usize::from(recording.adaptive);
            keep(self, &at)
        });
        self.seconds += clock.elapsed().as_secs_f64();
        match run {
            Ok(report) => {
                self.substepped += report.substepped;
                if !recording.adaptive {
                    self.planned += report.accepted;
                }
                report.accepted
            }
            Err(failure) => {
                self.substepped = 0;
                self.failure = Some(failure);
                0
            }
        }
    }

    /// Closes the record with the last step.
    pub fn finish<const C: usize>(&mut self, end: &Snapshot<'_, C>) {
        let last = self.samples.last();
        if end.step > last.map_or(0, |sample| sample.step) {
            self.samples.push(Sample::of(end, self.recording.vertex));
        }
    }

    fn watch<const C: usize>(&mut self, at: &Snapshot<'_, C>) {
        let rate = at.velocity[self.recording.vertex][0];
        self.slips.record(at.time, rate);
        self.events.record(at.time, rate);
        self.time_end = at.time;
        self.displacement_end = at.displacement[self.recording.vertex][0];
    }

    /// The time of the first slip of the vertex \[s\].
    pub fn first_slip(&self) -> Option<f64> {
        self.slips.times().first().copied()
    }

    /// The onset times of the events of the vertex \[s\].
    pub fn events(&self) -> &[f64] {
        self.events.times()
    }

    /// The mean wall time per step \[ms\].
    pub fn milliseconds_per_step(&self) -> f64 {
        1e3 * self.seconds / self.cost.steps.max(1) as f64
    }

    /// A value of the kept steps from a time \[s\] on, over time.
    pub fn since(&self, time: f64, value: fn(&Sample) -> f64) -> Points {
        let kept = self.samples.iter().filter(|s| s.time >= time);
        kept.map(|sample| (sample.time, value(sample))).collect()
    }

    /// Writes the history as a table, its states as `ln(theta / 1 s)`.
    pub fn write_history(
        &self,
        output: &Output,
        name: &str,
        log_theta: fn(f64) -> f64,
    ) -> Result<(), Problem> {
        const COLUMNS: &str = "step,time,displacement,velocity,alpha,max_slip_rate,\
             fixed_point_iterations,solver_iterations";
        let rows = self.samples.iter().map(|sample| {
            [
                sample.step.to_string().into(),
                number(sample.time),
                number(sample.displacement),
                number(sample.velocity),
                number(log_theta(sample.state)),
                number(sample.max_slip_rate),
                sample.report.coupling_iterations.to_string().into(),
                sample.report.solver_iterations.to_string().into(),
            ]
        });
        output.table(name, COLUMNS, rows)
    }
}

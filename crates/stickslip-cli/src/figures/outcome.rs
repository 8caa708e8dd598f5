//! The outcome of a run for the figures.

use std::ops::ControlFlow;
use std::path::Path;
use std::time::Instant;

use serde::{Deserialize, Serialize};
use stickslip::integrate::Stepper;
use stickslip::problems::pipping_slider::END;
use stickslip::record::{Quantity, TraceMemory, Tracing};
use stickslip::{Checkpoint, Run, Snapshot, Steps};

use super::Experiment;
use crate::cli::Problem;
use crate::cost::Statistics;
use crate::onsets::Onsets;
use crate::sample::Sample;
use crate::slider::RECORDING;

/// The outcome of a run for the figures.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct Outcome {
    /// The experiment.
    pub experiment: Experiment,
    /// Samples at the centre at 0.9, 0.95 and all of the 15 s, as far as the run gets.
    pub fractions: Vec<Sample>,
    /// The last quarter at the centre, at most so many samples per second.
    pub history: Vec<Sample>,
    /// The time of the first slip at the centre \[s\].
    pub first_slip: Option<f64>,
    /// The onset times of the events at the centre \[s\].
    pub events: Vec<f64>,
    /// Velocity problems and solver iterations.
    pub cost: Statistics,
    /// The number of steps that were split into substeps.
    pub substepped: usize,
    /// The run time of the steps \[s\].
    pub seconds: f64,
    /// The slip rates of the contact through the event of figure 6.5.
    pub rupture: Rupture,
}

/// The slip rates of a contact in a window of time.
#[derive(Debug, Clone, Default, Serialize, Deserialize)]
pub struct Rupture {
    /// The positions of the vertices \[m\].
    pub x: Vec<f64>,
    /// The times of the rows \[s\].
    pub times: Vec<f64>,
    /// The slip rates [m/s], row by row.
    pub slip_rates: Vec<f64>,
    /// Position and time of the first slip rate above [`FAST`] \[m, s\].
    pub onset: Option<(f64, f64)>,
    /// Position, value and time of the peak slip rate \[m, m/s, s\].
    pub peak: (f64, f64, f64),
    /// The last time of a slip rate above [`FAST`] \[s\].
    pub over: f64,
    /// The smallest and the largest position of a slip rate above [`FAST`] \[m\].
    pub extent: Option<(f64, f64)>,
}

/// The window of figure 6.5 as shares of the 15 s.
pub(super) const WINDOW: [f64; 2] = [0.6725, 0.6775];
/// The slip rate [m/s] of a rupture.
pub(super) const FAST: f64 = 1e-3;
/// The compared times as shares of the 15 s.
pub(super) const FRACTIONS: [f64; 3] = [0.9, 0.95, 1.0];

/// The number of rows of the picture in space and time.
const ROWS: usize = 1001;
/// Steps of 15 s of which samples are kept for a picture.
const SHOWN: usize = 100_000;
/// The share of the 15 s from which on samples are kept for a picture.
const SINCE: f64 = 0.75;
/// The number of checkpoints of a run.
const CHECKPOINTS: usize = 25;

/// The record, kept in a file for a restart.
#[derive(Serialize, Deserialize)]
struct Records {
    outcome: Outcome,
    slips: Onsets,
    events: Onsets,
    trace: TraceMemory,
    taken: usize,
}

impl Outcome {
    /// Takes the run, from the checkpoint `file` if there is one, and shows its progress from 0 to 1.
    pub fn of(
        experiment: &Experiment,
        simulation: &mut dyn Stepper<2>,
        vertex: usize,
        file: &Path,
        progress: &mut dyn FnMut(f64),
    ) -> Result<Self, Problem> {
        let file = Checkpoint::at(file).tagged("version", env!("CARGO_PKG_VERSION"));
        let file = file.tagged("run", experiment.name());
        let mut records = if file.path().exists() {
            file.restore(simulation)?
        } else {
            Records::new(experiment, &simulation.snapshot())?
        };
        let count = experiment.count();
        let piece = count.div_ceil(CHECKPOINTS);
        while records.taken < count {
            let steps = piece.min(count - records.taken);
            let plan = Steps::constant(experiment.step_size()).count(steps);
            let clock = Instant::now();
            let report = simulation.run(&plan, |at| {
                records.record(&at, vertex);
                progress(at.time / (experiment.until * END));
                ControlFlow::Continue(())
            })?;
            records.outcome.seconds += clock.elapsed().as_secs_f64();
            records.outcome.substepped += report.substepped;
            records.taken += report.accepted;
            if records.taken < count {
                file.save(&simulation.snapshot(), &records)?;
            }
        }
        Ok(records.finish())
    }

    /// The sample at a share of the 15 s.
    pub fn at(&self, fraction: f64) -> Option<&Sample> {
        let near = |sample: &&Sample| (sample.time - fraction * END).abs() < 1e-9 * END;
        self.fractions.iter().find(near)
    }

    /// A value of the samples for a picture from a share of the 15 s on, over time.
    pub fn since(&self, fraction: f64, value: fn(&Sample) -> f64) -> Vec<(f64, f64)> {
        let shown = self.history.iter().filter(|s| s.time >= fraction * END);
        shown.map(|sample| (sample.time, value(sample))).collect()
    }
}

impl Records {
    fn new(experiment: &Experiment, at: &Snapshot<'_, 2>) -> Result<Self, Problem> {
        let every = (experiment.steps as f64 * (WINDOW[1] - WINDOW[0]) / ROWS as f64).ceil();
        let tracing = Tracing::of(0, &[Quantity::SlipRate]).every((every as usize).max(1));
        Ok(Self {
            outcome: Outcome {
                experiment: *experiment,
                fractions: Vec::new(),
                history: Vec::new(),
                first_slip: None,
                events: Vec::new(),
                cost: Statistics::default(),
                substepped: 0,
                seconds: 0.0,
                rupture: Rupture::default(),
            },
            slips: Onsets::new(RECORDING.slip, RECORDING.slip),
            events: Onsets::new(RECORDING.event.0, RECORDING.event.1),
            trace: TraceMemory::new(at, tracing, ROWS + 1)?,
            taken: 0,
        })
    }

    fn record(&mut self, at: &Snapshot<'_, 2>, vertex: usize) {
        let outcome = &mut self.outcome;
        outcome.cost.record(at);
        let rate = at.velocity[vertex][0];
        self.slips.record(at.time, rate);
        self.events.record(at.time, rate);
        let share = at.time / END;
        let tiny = 1e-10;
        let every = (outcome.experiment.steps / SHOWN).max(1);
        let is_fraction = FRACTIONS.iter().any(|f| (share - f).abs() < tiny);
        if is_fraction || (share >= SINCE - tiny && at.step.is_multiple_of(every)) {
            outcome.history.push(Sample::of(at, vertex));
        }
        if (WINDOW[0] - tiny..=WINDOW[1] + tiny).contains(&share) {
            self.trace.record(at);
            outcome.rupture.see(at);
        }
    }

    fn finish(self) -> Outcome {
        let mut outcome = self.outcome;
        let samples = outcome.history.iter();
        let is_fraction = |s: &&Sample| FRACTIONS.iter().any(|f| (s.time / END - f).abs() < 1e-10);
        outcome.fractions = samples.filter(is_fraction).copied().collect();
        outcome.first_slip = self.slips.times().first().copied();
        outcome.events = self.events.times().to_vec();
        let (trace, rupture) = (&self.trace, &mut outcome.rupture);
        rupture.x = trace.along().to_vec();
        rupture.times = trace.times().to_vec();
        let places = 0..trace.along().len();
        rupture.slip_rates = (0..trace.times().len())
            .flat_map(|row| places.clone().map(move |place| trace.value(row, place, 0)))
            .collect();
        outcome
    }
}

impl Rupture {
    /// Records a step within the window.
    fn see(&mut self, at: &Snapshot<'_, 2>) {
        let contact = at.contact(0);
        let mut fastest = (0.0, 0.0);
        for k in 0..contact.len() {
            let (x, rate) = (contact.point(k)[0], contact.slip_rate(k));
            if rate > fastest.1 {
                fastest = (x, rate);
            }
            if rate > FAST {
                let extent = self.extent.get_or_insert((x, x));
                *extent = (extent.0.min(x), extent.1.max(x));
                self.over = at.time;
            }
        }
        if fastest.1 > FAST && self.onset.is_none() {
            self.onset = Some((fastest.0, at.time));
        }
        if fastest.1 > self.peak.1 {
            self.peak = (fastest.0, fastest.1, at.time);
        }
    }
}

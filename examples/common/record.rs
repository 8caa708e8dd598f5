//! The record of a run: the history of one vertex, its events, and the cost of every step.

use std::time::Instant;

use stickslip::{Adaptive, Events, Failure, History, Sample, Snapshot, Stepper};

use super::cli::Problem;
use super::output::{Output, digits};
use super::progress::Progress;

/// What is to be recorded.
#[derive(Clone, Copy)]
pub(crate) struct Recording {
    /// The frictional vertex whose history is kept.
    pub(crate) vertex: usize,
    /// Every which step is kept; the last one always is.
    pub(crate) every: usize,
    /// The slip rate of the vertex [m/s] that counts as slip at all.
    pub(crate) slip: f64,
    /// The slip rates of the vertex [m/s] above which an event begins and below which it is over.
    pub(crate) event: (f64, f64),
    /// From the variable that the state law integrates to `ln(theta / 1 s)`.
    pub(crate) log_theta: fn(f64) -> f64,
}

/// A run and what was recorded of it.
pub(crate) struct Run {
    recording: Recording,
    /// The steps kept.
    pub(crate) history: History,
    /// Every time at which the vertex begins to slip.
    slips: Events,
    /// The events of the vertex.
    pub(crate) events: Events,
    /// Steps taken.
    pub(crate) steps: usize,
    /// Velocity problems solved, in all and in the worst step.
    pub(crate) velocity_problems: (usize, usize),
    /// Iterations of the velocity solver, in all and in the worst step.
    pub(crate) solver_iterations: (usize, usize),
    /// Steps in which the coupling gave up and fell back on another.
    pub(crate) fallbacks: usize,
    /// Steps at whose end friction weakens with the slip rate somewhere, its state following.
    pub(crate) weakening: usize,
    /// The largest slip rate on the frictional boundary [m/s].
    pub(crate) peak_slip_rate: f64,
    /// The displacement of the vertex in the end, first component \[m\].
    pub(crate) displacement_end: f64,
    /// The time of the last step \[s\].
    pub(crate) time_end: f64,
    /// The wall time of the time loop \[s\].
    pub(crate) seconds: f64,
    /// Why it ended early.
    pub(crate) failure: Option<Failure>,
}

/// How time is divided.
pub(crate) enum Steps {
    /// So many steps of this size \[s\].
    Constant(usize, f64),
    /// Steps that adapt, until this time \[s\].
    Adaptive(Adaptive, f64),
}

impl Run {
    /// Takes the steps and records them under a progress bar.
    pub(crate) fn take<const C: usize>(
        recording: Recording,
        simulation: &mut dyn Stepper<C>,
        division: &Steps,
    ) -> Self {
        const ROOM: usize = 1 << 20;
        let (steps, end) = match *division {
            Steps::Constant(steps, dt) => (steps, steps as f64 * dt),
            Steps::Adaptive(_, until) => (ROOM, until),
        };
        let Recording {
            vertex,
            every,
            slip,
            event,
            ..
        } = recording;
        let start = simulation.snapshot();
        let mut run = Self {
            recording,
            history: History::new(vertex, 0, (steps / every + 1).min(ROOM)),
            slips: Events::new(slip, slip),
            events: Events::new(event.0, event.1),
            steps: 0,
            velocity_problems: (0, 0),
            solver_iterations: (0, 0),
            fallbacks: 0,
            weakening: 0,
            peak_slip_rate: 0.0,
            displacement_end: start.displacement[vertex][0],
            time_end: start.time,
            seconds: 0.0,
            failure: None,
        };
        run.watch(start.time, start.velocity[vertex][0]);
        const PARTS: usize = 1000;
        let mut progress = Progress::new(PARTS);
        let clock = Instant::now();
        let mut observe = |at: Snapshot<'_, C>| {
            run.observe(&at);
            progress.show((at.time / end * PARTS as f64) as usize, || {
                let (time, rate) = (at.time, at.velocity[vertex][0].abs());
                let iterations = at.report.coupling_iterations;
                format!("t = {time:.4} s  V = {rate:.2e} m/s  {iterations} iterations")
            });
        };
        run.failure = match division {
            Steps::Constant(steps, dt) => simulation.run(*steps, *dt, &mut observe).err(),
            Steps::Adaptive(adaptive, until) => {
                adaptive.run(simulation, *until, &mut observe).err()
            }
        };
        run.seconds = clock.elapsed().as_secs_f64();
        let end = simulation.snapshot();
        let kept = run.history.samples().last().map_or(0, |sample| sample.step);
        if end.step > kept {
            run.history.record(&end);
        }
        run
    }

    fn observe<const C: usize>(&mut self, at: &Snapshot<'_, C>) {
        self.fallbacks += usize::from(at.report.fell_back);
        self.weakening += usize::from(at.report.weakening > 0);
        let count = |(sum, most): &mut (usize, usize), new: usize| {
            *sum += new;
            *most = new.max(*most);
        };
        self.steps += 1;
        self.time_end = at.time;
        self.displacement_end = at.displacement[self.recording.vertex][0];
        self.watch(at.time, at.velocity[self.recording.vertex][0]);
        self.peak_slip_rate = self.peak_slip_rate.max(at.max_slip_rate());
        count(&mut self.velocity_problems, at.report.coupling_iterations);
        count(&mut self.solver_iterations, at.report.solver_iterations);
        if at.step.is_multiple_of(self.recording.every) {
            self.history.record(at);
        }
    }

    fn watch(&mut self, time: f64, slip_rate: f64) {
        self.slips.record(time, slip_rate);
        self.events.record(time, slip_rate);
    }

    /// When the vertex slipped for the first time \[s\].
    pub(crate) fn first_slip(&self) -> Option<f64> {
        self.slips.times().first().copied()
    }

    /// `total` by the number of steps, or by one before the first of them.
    pub(crate) fn per_step(&self, total: f64) -> f64 {
        total / self.steps.max(1) as f64
    }

    /// The steps kept from a time \[s\] on.
    pub(crate) fn since(&self, time: f64) -> impl Iterator<Item = &Sample> {
        self.history
            .samples()
            .iter()
            .filter(move |sample| sample.time >= time)
    }

    /// Writes the history as a table.
    pub(crate) fn write_history(&self, output: &Output, name: &str) -> Result<(), Problem> {
        let rows = self.history.samples().iter().map(|sample| {
            [
                sample.step.to_string(),
                digits(sample.time),
                digits(sample.displacement),
                digits(sample.velocity),
                digits((self.recording.log_theta)(sample.state)),
                digits(sample.max_slip_rate),
                sample.report.coupling_iterations.to_string(),
                sample.report.solver_iterations.to_string(),
            ]
        });
        output.table(name, &COLUMNS, rows)
    }
}

const COLUMNS: [&str; 8] = [
    "step",
    "time",
    "displacement",
    "velocity",
    "alpha",
    "max_slip_rate",
    "fixed_point_iterations",
    "solver_iterations",
];

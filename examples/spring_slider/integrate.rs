//! From laws to a history.

use std::time::Instant;

use stickslip::friction::FrictionLaw;
use stickslip::problems::SpringScene;
use stickslip::state::{StateLaw, StateVariable};
use stickslip::{
    Adaptive, Events, Failure, Newmark, Point, RungeKutta, Sdirk2, Simulation, Snapshot, Stepper,
};

use crate::common::cli::Problem;
use crate::common::output::{Output, digits};
use crate::common::state_law::Law;
use crate::experiment::{Experiment, Steps};

/// One time.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Sample {
    pub(crate) time: f64,
    pub(crate) slip_rate: f64,
    pub(crate) displacement: f64,
    pub(crate) theta: f64,
    pub(crate) friction: f64,
}

/// A history and what it cost.
pub(crate) struct Run {
    pub(crate) samples: Vec<Sample>,
    pub(crate) events: Events,
    /// Local problems solved.
    pub(crate) solves: usize,
    pub(crate) seconds: f64,
    pub(crate) method: &'static str,
    pub(crate) failure: Option<Failure>,
}

/// The slip rates [m/s] above which an event begins and below which it is over.
pub(crate) const EVENT: (f64, f64) = (1e-3, 1e-5);

/// Integrates the experiment with these laws.
pub(crate) fn run<L, S>(
    experiment: &Experiment,
    friction: L,
    law: S,
    state: S::State,
) -> Result<Run, Problem>
where
    L: FrictionLaw + Clone + 'static,
    S: StateLaw + Clone + 'static,
    L::State: From<S::State>,
{
    let mut run = Run {
        samples: Vec::with_capacity(1 << 16),
        events: Events::new(EVENT.0, EVENT.1),
        solves: 0,
        seconds: 0.0,
        method: "",
        failure: None,
    };
    let rate = experiment.initial_slip_rate;
    let log_theta = experiment.law.log_theta();
    let build = || -> Result<_, Problem> {
        let slider = &experiment.slider;
        method(
            experiment,
            slider.scene(friction.clone(), law.clone(), rate, state)?,
        )
    };
    let (name, mut stepper) = build()?;
    run.method = name;
    let clock = Instant::now();
    let mut observe = |at: Snapshot<'_, 1>| {
        let state = at.states.state(0);
        let slip_rate = at.velocity[0][0];
        run.events.record(at.time, slip_rate);
        run.solves += at.report.solver_iterations;
        run.samples.push(Sample {
            time: at.time,
            slip_rate,
            displacement: at.displacement[0][0],
            theta: log_theta(state).exp(),
            friction: friction.coefficient(slip_rate.abs(), S::State::from_value(state).into()),
        });
    };
    observe(stepper.snapshot());
    run.failure = drive(experiment, &mut *stepper, &mut observe).err();
    run.seconds = clock.elapsed().as_secs_f64();
    // A short run is timed by the median of several, the first of which warms the machine up.
    if run.failure.is_none() && run.seconds < SHORT {
        let mut seconds = Vec::new();
        for _ in 0..RUNS {
            let (_, mut stepper) = build()?;
            let clock = Instant::now();
            drive(experiment, &mut *stepper, &mut |_| ())?;
            seconds.push(clock.elapsed().as_secs_f64());
        }
        seconds.sort_unstable_by(f64::total_cmp);
        run.seconds = seconds[RUNS / 2];
    }
    // The spring starts unstretched by the slip to come.
    let origin = run.samples[0].displacement;
    for sample in &mut run.samples {
        sample.displacement -= origin;
    }
    Ok(run)
}

/// Runs below this are repeated for their time \[s\].
const SHORT: f64 = 0.05;
const RUNS: usize = 9;

/// All steps of the experiment.
fn drive(
    experiment: &Experiment,
    stepper: &mut dyn Stepper<1>,
    observe: &mut dyn FnMut(Snapshot<'_, 1>),
) -> Result<(), Failure> {
    match experiment.steps {
        Steps::Constant(dt) => {
            let steps = (experiment.until / dt).round().max(1.0) as usize;
            stepper.run(steps, dt, observe)
        }
        Steps::Adaptive(tolerance) => Adaptive::new(tolerance)
            .with_max_steps(2_000_000)
            .with_stops(experiment.slider.load.kinks())
            .run(stepper, experiment.until, observe)
            .map(|_| ()),
    }
}

/// An explicit method where the step adapts and the right-hand side is smooth, else an implicit one.
fn method<L, S>(
    experiment: &Experiment,
    scene: SpringScene<L, S>,
) -> Result<(&'static str, Box<dyn Stepper<1>>), Problem>
where
    L: FrictionLaw + Clone + 'static,
    S: StateLaw + Clone + 'static,
    L::State: From<S::State>,
{
    let adapts = matches!(experiment.steps, Steps::Adaptive(_));
    let smooth = matches!(experiment.law, Law::Dieterich | Law::Ruina);
    if adapts && smooth && experiment.slider.mass == 0.0 {
        return Ok(("runge-kutta", Box::new(RungeKutta::new(scene)?)));
    }
    if adapts {
        let simulation = Simulation::new(scene, Sdirk2, Point)?;
        return Ok(("sdirk2", Box::new(simulation)));
    }
    let simulation = Simulation::new(scene, Newmark::default(), Point)?;
    Ok(("newmark", Box::new(simulation)))
}

impl Run {
    /// Writes every `every`-th sample and the last one.
    pub(crate) fn write(
        &self,
        experiment: &Experiment,
        output: &Output,
        name: &str,
        every: usize,
    ) -> Result<(), Problem> {
        let last = self.samples.len() - 1;
        let kept = self
            .samples
            .iter()
            .enumerate()
            .filter(|&(i, _)| i % every == 0 || i == last);
        output.table(
            name,
            &[
                "time",
                "load_point_velocity",
                "slip_rate",
                "displacement",
                "theta",
                "friction",
            ],
            kept.map(|(_, sample)| {
                [
                    sample.time,
                    experiment.slider.load.velocity(sample.time),
                    sample.slip_rate,
                    sample.displacement,
                    sample.theta,
                    sample.friction,
                ]
                .map(digits)
            }),
        )
    }
}

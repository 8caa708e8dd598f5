//! When does an elastic body that is pulled over a rigid surface slip, how far, and how fast?
//!
//! The main experiment of Pipping, Sander and Kornhuber: a body of 5 m x 1 m in plane strain, moved
//! at its top, with rate- and state-dependent friction at its bottom. The body sticks, creeps, and
//! slips in events; histories are recorded at the middle of the bottom, `x0 = (2.5, 0)`.
//!
//! ```text
//! cargo run --release --example slider -- --refinements 4 --steps 10000 --law dieterich
//! ```

mod arguments;
#[path = "../common/mod.rs"]
mod common;
mod model;

use std::process::ExitCode;
use std::time::Instant;

use serde::Serialize;
use stickslip::fem::P1;
use stickslip::problems::{END, Slider};
use stickslip::{Adaptive, Sample};

use arguments::{Arguments, Coupling, Friction, Scheme, Solver, Update};
use common::cli::{self, Problem};
use common::output::Output;
use common::plot::{self, Curve, DARK, Panel};
use common::record::{Recording, Run, Steps};
use common::state_law::Law;

/// The slip rate at `x0` [m/s] that counts as slip.
const SLIP: f64 = 1e-4;
/// The slip rates at `x0` [m/s] above which an event begins and below which it is over.
const EVENT: (f64, f64) = (1e-3, 1e-4);

fn main() -> ExitCode {
    cli::run(slide)
}

fn slide(arguments: &Arguments) -> Result<(), Problem> {
    let clock = Instant::now();
    let (law, friction) = arguments.laws()?;
    let slider = model::slider(arguments);
    let space = slider.space()?;
    let centre = Slider::centre(&space).ok_or("the mesh has no vertex at x0")?;
    let mut simulation = model::simulation(arguments, &space)?;
    let setup_seconds = clock.elapsed().as_secs_f64();

    let output = Output::create(&arguments.out, &[HISTORY, PICTURE, SUMMARY])?;
    let recording = Recording {
        vertex: centre,
        every: arguments.every.get(),
        slip: SLIP,
        event: EVENT,
        log_theta: law.log_theta(),
    };
    let dt = END / arguments.steps.get() as f64;
    let steps = match arguments.adaptive {
        None => Steps::Constant(arguments.steps_to_take(), dt),
        Some(tolerance) => {
            let adaptive = Adaptive::new(tolerance)
                .with_first_step(dt)
                .with_quantised_steps()
                // The velocity of the top has a kink there.
                .with_stops([END / 4.0]);
            Steps::Adaptive(adaptive, arguments.until * END)
        }
    };
    let run = Run::take(recording, &mut *simulation, &steps);

    let summary = Summary {
        law,
        friction,
        scheme: arguments.scheme,
        solver: arguments.solver,
        coupling: arguments.coupling(),
        state_update: arguments.state_update(),
        fallbacks: run.fallbacks,
        weakening_steps: run.weakening,
        refinements: arguments.refinements,
        unknowns: unknowns(&space)?,
        step_size: dt,
        steps: run.steps,
        time_end: run.time_end,
        first_slip_time: run.first_slip(),
        event_times: run.events.times().to_vec(),
        displacement_end: run.displacement_end,
        peak_slip_rate: run.peak_slip_rate,
        fixed_point_iterations_mean: run.per_step(run.velocity_problems.0 as f64),
        fixed_point_iterations_max: run.velocity_problems.1,
        solver_iterations_per_step: run.per_step(run.solver_iterations.0 as f64),
        solver_iterations_max: run.solver_iterations.1,
        milliseconds_per_step: run.per_step(1e3 * run.seconds),
        setup_seconds,
        failure: run.failure.as_ref().map(ToString::to_string),
    };
    run.write_history(&output, HISTORY)?;
    output.json(SUMMARY, &summary)?;
    plot::draw(&output.path(PICTURE), &panels(arguments, &run))?;
    summary.print();
    println!(
        "{HISTORY}, {PICTURE}, {SUMMARY} in {}",
        output.folder().display()
    );
    run.failure.map_or(Ok(()), |failure| Err(failure.into()))
}

/// The velocity components that are free: none at the top, one at the bottom, two elsewhere.
fn unknowns(space: &P1<2>) -> Result<usize, Problem> {
    let top = space.trace(|x| x[1] == 1.0)?.vertices().len();
    let bottom = Slider::bottom(space)?.vertices().len();
    Ok(2 * (space.vertex_count() - top) - bottom)
}

/// The last tenth of the displacement, the last quarter of the velocity; all of a shorter run.
fn panels<'a>(arguments: &Arguments, run: &Run) -> [Panel<'a>; 2] {
    let since = |share: f64| {
        if arguments.until < 1.0 {
            0.0
        } else {
            share * END
        }
    };
    let panel = |y, logarithmic, start, value: fn(&Sample) -> f64| Panel {
        x: "time [s]",
        y,
        logarithmic,
        curves: vec![Curve {
            label: "",
            color: DARK,
            width: 3,
            points: run
                .since(start)
                .map(|sample| (sample.time, value(sample)))
                .collect(),
        }],
    };
    [
        panel("displacement at x0 [mm]", false, since(0.9), |sample| {
            1e3 * sample.displacement
        }),
        panel("slip rate at x0 [m/s]", true, since(0.75), |sample| {
            sample.velocity
        }),
    ]
}

const HISTORY: &str = "history.csv";
const PICTURE: &str = "history.png";
const SUMMARY: &str = "summary.json";

/// The run in numbers: s, m, m/s.
#[derive(Serialize)]
struct Summary {
    law: Law,
    friction: Friction,
    scheme: Scheme,
    solver: Solver,
    coupling: Coupling,
    state_update: Update,
    /// Steps in which the coupling fell back on the fixed point.
    fallbacks: usize,
    /// Steps in which friction weakens with the slip rate somewhere, its state following.
    weakening_steps: usize,
    refinements: u8,
    unknowns: usize,
    step_size: f64,
    steps: usize,
    time_end: f64,
    first_slip_time: Option<f64>,
    event_times: Vec<f64>,
    displacement_end: f64,
    peak_slip_rate: f64,
    fixed_point_iterations_mean: f64,
    fixed_point_iterations_max: usize,
    solver_iterations_per_step: f64,
    solver_iterations_max: usize,
    milliseconds_per_step: f64,
    setup_seconds: f64,
    failure: Option<String>,
}

impl Summary {
    fn print(&self) {
        println!(
            "{} unknowns, {} steps of {:.4e} s to t = {:.5} s",
            self.unknowns, self.steps, self.step_size, self.time_end
        );
        let times: Vec<_> = self
            .event_times
            .iter()
            .map(|time| format!("{time:.5}"))
            .collect();
        println!(
            "{} events (V(x0) above {:e} m/s) at t = [{}] s",
            times.len(),
            EVENT.0,
            times.join(", ")
        );
        println!(
            "displacement at x0 {:.6e} m, largest slip rate {:.4e} m/s",
            self.displacement_end, self.peak_slip_rate
        );
        println!(
            "fixed-point iterations a step: average {:.3}, maximum {}; solver iterations a step: {:.2}",
            self.fixed_point_iterations_mean,
            self.fixed_point_iterations_max,
            self.solver_iterations_per_step
        );
        println!(
            "{:.3} ms a step, {:.3} s setup",
            self.milliseconds_per_step, self.setup_seconds
        );
    }
}

//! A run of the slider in numbers and as a picture.

use std::time::Instant;

use serde_json::json;
use stickslip::problems::pipping_slider::END;
use stickslip::reduced::ReducedBody;

use super::Arguments;
use crate::cli::{Problem, expect};
use crate::plot::{self, DARK, Panel};
use crate::record::{Record, Recording};

/// The thresholds of slip and of an event at `x0`; vertex, steps kept and end are the run's.
pub const RECORDING: Recording = Recording {
    vertex: 0,
    every: 1,
    slip: 1e-4,
    event: (1e-3, 1e-4),
    end: END,
    adaptive: false,
};

/// The first slip of an independent implementation in the default setting, by refinements \[s\].
const FIRST_SLIP: [(u8, f64); 2] = [(3, 10.008_895_770), (4, 10.009_699_449)];

const HISTORY: &str = "history.csv";
const PICTURE: &str = "history.png";
const SUMMARY: &str = "summary.json";

/// The setup before the first step.
#[derive(Debug, Clone, Copy)]
pub struct Setup {
    /// Components of the velocity that are free.
    pub unknowns: usize,
    /// Its wall time \[s\].
    pub seconds: f64,
    /// The modes of a reduced body.
    pub modes: Option<usize>,
    /// The frequency of the last of them \[Hz\].
    pub frequency: Option<f64>,
}

impl Setup {
    /// A setup from the fixed components, and the time of its start.
    pub fn new(fixed: &[[bool; 2]], clock: Instant) -> Self {
        Self {
            unknowns: fixed.iter().flatten().filter(|&&fixed| !fixed).count(),
            seconds: clock.elapsed().as_secs_f64(),
            modes: None,
            frequency: None,
        }
    }

    /// The setup of a reduced body.
    pub fn with_modes(self, body: &ReducedBody<2>) -> Self {
        Self {
            modes: Some(body.frequencies().count()),
            frequency: body.frequencies().last(),
            ..self
        }
    }
}

/// Writes and prints the results. Fails if the run did, or if the time of its first slip differs from a known one.
pub fn report(arguments: &Arguments, setup: Setup, run: Record) -> Result<(), Problem> {
    let laws = arguments.laws()?;
    let output = arguments
        .files
        .create("slider", &[HISTORY, PICTURE, SUMMARY])?;
    let Setup {
        unknowns, seconds, ..
    } = setup;
    let (cost, milliseconds) = (run.cost, run.milliseconds_per_step());
    let (problems, iterations) = (cost.velocity_problems, cost.solver_iterations);
    run.write_history(&output, HISTORY, laws.law.log_theta())?;
    output.json(
        SUMMARY,
        &json!({
            "law": laws.law,
            "friction": laws.friction,
            "scheme": arguments.scheme,
            "solver": arguments.solver,
            "body": arguments.body,
            "frequency": setup.frequency,
            "modes": setup.modes,
            "coupling": arguments.coupling_name(),
            "state_update": arguments.update_name(),
            // Steps in which the coupling fell back on the fixed point, or friction weakened somewhere.
            "fallbacks": cost.fallbacks,
            "bridged_steps": run.substepped,
            "weakening_steps": cost.weakening,
            "refinements": arguments.refinements,
            "unknowns": unknowns,
            "step_size": arguments.step_size(),
            "steps": cost.steps,
            "time_end": run.time_end,
            "first_slip_time": run.first_slip(),
            "event_times": run.events(),
            "displacement_end": run.displacement_end,
            "peak_slip_rate": cost.peak_slip_rate,
            "fixed_point_iterations_mean": cost.per_step(problems),
            "fixed_point_iterations_max": problems.most,
            "solver_iterations_per_step": cost.per_step(iterations),
            "solver_iterations_max": iterations.most,
            "milliseconds_per_step": milliseconds,
            "setup_seconds": seconds,
            "failure": run.failure.as_ref().map(ToString::to_string),
        }),
    )?;
    plot::draw(&output.path(PICTURE), &panels(arguments, &run))?;

    say!(
        "{unknowns} unknowns, {} steps of {:.4e} s to t = {:.5} s",
        cost.steps,
        arguments.step_size(),
        run.time_end
    )?;
    say!(
        "{} events (V(x0) above {:e} m/s) at t = {:.5?} s",
        run.events().len(),
        RECORDING.event.0,
        run.events()
    )?;
    if run.substepped > 0 {
        say!(
            "{} steps failed and were split into substeps",
            run.substepped
        )?;
    }
    say!(
        "displacement at x0 {:.6e} m, largest slip rate {:.4e} m/s",
        run.displacement_end,
        cost.peak_slip_rate
    )?;
    say!(
        "fixed-point iterations a step: average {:.3}, maximum {}; solver iterations a step: {:.2}",
        cost.per_step(problems),
        problems.most,
        cost.per_step(iterations)
    )?;
    say!("{milliseconds:.3} ms a step, {seconds:.3} s setup")?;
    say!("{}", output.told(&[HISTORY, PICTURE, SUMMARY]))?;
    if let Some(failure) = run.failure {
        return Err(failure.into());
    }
    let known = FIRST_SLIP
        .iter()
        .find(|known| known.0 == arguments.refinements);
    match (known, run.first_slip()) {
        (Some(known), Some(time)) if arguments.is_default() => {
            expect("first slip", time, known.1, 1e-6)
        }
        _ => Ok(()),
    }
}

/// The last tenth of the displacement, the last quarter of the velocity; all of a shorter run.
fn panels<'a>(arguments: &Arguments, run: &Record) -> [Panel<'a>; 2] {
    let whole = arguments.until >= 1.0;
    let since = |share: f64| if whole { share * END } else { 0.0 };
    let displacement = run.since(since(0.9), |s| 1e3 * s.displacement);
    let slip_rate = run.since(since(0.75), |s| s.velocity);
    [
        Panel::new("time [s]", "displacement at x0 [mm]").with("", DARK, 3, displacement),
        Panel::new("time [s]", "slip rate at x0 [m/s]")
            .logarithmic()
            .with("", DARK, 3, slip_rate),
    ]
}

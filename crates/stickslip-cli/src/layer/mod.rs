//! The layer: command line, and the computed and the exact solution, in numbers and as a picture.

mod run;

use crate::onsets::Onsets;
pub use run::run;
use std::num::NonZeroUsize;

use crate::cli::{Problem, count, expect};
use crate::output::{Files, number};
use crate::plot::{self, DARK, PALE, Panel};
use crate::record::Record;
use clap::{Parser, ValueEnum};
use serde::Serialize;
use serde_json::json;
use stickslip::problems::antiplane_layer::{AGING, END, ExactSample, FRICTION};
use stickslip::state::{LogTheta, Ruina, StateLaw};

/// Verification: a sliding layer against its exact solution. Writes history.csv, exact.csv, history.png and
/// summary.json.
#[derive(Debug, Clone, Parser)]
#[command(name = "layer")]
pub struct Arguments {
    /// The state law
    #[arg(long, default_value = "dieterich")]
    pub law: Law,
    /// Time steps in the whole 15 s
    #[arg(long, value_name = "N", default_value = "10000", value_parser = count)]
    pub steps: NonZeroUsize,
    /// Cells across the layer
    #[arg(long, value_name = "CELLS", default_value = "64", value_parser = count)]
    pub cells: NonZeroUsize,
    /// Write every K-th step to history.csv; the last one always is
    #[arg(long, value_name = "K", default_value = "1", value_parser = count)]
    pub every: NonZeroUsize,
    /// Time steps of the exact solution per transit time of a wave through the layer, 16 ms
    #[arg(long, value_name = "N", default_value = "1600", value_parser = count)]
    pub transit_steps: NonZeroUsize,
    /// The folder and the digits of the files.
    #[command(flatten)]
    pub files: Files,
}

/// The state law.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Law {
    /// The aging law: contacts age at rest
    Dieterich,
    /// The slip law: contacts change only by slip
    Ruina,
}

impl Law {
    /// The state law by that name.
    pub fn evolution(self) -> Box<dyn StateLaw<State = LogTheta>> {
        let slip_distance = FRICTION.slip_distance;
        match self {
            Law::Dieterich => Box::new(AGING),
            Law::Ruina => Box::new(Ruina { slip_distance }),
        }
    }
}

/// The slip rate of the base [m/s] from which it counts as slip: that of the top.
pub const SLIP: f64 = 2e-4;
/// The slip rates of the base [m/s] for the start and the end of an event.
pub const EVENT: (f64, f64) = (1e-3, SLIP);

const HISTORY: &str = "history.csv";
const EXACT: &str = "exact.csv";
const PICTURE: &str = "history.png";
const SUMMARY: &str = "summary.json";

/// The recorded exact solution.
pub struct Exact {
    /// The approximate number of kept samples.
    kept: usize,
    samples: Vec<ExactSample>,
    slips: Onsets,
    events: Onsets,
    peak_slip_rate: f64,
    displacement_end: f64,
    last: ExactSample,
}

impl Exact {
    /// The solution at rest.
    pub fn new(arguments: &Arguments) -> Self {
        let mut exact = Self {
            kept: (arguments.steps.get() / arguments.every.get()).max(1),
            samples: Vec::new(),
            slips: Onsets::new(SLIP, SLIP),
            events: Onsets::new(EVENT.0, EVENT.1),
            peak_slip_rate: 0.0,
            displacement_end: 0.0,
            last: ExactSample {
                time: 0.0,
                slip_rate: 0.0,
                displacement: 0.0,
            },
        };
        exact.slips.record(0.0, 0.0);
        exact.events.record(0.0, 0.0);
        exact
    }

    /// The last sample may lie beyond the end.
    pub fn add(&mut self, at: ExactSample) {
        if at.time * self.kept as f64 >= END * (self.samples.len() + 1) as f64 {
            self.samples.push(at);
        }
        let last = self.last;
        if last.time < END {
            self.slips.record(at.time, at.slip_rate);
            self.events.record(at.time, at.slip_rate);
            self.peak_slip_rate = self.peak_slip_rate.max(at.slip_rate);
            let share = ((END - last.time) / (at.time - last.time)).min(1.0);
            self.displacement_end =
                last.displacement + share * (at.displacement - last.displacement);
            self.last = at;
        }
    }
}

/// Writes and prints both solutions; fails if the first events are further apart than methods of second order allow.
pub fn report(arguments: &Arguments, run: Record, exact: &Exact) -> Result<(), Problem> {
    let output = arguments
        .files
        .create("layer", &[HISTORY, EXACT, PICTURE, SUMMARY])?;
    run.write_history(&output, HISTORY, |alpha| alpha)?;
    let row = |s: &ExactSample| [s.time, s.displacement, s.slip_rate].map(number);
    let samples = exact.samples.iter().map(row);
    output.table(EXACT, "time,displacement,slip_rate", samples)?;
    let (cost, events) = (run.cost, [run.events(), exact.events.times()]);
    let slips = [run.first_slip(), exact.slips.times().first().copied()];
    output.json(
        SUMMARY,
        &json!({
            "law": arguments.law,
            "steps": cost.steps,
            "cells": arguments.cells,
            "first_slip_time": slips[0],
            "event_times": events[0],
            "displacement_end": run.displacement_end,
            "peak_slip_rate": cost.peak_slip_rate,
            "exact_first_slip_time": slips[1],
            "exact_event_times": events[1],
            "exact_displacement_end": exact.displacement_end,
            "exact_peak_slip_rate": exact.peak_slip_rate,
            "exact_transit_steps": arguments.transit_steps,
            "fixed_point_iterations_mean": cost.per_step(cost.velocity_problems),
            "fixed_point_iterations_max": cost.velocity_problems.most,
            "solver_iterations_per_step": cost.per_step(cost.solver_iterations),
            "milliseconds_per_step": run.milliseconds_per_step(),
            "failure": run.failure.as_ref().map(ToString::to_string),
        }),
    )?;
    plot::draw(&output.path(PICTURE), &panels(&run, exact))?;

    say!(
        "{:<28}{:>16}{:>16}{:>14}",
        "",
        "computed",
        "exact",
        "difference"
    )?;
    let print = |what: &str, values: [Option<f64>; 2]| {
        let [computed, exact] = values.map(|x| x.map_or("none".into(), |x| format!("{x:.6}")));
        let difference = values[0]
            .zip(values[1])
            .map(|(computed, exact)| computed - exact);
        let difference = difference.map_or(String::new(), |x| format!("{x:+.2e}"));
        say!("{what:<28}{computed:>16}{exact:>16}{difference:>14}")
    };
    print("first slip [s]", slips)?;
    for k in 0..events[0].len().max(events[1].len()) {
        print(
            &format!("event {} [s]", k + 1),
            events.map(|times| times.get(k).copied()),
        )?;
    }
    let ends = [run.displacement_end, exact.displacement_end];
    print("displacement [mm]", ends.map(|u| Some(1e3 * u)))?;
    let peaks = [cost.peak_slip_rate, exact.peak_slip_rate];
    print("largest slip rate [mm/s]", peaks.map(|v| Some(1e3 * v)))?;
    say!(
        "{} steps, {:.3} ms each; coupling iterations a step: average {:.3}, maximum {}",
        cost.steps,
        run.milliseconds_per_step(),
        cost.per_step(cost.velocity_problems),
        cost.velocity_problems.most
    )?;
    say!("{}", output.told(&[HISTORY, EXACT, PICTURE, SUMMARY]))?;
    if let Some(failure) = run.failure {
        return Err(failure.into());
    }
    let [steps, cells] = [arguments.steps, arguments.cells].map(|n| n.get() as f64);
    let tolerance = 5e-5 * ((1e4 / steps).powi(2) + (64.0 / cells).powi(2));
    let firsts = [slips, events.map(|times| times.first().copied())];
    for (computed, exact) in firsts.into_iter().filter_map(|[a, b]| a.zip(b)) {
        expect(
            "time of the first slip or event",
            computed,
            exact,
            tolerance,
        )?;
    }
    Ok(())
}

/// The displacement of the base, and its slip rate from shortly before the first event on.
fn panels<'a>(run: &Record, exact: &Exact) -> [Panel<'a>; 2] {
    let start = 0.65 * END;
    let exact = |since: f64, value: fn(&ExactSample) -> f64| {
        let kept = exact.samples.iter().filter(move |s| s.time >= since);
        kept.map(|s| (s.time, value(s))).collect()
    };
    [
        Panel::new("time [s]", "displacement of the base [mm]")
            .with("exact", PALE, 4, exact(0.0, |s| 1e3 * s.displacement))
            .with(
                "computed",
                DARK,
                2,
                run.since(0.0, |s| 1e3 * s.displacement),
            ),
        Panel::new("time [s]", "slip rate [m/s]")
            .logarithmic()
            .with("", PALE, 4, exact(start, |s| s.slip_rate))
            .with("", DARK, 2, run.since(start, |s| s.velocity)),
    ]
}

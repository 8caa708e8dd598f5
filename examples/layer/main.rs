//! How far is the computed history of a sliding layer from the exact one?
//!
//! A layer of the slider's material, 1 m high, is moved at its top and slides at its base; nothing
//! depends on the position along it. Waves then give the slip rate of the base exactly, by one
//! scalar equation a time. The program computes both, and compares the times of the events.
//!
//! ```text
//! cargo run --release --example layer -- --steps 10000 --cells 64
//! ```

#[path = "../common/mod.rs"]
mod common;
mod exact;
mod report;

use std::num::NonZeroUsize;
use std::path::PathBuf;
use std::process::ExitCode;

use clap::{Parser, ValueEnum};
use serde::Serialize;
use stickslip::problems::{
    AGING, END, ExactSample, FRICTION, INITIAL_LOG_THETA, Layer, NORMAL_STRESS,
};
use stickslip::state::{LogTheta, Ruina, StateLaw};
use stickslip::{Newmark, Simulation, Tnnmg};

use common::cli::{self, Problem};
use common::output::{Output, digits};
use common::plot;
use common::record::{Recording, Run, Steps};
use exact::Exact;
use report::Summary;

const HISTORY: &str = "history.csv";
const EXACT: &str = "exact.csv";
const PICTURE: &str = "history.png";
const SUMMARY: &str = "summary.json";

/// The slip rate of the base [m/s] that counts as slip: that of the top.
const SLIP: f64 = 2e-4;
/// The slip rates of the base [m/s] above which an event begins and below which it is over.
const EVENT: (f64, f64) = (1e-3, SLIP);

/// A sliding layer against its exact solution. Writes history.csv, exact.csv, history.png and
/// summary.json.
#[derive(Debug, Clone, Parser)]
#[command(name = "layer")]
struct Arguments {
    /// How the state evolves
    #[arg(long, default_value = "dieterich")]
    law: Law,
    /// Time steps in the whole 15 s
    #[arg(long, value_name = "N", default_value = "10000")]
    steps: NonZeroUsize,
    /// Cells across the layer
    #[arg(long, value_name = "CELLS", default_value = "64")]
    cells: NonZeroUsize,
    /// Write every K-th step to history.csv; the last one always is
    #[arg(long, value_name = "K", default_value = "1")]
    every: NonZeroUsize,
    /// Time steps of the exact solution in the time a wave takes through the layer, 16 ms
    #[arg(long, value_name = "N", default_value = "1600")]
    transit_steps: NonZeroUsize,
    /// The folder to write to
    #[arg(long, value_name = "DIR", default_value = "out/layer")]
    out: PathBuf,
}

/// How the state evolves.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum, Serialize)]
#[serde(rename_all = "kebab-case")]
enum Law {
    /// The aging law: contacts grow at rest
    Dieterich,
    /// The slip law: contacts change only by slip
    Ruina,
}

fn main() -> ExitCode {
    cli::run(|arguments: &Arguments| match arguments.law {
        Law::Dieterich => compare(arguments, AGING),
        Law::Ruina => compare(
            arguments,
            Ruina {
                slip_distance: FRICTION.slip_distance,
            },
        ),
    })
}

fn compare<S>(arguments: &Arguments, law: S) -> Result<(), Problem>
where
    S: StateLaw<State = LogTheta> + Clone + 'static,
{
    let layer = Layer {
        cells: arguments.cells.get(),
        ..Layer::default()
    };
    let initial = LogTheta(INITIAL_LOG_THETA);
    let space = layer.space()?;
    let base = Layer::base(&space)?;
    let scene = layer
        .scene(&space)?
        .with_friction(&base, FRICTION, NORMAL_STRESS)
        .with_state(law.clone(), initial);
    let solver = Tnnmg::new(space.hierarchy().prolongations());
    let mut simulation = Simulation::new(scene, Newmark::default(), solver)?;
    let exact = Exact::solve(arguments, &layer, &law, initial)?;

    let output = Output::create(&arguments.out, &[HISTORY, EXACT, PICTURE, SUMMARY])?;
    let steps = arguments.steps.get();
    let dt = END / steps as f64;
    let recording = Recording {
        vertex: base.vertices()[0],
        every: arguments.every.get(),
        slip: SLIP,
        event: EVENT,
        log_theta: |alpha| alpha,
    };
    let run = Run::take(recording, &mut simulation, &Steps::Constant(steps, dt));

    let summary = Summary::new(arguments, &run, &exact);
    run.write_history(&output, HISTORY)?;
    let digits = |s: &ExactSample| [s.time, s.displacement, s.slip_rate].map(digits);
    let samples = exact.samples.iter().map(digits);
    output.table(EXACT, &["time", "displacement", "slip_rate"], samples)?;
    output.json(SUMMARY, &summary)?;
    plot::draw(&output.path(PICTURE), &report::panels(&run, &exact))?;
    summary.print();
    println!(
        "{HISTORY}, {EXACT}, {PICTURE}, {SUMMARY} in {}",
        output.folder().display()
    );
    run.failure.map_or(Ok(()), |failure| Err(failure.into()))
}

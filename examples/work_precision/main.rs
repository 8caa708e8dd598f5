//! Which method reaches a given error in the least time?
//!
//! Schemes, state updates, couplings, solvers and step-size control on a layer with an exact
//! solution, the paper's slider and a block on a spring: error against run time, as tables and
//! pictures.
//!
//! ```text
//! cargo run --release --example work_precision -- --scene layer
//! cargo run --release --example work_precision -- --report docs/reports/work-precision.md
//! ```

#[path = "../common/mod.rs"]
mod common;
mod conclusions;
mod layer;
mod method;
mod own_scene;
mod report;
mod slider;
mod slow_slider;
mod spring_slider;
mod study;
mod waves;

use std::path::PathBuf;
use std::process::ExitCode;

use clap::{Parser, ValueEnum};
use serde::Serialize;

use common::cli::{self, Problem};
use common::output::Output;
use study::{Effort, Study, Summary};

const SUMMARY: &str = "summary.json";

/// Error against run time of all methods. Writes a table and a picture for each scene, and
/// summary.json.
#[derive(Debug, Clone, Parser)]
#[command(name = "work_precision")]
struct Arguments {
    /// The scene
    #[arg(long, default_value = "all")]
    scene: Choice,
    /// Two settings of each method, coarse meshes: a few seconds
    #[arg(long)]
    quick: bool,
    /// Runs at each setting, of which the median counts [default: 3; 1 with --quick]
    #[arg(long, value_name = "N")]
    runs: Option<usize>,
    /// The folder to write to
    #[arg(long, value_name = "DIR", default_value = "out/work_precision")]
    out: PathBuf,
    /// Also write a report here, and its pictures to ../images next to it
    #[arg(long, value_name = "FILE")]
    report: Option<PathBuf>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum, Serialize)]
#[serde(rename_all = "kebab-case")]
enum Choice {
    /// A layer in antiplane shear, against its exact solution
    Layer,
    /// The paper's slider; loaded as it is, and slowly
    Slider,
    /// A block on a spring: stick-slip, and a velocity step
    SpringSlider,
    /// All of them
    All,
}

fn main() -> ExitCode {
    cli::run(measure)
}

fn measure(arguments: &Arguments) -> Result<(), Problem> {
    let &Arguments { scene, quick, .. } = arguments;
    let runs = arguments.runs.unwrap_or(if quick { 1 } else { 3 });
    let effort = Effort { quick, runs };
    let output = Output::create(&arguments.out, &[SUMMARY])?;
    let of = |choices: [Choice; 2]| choices.contains(&scene);
    let (mut studies, mut waves) = (Vec::new(), Vec::new());
    let mut add = |study: Study| -> Result<(), Problem> {
        study.print();
        study.write(&output)?;
        studies.push(study);
        Ok(())
    };
    if of([Choice::Layer, Choice::All]) {
        let (layers, steps) = layer::measure(effort)?;
        layers.into_iter().try_for_each(&mut add)?;
        waves.extend(steps);
    }
    if of([Choice::Slider, Choice::All]) {
        let (slider, steps) = slider::measure(effort)?;
        add(slider)?;
        waves.extend(steps);
        let (slow, steps) = slow_slider::measure(effort)?;
        slow.into_iter().try_for_each(&mut add)?;
        waves.extend(steps);
    }
    if of([Choice::SpringSlider, Choice::All]) {
        add(spring_slider::stick_slip(effort)?)?;
        add(spring_slider::velocity_step(effort)?)?;
    }
    waves::print(&waves);
    waves::write(&waves, &output)?;
    let own = own_scene::measure()?;
    for m in &own {
        println!(
            "  {:<20}{:>11.2e}{:>11.2e}{:>11.2e} s",
            m.method, m.setting, m.error, m.seconds
        );
    }
    let summaries: Vec<Summary<'_>> = studies.iter().map(Study::summary).collect();
    output.json(SUMMARY, &summaries)?;
    if let Some(file) = &arguments.report {
        report::write(file, &studies, &waves, &own, effort)?;
    }
    println!(
        "{SUMMARY}, tables and pictures in {}",
        output.folder().display()
    );
    Ok(())
}

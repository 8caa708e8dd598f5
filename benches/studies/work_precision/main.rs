//! Which method reaches a given error in the least time?
//!
//! Schemes, state updates, couplings, solvers and step-size control on a layer with an exact
//! solution, the paper's slider and a block on a spring: error against run time, as tables and
//! pictures.
//!
//! ```text
//! cargo run --release --manifest-path benches/studies/Cargo.toml --bin work_precision -- --scene layer
//! ```

mod cycling_slider;
mod layer;
mod method;
mod question;
mod report;
mod slider;
mod slow_cycles;
mod slow_slider;
mod spring_slider;
mod study;
mod waves;

use std::path::PathBuf;
use std::process::ExitCode;

use clap::{Parser, ValueEnum};
use stickslip_cli::cli::{self, Problem};
use stickslip_cli::output::Output;
use stickslip_studies::Report;

use study::{Effort, Study, Summary};
use waves::Waves;

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
    /// A report whose tables of the scenes are replaced; its pictures go to ../images next to it
    #[arg(long, value_name = "FILE", conflicts_with = "quick")]
    report: Option<PathBuf>,
}

/// A group of scenes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Choice {
    /// A layer in antiplane shear, against its exact solution
    Layer,
    /// The paper's slider; loaded as it is, and slowly
    Slider,
    /// A hundred events of the slider, slowly loaded, by schemes, tolerances and weights of its motion
    SlowCycles,
    /// A block on a spring: stick-slip, and a velocity step
    SpringSlider,
    /// All of them
    All,
}

/// The scenes of each group.
const SCENES: [(Choice, &[&str]); 3] = [
    (Choice::Layer, &["layer", "layer-events"]),
    (
        Choice::Slider,
        &["slider", "slow-slider", "slow-slider-peak"],
    ),
    (Choice::SpringSlider, &["spring-slider", "velocity-step"]),
];

impl Choice {
    /// Whether a group was asked for.
    fn includes(self, group: Choice) -> bool {
        self == Choice::All || self == group
    }

    /// The names of the tables of the report.
    fn tables(self) -> Vec<String> {
        let wanted = SCENES.iter().filter(|(group, _)| self.includes(*group));
        let scenes = wanted.flat_map(|(_, scenes)| scenes.iter());
        let mut names: Vec<String> = scenes.flat_map(|scene| report::names(scene)).collect();
        for (group, (name, _)) in [Choice::Layer, Choice::Slider]
            .into_iter()
            .zip(report::STEPS)
        {
            if self.includes(group) {
                names.push(name.into());
            }
        }
        if self.includes(Choice::SlowCycles) {
            names.push(slow_cycles::NAME.into());
        }
        names
    }
}

fn main() -> ExitCode {
    cli::run(write)
}

fn write(arguments: &Arguments) -> Result<(), Problem> {
    let &Arguments { scene, quick, .. } = arguments;
    let runs = arguments.runs.unwrap_or(if quick { 1 } else { 3 });
    let names = scene.tables();
    let report = match &arguments.report {
        Some(file) => Some(Report::open(file, names.iter().map(String::as_str))?),
        None => None,
    };
    let output = Output::create(&arguments.out, &[SUMMARY])?;
    let mut cycles = Vec::new();
    if scene.includes(Choice::SlowCycles) {
        cycles = slow_cycles::measure(quick)?;
        slow_cycles::write(&cycles, &output)?;
    }
    let (studies, waves) = measure(scene, Effort { quick, runs }, &output)?;
    waves::print(&waves);
    waves::write(&waves, &output)?;
    let summaries: Vec<Summary<'_>> = studies.iter().map(Study::summary).collect();
    output.json(SUMMARY, &summaries)?;
    if let Some(report) = report {
        report::write(&report, &studies, &waves)?;
        if !cycles.is_empty() {
            report.fill(&[slow_cycles::table(&cycles)?])?;
        }
    }
    println!(
        "{SUMMARY}, tables and pictures in {}",
        output.folder().display()
    );
    Ok(())
}

/// Measures the scenes chosen; table and picture of each are written as soon as it is finished.
fn measure(
    scene: Choice,
    effort: Effort,
    output: &Output,
) -> Result<(Vec<Study>, Vec<Waves>), Problem> {
    let (mut studies, mut waves) = (Vec::new(), Vec::new());
    let mut add = |study: Study| -> Result<(), Problem> {
        study.print();
        study.write(output)?;
        studies.push(study);
        Ok(())
    };
    if scene.includes(Choice::Layer) {
        let (layers, steps) = layer::measure(effort)?;
        layers.into_iter().try_for_each(&mut add)?;
        waves.extend(steps);
    }
    if scene.includes(Choice::Slider) {
        let (slider, steps) = slider::measure(effort)?;
        add(slider)?;
        waves.extend(steps);
        let (slow, steps) = slow_slider::measure(effort)?;
        slow.into_iter().try_for_each(&mut add)?;
        waves.extend(steps);
    }
    if scene.includes(Choice::SpringSlider) {
        add(spring_slider::stick_slip(effort)?)?;
        add(spring_slider::velocity_step(effort)?)?;
    }
    Ok((studies, waves))
}

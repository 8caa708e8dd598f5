//! The commands of the program `stickslip`, one a module.

use std::ffi::OsString;
use std::num::NonZeroUsize;

use clap::{Parser, Subcommand};

use crate::cli::{self, Problem, Refusal};
use crate::output::Files;
use crate::{
    earthquakes, figures, fit, gmsh, injection, layer, rupture, rupture3d, slider, slider3d,
    spring_slider, sweep, threads,
};

/// Stick-slip of elastic bodies under rate-and-state friction. Each command writes numbers and pictures to a folder.
#[derive(Debug, Parser)]
#[command(name = "stickslip", version)]
pub struct CommandLine {
    /// Number of threads that share the work on a large body or fault, with the same bits on any number; with `sweep` and
    /// `figures`, that of runs at a time [default: RAYON_NUM_THREADS, or as many as there are processors]
    #[arg(long, global = true, value_name = "N", value_parser = cli::count)]
    threads: Option<NonZeroUsize>,
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    Slider(Box<slider::Arguments>),
    Figures(figures::Arguments),
    Fit(Box<fit::Arguments>),
    Earthquakes(Box<earthquakes::Arguments>),
    Injection(Box<injection::Arguments>),
    Gmsh(Box<gmsh::Arguments>),
    Sweep(sweep::Arguments),
    Rupture(rupture::Arguments),
    Rupture3d(rupture3d::Arguments),
    Layer(layer::Arguments),
    SpringSlider(Box<spring_slider::Arguments>),
    Slider3d(slider3d::Arguments),
}

impl Command {
    /// Where it writes to, and the name of its folder by default.
    fn files(&self) -> (&Files, &'static str) {
        match self {
            Self::Slider(arguments) => (&arguments.files, "slider"),
            Self::Figures(arguments) => arguments.files(),
            Self::Fit(arguments) => (&arguments.output, "fit"),
            Self::Earthquakes(arguments) => (&arguments.files, "earthquakes"),
            Self::Injection(arguments) => (&arguments.files, "injection"),
            Self::Gmsh(arguments) => (&arguments.files, "gmsh"),
            Self::Sweep(arguments) => (&arguments.files, "sweep"),
            Self::Rupture(arguments) => (&arguments.files, "rupture"),
            Self::Rupture3d(arguments) => (&arguments.files, "rupture3d"),
            Self::Layer(arguments) => (&arguments.files, "layer"),
            Self::SpringSlider(arguments) => (&arguments.files, "spring_slider"),
            Self::Slider3d(arguments) => (&arguments.files, "slider3d"),
        }
    }
}

/// Runs the command of a command line.
///
/// # Errors
/// The command fails.
pub fn run(line: &CommandLine) -> Result<(), Problem> {
    let (files, name) = line.command.files();
    files.probe(name)?;
    match line.threads {
        Some(threads) => threads::inside(threads, || take(&line.command)),
        None => take(&line.command),
    }
}

fn take(command: &Command) -> Result<(), Problem> {
    match command {
        Command::Slider(arguments) => slider::run(arguments),
        Command::Figures(arguments) => figures::run(arguments),
        Command::Fit(arguments) => fit::run(arguments),
        Command::Earthquakes(arguments) => earthquakes::run(arguments),
        Command::Injection(arguments) => injection::run(arguments),
        Command::Gmsh(arguments) => gmsh::run(arguments),
        Command::Sweep(arguments) => sweep::run(arguments),
        Command::Rupture(arguments) => rupture::run(arguments),
        Command::Rupture3d(arguments) => rupture3d::run(arguments),
        Command::Layer(arguments) => layer::run(arguments),
        Command::SpringSlider(arguments) => spring_slider::run(arguments),
        Command::Slider3d(arguments) => slider3d::run(arguments),
    }
}

/// Runs the command that these words give, without the name of the program, within this process.
///
/// # Errors
/// The words are no command line, or the command fails.
pub fn answer(words: impl IntoIterator<Item = OsString>) -> Result<(), Refusal> {
    cli::answer([OsString::from("stickslip")].into_iter().chain(words), run)
}

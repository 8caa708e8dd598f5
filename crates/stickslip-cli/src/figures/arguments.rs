//! The command line of the figures.

use std::num::NonZeroUsize;

use clap::{Parser, ValueEnum};

use crate::cli::{Problem, count};
use crate::output::{Files, Output};

/// Figures of Pipping, Sander and Kornhuber, with their settings, and two of our own. Each is a CSV file, a PNG, an SVG
/// and a summary.json in a folder by its name. Runs are kept in the folder `runs`: an interrupted figure continues, and
/// a repeated one takes no time. Delete that folder to compute anew.
#[derive(Debug, Clone, Parser)]
#[command(name = "figures")]
pub struct Arguments {
    /// The figure
    figure: Figure,
    /// Coarser meshes and larger steps: each figure in under a minute
    #[arg(long)]
    pub quick: bool,
    /// Number of runs at a time [default: as many as there are cores]
    #[arg(long, value_name = "N", value_parser = count)]
    threads: Option<NonZeroUsize>,
    /// Add the finest mesh of figure 6.1, 8 refinements; takes hours
    #[arg(long)]
    pub finest: bool,
    /// The folder, out/figures-quick for --quick by default, and the digits of the files.
    #[command(flatten)]
    files: Files,
}

/// A figure by its number in the paper, or one of our own.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Figure {
    /// Velocity steps: friction over displacement
    #[value(name = "1.1")]
    VelocityStep,
    /// Fixed-point iterations over refinements
    #[value(name = "6.1")]
    Iterations,
    /// The displacement at the centre through the last events
    #[value(name = "6.2")]
    Displacement,
    /// The slip rate at the centre through the last events
    #[value(name = "6.3")]
    Velocity,
    /// The same by backward Euler
    #[value(name = "6.4")]
    Damped,
    /// The slip rate in space and time through an event
    #[value(name = "6.5")]
    Rupture,
    /// The events of 6.3 by a method of second order
    Converged,
    /// Error against run time
    Work,
    /// All figures
    All,
}

impl Figure {
    /// The name of the figure on the command line.
    pub fn name(self) -> String {
        self.to_possible_value()
            .map_or_else(String::new, |value| value.get_name().into())
    }
}

impl Arguments {
    /// The figures to draw.
    pub fn figures(&self) -> Vec<Figure> {
        match self.figure {
            Figure::All => {
                let all = Figure::value_variants().iter().copied();
                all.filter(|&figure| figure != Figure::All).collect()
            }
            one => vec![one],
        }
    }

    /// Where they are written to, and the name of the folder by default.
    pub fn files(&self) -> (&Files, &'static str) {
        let name = if self.quick {
            "figures-quick"
        } else {
            "figures"
        };
        (&self.files, name)
    }

    /// Opens the folder to write to.
    ///
    /// # Errors
    /// It cannot be created.
    pub fn output(&self) -> Result<Output, Problem> {
        let (files, name) = self.files();
        files.create(name, &[])
    }

    /// The number of simultaneous runs.
    pub fn threads(&self) -> usize {
        let cores = || std::thread::available_parallelism().map_or(1, NonZeroUsize::get);
        self.threads.map_or_else(cores, NonZeroUsize::get)
    }
}

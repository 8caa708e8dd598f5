//! The command line of a rupture in space.

use std::path::PathBuf;

use clap::{Parser, value_parser};
use stickslip::solvers::MOST_LEVELS;

use super::Benchmark;
use crate::checkpoints::{Checkpoints, Tags};
use crate::cli::{finite, non_negative, positive};
use crate::output::Files;

/// A dynamic rupture of a vertical strike-slip fault in space, in explicit steps without a matrix
#[derive(Debug, Parser)]
pub struct Arguments {
    /// The benchmark
    #[arg(long, value_enum, default_value_t = Benchmark::Tpv102)]
    pub problem: Benchmark,
    /// The largest edge of cells at the fault [m]
    #[arg(long, value_name = "METRES", default_value_t = 400.0, value_parser = positive)]
    pub cell: f64,
    /// The growth of edges with the distance from the fault
    #[arg(long, value_name = "SHARE", default_value_t = 0.15, value_parser = non_negative)]
    pub growth: f64,
    /// The rock beyond the fault, on all sides [m]
    #[arg(long, value_name = "METRES", default_value_t = 15e3, value_parser = positive)]
    pub margin: f64,
    /// A Gmsh file of the rock in place of --cell, --growth and --margin: a box with the fault at y = 0, the free surface
    /// at z = 0 and x along strike from the middle of the fault [m]
    #[arg(long, value_name = "FILE", conflicts_with_all = ["cell", "growth", "margin"])]
    pub mesh: Option<PathBuf>,
    /// The relaxation time of Kelvin-Voigt viscosity, as a share of the time in which a pressure wave crosses the
    /// longest edge at the fault [default: 0.1, and 0 for tpv5]
    #[arg(long, value_name = "SHARE", value_parser = non_negative)]
    pub damping: Option<f64>,
    /// Levels of local steps: cells whose vertices vibrate 2^l times slower than the fastest act every 2^l-th step; 1 for none
    #[arg(long, value_name = "COUNT", default_value_t = 1, value_parser = value_parser!(u8).range(1..=MOST_LEVELS as i64))]
    pub levels: u8,
    /// The end of the run [s]
    #[arg(long, value_name = "TIME", default_value_t = 12.0, value_parser = positive)]
    pub until: f64,
    /// Record another station on the fault, at a distance along strike and a depth [m]; as often as wanted
    #[arg(long, value_name = "X,DEPTH", value_parser = place, allow_hyphen_values = true)]
    pub station: Vec<[f64; 2]>,
    /// Write every K-th step as VTU files, 0 for none
    #[arg(
        long,
        value_name = "K",
        default_value_t = 0,
        conflicts_with = "restart"
    )]
    pub vtu_every: usize,
    /// Checkpoints and restarts.
    #[command(flatten)]
    pub checkpoints: Checkpoints,
    /// The folder and the digits of the files.
    #[command(flatten)]
    pub files: Files,
}

impl Arguments {
    /// The places of all stations \[m\].
    pub(super) fn stations(&self) -> Vec<[f64; 2]> {
        let own = self.problem.stations().into_iter();
        own.chain(self.station.iter().copied()).collect()
    }

    /// The relaxation time of viscosity over the time in which a pressure wave crosses the longest edge at the fault.
    pub(super) fn damping(&self) -> f64 {
        self.damping.unwrap_or(self.problem.damping())
    }

    /// What identifies this run in a checkpoint.
    pub(super) fn tags(&self) -> Tags {
        let stations = format!("{:?}", self.station);
        [
            ("problem", self.problem.name().to_owned()),
            ("end", self.until.to_string()),
            ("damping", self.damping().to_string()),
            ("levels", self.levels.to_string()),
            ("stations", stations),
        ]
        .map(|(name, value)| (name.to_owned(), value))
        .to_vec()
    }
}

/// Two numbers with a comma between.
fn place(text: &str) -> Result<[f64; 2], String> {
    let (x, depth) = text
        .split_once(',')
        .ok_or("two numbers with a comma between are needed")?;
    Ok([finite(x.trim())?, finite(depth.trim())?])
}

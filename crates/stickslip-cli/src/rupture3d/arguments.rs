//! The command line of a rupture in space.

use clap::{Parser, ValueEnum};

use crate::cli::{non_negative, positive};
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
    /// The end of the run [s]
    #[arg(long, value_name = "TIME", default_value_t = 12.0, value_parser = positive)]
    pub until: f64,
    /// The folder and the digits of the files.
    #[command(flatten)]
    pub files: Files,
}

/// Benchmarks by name.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Benchmark {
    /// Slip weakening below a free surface, with two patches of other stress
    Tpv5,
    /// Rate and state with the aging law in a whole space
    Tpv101,
    /// The same below a free surface
    Tpv102,
}

impl Benchmark {
    /// Its name.
    pub fn name(self) -> &'static str {
        match self {
            Self::Tpv5 => "TPV5",
            Self::Tpv101 => "TPV101",
            Self::Tpv102 => "TPV102",
        }
    }

    /// The depth of the middle of the fault in the body \[m\].
    pub fn middle(self) -> f64 {
        match self {
            Self::Tpv101 => 0.0,
            Self::Tpv5 | Self::Tpv102 => 7.5e3,
        }
    }

    /// The largest distance along strike and the largest depth in the body that slips \[m\].
    pub fn extent(self) -> [f64; 2] {
        match self {
            Self::Tpv5 => [15e3, 15e3],
            Self::Tpv101 => [18e3, 10.5e3],
            Self::Tpv102 => [18e3, 18e3],
        }
    }

    /// Whether the rupture is the same on both sides of its middle along strike, so that one of them is computed.
    pub fn is_even(self) -> bool {
        self != Self::Tpv5
    }

    /// Stations on the fault: along strike and depth, in TPV101 from the middle \[m\].
    pub fn stations(self) -> Vec<[f64; 2]> {
        match self {
            Self::Tpv5 => [
                [0.0, 7.5e3],
                [-2e3, 7.5e3],
                [2e3, 7.5e3],
                [-2e3, 5.5e3],
                [2e3, 5.5e3],
                [0.0, 0.0],
                [0.0, 3e3],
                [0.0, 12e3],
                [-4.5e3, 7.5e3],
                [4.5e3, 7.5e3],
                [-7.5e3, 7.5e3],
                [7.5e3, 7.5e3],
                [-12e3, 7.5e3],
                [12e3, 7.5e3],
            ]
            .to_vec(),
            Self::Tpv101 => [
                [0.0, 0.0],
                [0.0, 3e3],
                [0.0, 6e3],
                [4.5e3, 0.0],
                [9e3, 0.0],
                [12e3, 0.0],
                [15e3, 0.0],
            ]
            .to_vec(),
            Self::Tpv102 => [
                [0.0, 0.0],
                [0.0, 3e3],
                [0.0, 7.5e3],
                [0.0, 12e3],
                [4.5e3, 0.0],
                [4.5e3, 7.5e3],
                [9e3, 0.0],
                [9e3, 7.5e3],
                [12e3, 0.0],
                [12e3, 3e3],
                [12e3, 7.5e3],
                [12e3, 12e3],
            ]
            .to_vec(),
        }
    }
}

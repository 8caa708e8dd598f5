//! The command line of fluid injection.

use std::num::NonZeroUsize;
use std::path::PathBuf;

use clap::{Args, Parser, ValueEnum};

use super::Friction;
use crate::cli::{count, finite, fraction, non_negative, poisson_ratio, positive};
use crate::output::Files;

/// Fluid injection into a planar fault: slip, pore pressure and their fronts
#[derive(Debug, Parser)]
pub struct Arguments {
    /// The fault.
    #[command(flatten)]
    pub geometry: Geometry,
    /// The fluid.
    #[command(flatten)]
    pub injection: Injection,
    /// The fault zone.
    #[command(flatten)]
    pub zone: Zone,
    /// Friction.
    #[command(flatten)]
    pub friction: Friction,
    /// The steps.
    #[command(flatten)]
    pub time: Time,
    /// The report.
    #[command(flatten)]
    pub output: Output,
    /// The folder and the digits of the files.
    #[command(flatten)]
    pub files: Files,
}

/// The fault and its stresses: its centre is the origin.
#[derive(Debug, Args)]
pub struct Geometry {
    /// A fault along a line, slipping out of its plane, in the place of a plane
    #[arg(long)]
    pub line: bool,
    /// The length of the fault along strike [m] [default: 41 cells on a plane, 201 on a line]
    #[arg(long, value_name = "METRES", value_parser = positive)]
    pub length: Option<f64>,
    /// The width of a plane down dip [m] [default: 41 cells]
    #[arg(long, value_name = "METRES", value_parser = positive, conflicts_with = "line")]
    pub width: Option<f64>,
    /// The length of a cell [m], a whole part of the fault [default: 15 on a plane, 10 on a line]
    #[arg(long, value_name = "METRES", value_parser = positive)]
    pub cell: Option<f64>,
    /// The shear modulus of the rock [Pa]
    #[arg(long, value_name = "PA", default_value = "32.04e9", value_parser = positive)]
    pub shear_modulus: f64,
    /// Poisson's ratio of the rock, for a plane
    #[arg(long, value_name = "RATIO", default_value_t = 0.25, value_parser = poisson_ratio, conflicts_with = "line")]
    pub poisson_ratio: f64,
    /// The speed of shear waves [m/s]
    #[arg(long, value_name = "SPEED", default_value_t = 3464.0, value_parser = positive)]
    pub shear_wave_speed: f64,
    /// The normal stress less the initial pore pressure [Pa]
    #[arg(long, value_name = "PA", default_value = "25e6", value_parser = positive)]
    pub normal_stress: f64,
    /// The initial shear stress along strike [Pa]
    #[arg(long, value_name = "PA", default_value = "14e6", value_parser = non_negative)]
    pub shear_stress: f64,
}

/// Wells, or one well at the centre.
#[derive(Debug, Args)]
pub struct Injection {
    /// A table of rates with the columns time [s] and rate [m^3/s; on a line m^2/s], and the position of the well in x
    /// [m] along strike and on a plane y down dip, 0 without these; rows of one position are one well [default: the
    /// well of --rate]
    #[arg(long, value_name = "FILE", conflicts_with_all = ["rate", "shut_in"])]
    pub wells: Option<PathBuf>,
    /// The rate between two rows of --wells
    #[arg(long, value_enum, default_value_t = Rates::Linear, requires = "wells")]
    pub rates: Rates,
    /// The rate of a well at the centre [m^3/s; on a line m^2/s] [default: 1e-3 on a plane, 8e-6 on a line]
    #[arg(long, value_name = "RATE", value_parser = finite)]
    pub rate: Option<f64>,
    /// The time at which the well at the centre stops [s]
    #[arg(long, value_name = "TIME", default_value_t = 360_000.0, value_parser = positive)]
    pub shut_in: f64,
}

/// Hydraulic properties.
#[derive(Debug, Args)]
pub struct Zone {
    /// The permeability of the fault zone [m^2]
    #[arg(long, value_name = "K", default_value = "5e-14", value_parser = positive)]
    pub permeability: f64,
    /// The viscosity of the fluid [Pa s]
    #[arg(long, value_name = "ETA", default_value = "1e-3", value_parser = positive)]
    pub viscosity: f64,
    /// The storage: porosity times the compressibility of fluid and pores [1/Pa]
    #[arg(long, value_name = "STORAGE", default_value = "1e-9", value_parser = positive)]
    pub storage: f64,
    /// The hydraulic thickness of the fault zone [m]
    #[arg(long, value_name = "METRES", default_value_t = 1.0, value_parser = positive)]
    pub thickness: f64,
    /// The ends of the fault zone
    #[arg(long, value_enum, default_value_t = Sides::Sealed)]
    pub sides: Sides,
    /// The least effective normal stress that friction sees, where pore pressure passes the normal stress [Pa]; the
    /// report says for how many cells
    #[arg(long, value_name = "PA", value_parser = positive, conflicts_with = "allow_opening")]
    pub least_normal_stress: Option<f64>,
    /// Open the fault where pore pressure passes the normal stress: no friction is there
    #[arg(long, alias = "open")]
    pub allow_opening: bool,
}

/// The run.
#[derive(Debug, Args)]
pub struct Time {
    /// The end of the run [s]
    #[arg(long, value_name = "TIME", default_value_t = 864_000.0, value_parser = positive)]
    pub end: f64,
    /// The error tolerance of ln V and ln theta per step, for friction that depends on rate and state
    #[arg(long, value_name = "TOLERANCE", default_value = "1e-4", value_parser = positive, conflicts_with = "constant_friction")]
    pub adaptive: f64,
    /// The number of equal steps, for --constant-friction
    #[arg(long, value_name = "NUMBER", default_value = "200", value_parser = count, requires = "constant_friction")]
    pub steps: NonZeroUsize,
}

/// The report.
#[derive(Debug, Args)]
pub struct Output {
    /// The front of pore pressure encloses cells with more than this share of the largest pressure at the time
    #[arg(long, value_name = "SHARE", default_value_t = 0.01, value_parser = fraction)]
    pub pressure_share: f64,
    /// The front of slip encloses cells with more than this share of the largest slip at the time, beyond slip at the
    /// initial rate
    #[arg(long, value_name = "SHARE", default_value_t = 0.01, value_parser = fraction)]
    pub slip_share: f64,
    /// The slip rate from which slip is seismic [m/s]
    #[arg(long, value_name = "RATE", default_value = "1e-2", value_parser = positive)]
    pub seismic_rate: f64,
    /// A station beside the wells, x or x,y [m]; repeatable
    #[arg(long = "station", value_name = "X,Y", value_parser = place, allow_hyphen_values = true)]
    pub stations: Vec<[f64; 2]>,
}

/// Rates between two rows by name.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Rates {
    /// Linear between rows; two rows of one time are a jump
    Linear,
    /// Constant up to the next row
    Constant,
}

/// The ends of the fault zone by name.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Sides {
    /// No fluid passes
    Sealed,
    /// The pore pressure does not change
    Drained,
}

/// Reads a position: x, or x and y with a comma between.
fn place(text: &str) -> Result<[f64; 2], String> {
    let numbers: Result<Vec<f64>, String> =
        text.split(',').map(|part| finite(part.trim())).collect();
    match numbers?[..] {
        [x] => Ok([x, 0.0]),
        [x, y] => Ok([x, y]),
        _ => Err("must be x or x,y".into()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn positions_have_one_or_two_numbers() {
        assert_eq!(place("-20"), Ok([-20.0, 0.0]));
        assert_eq!(place("1e2, -3"), Ok([100.0, -3.0]));
        for wrong in ["", "1,2,3", "x", "1,", "nan"] {
            assert!(place(wrong).is_err(), "{wrong}");
        }
    }
}

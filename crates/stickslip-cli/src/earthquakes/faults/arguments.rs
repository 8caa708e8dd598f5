//! The command line of faults of a file.

use std::path::PathBuf;

use clap::Args;

use crate::cli::positive;

/// The settings of faults of a file, in the place of a published problem.
#[derive(Debug, Args)]
pub struct FaultFile {
    /// Faults along polylines in a vertical plane, in the place of a problem: a table of points x, z and, of several,
    /// fault [m, a number]; z is the height above the free surface, 0 or less. Slip changes their normal stress
    #[arg(long, value_name = "FILE", conflicts_with = "problem")]
    pub faults: Option<PathBuf>,
    /// --faults: friction by depth, a table with the columns depth [m], a, b and, if there, slip_distance [m] and
    /// normal_stress [Pa]; that of bp1 by the distance down dip by default
    #[arg(long, value_name = "FILE", requires = "faults")]
    pub friction: Option<PathBuf>,
    /// --faults: slip across the plane of the polylines, in place of up dip
    #[arg(long, requires = "faults", conflicts_with_all = ["thrust", "normal"])]
    pub antiplane: bool,
    /// --faults: the slip rate beyond the cells [m/s], 1e-9 by default
    #[arg(long, value_name = "M/S", requires = "faults", value_parser = positive)]
    pub plate_rate: Option<f64>,
}

//! The command line of faults of a file.

use std::path::PathBuf;

use clap::Args;

use crate::cli::positive;

/// The settings of faults of a file, in the place of a published problem.
#[derive(Debug, Args)]
pub struct FaultFile {
    /// Faults in the place of a problem, along polylines in a vertical plane or of triangles in space: a table of points x,
    /// z and, of several, fault [m, a number], or FILE.msh of Gmsh, or FILE.stl; z is the height above the free surface, 0
    /// or less. Slip changes their normal stress
    #[arg(long, value_name = "FILE", conflicts_with = "problem")]
    pub faults: Option<PathBuf>,
    /// --faults: friction by depth, a table with the columns depth [m], a, b and, if there, slip_distance [m] and
    /// normal_stress [Pa]; by default that of bp1 by the distance down dip, of triangles by depth
    #[arg(long, value_name = "FILE", requires = "faults")]
    pub friction: Option<PathBuf>,
    /// --faults, polylines: slip across their plane, in place of up dip
    #[arg(long, requires = "faults", conflicts_with_all = ["thrust", "normal"])]
    pub antiplane: bool,
    /// --faults, triangles: the direction of slip from strike [degrees], 90 up dip and 0 left-lateral; 90 by default
    #[arg(long, value_name = "DEGREES", requires = "faults", allow_hyphen_values = true, conflicts_with_all = ["thrust", "normal"])]
    pub rake: Option<f64>,
    /// --faults FILE.msh: the physical groups of the faults, separated by commas; all triangles by default
    #[arg(long, value_name = "NAMES", requires = "faults", value_delimiter = ',')]
    pub groups: Vec<String>,
    /// --faults: the slip rate beyond the cells [m/s], 1e-9 by default
    #[arg(long, value_name = "M/S", requires = "faults", value_parser = positive)]
    pub plate_rate: Option<f64>,
    /// --faults: write every K-th step as VTU files of the cells for ParaView, 0 for none
    #[arg(long, value_name = "K", requires = "faults", default_value_t = 0)]
    pub vtu_every: usize,
}

//! The command line of receivers off a fault.

use std::path::PathBuf;

use clap::Args;

use crate::cli::positive;

/// Where displacement off the fault is wanted.
#[derive(Debug, Args)]
pub struct OffFault {
    /// Displacement and velocity off the fault, without seismic waves: a table of points x, y, z [m] or x, z and, if there,
    /// name; z is the height above the free surface. Writes one file per point, with --seas there as srfst_NAME
    #[arg(long, value_name = "FILE")]
    pub receivers: Option<PathBuf>,
    /// Planes in a half space, triangles: displacement of the free surface in each event and at the end, as VTU files of a
    /// grid with so many metres between its points
    #[arg(long, value_name = "METRES", value_parser = positive)]
    pub surface_grid: Option<f64>,
}

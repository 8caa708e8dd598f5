//! Fluid injection into a planar fault: command line, scene and report.

mod arguments;
mod fault;
mod friction;
mod fronts;
mod pictures;
mod record;
mod run;
mod wells;

pub use arguments::{Arguments, Geometry, Injection, Output, Rates, Sides, Time, Zone};
pub use friction::{Friction, Law};
pub use run::run;

use crate::cli::Problem as Failed;

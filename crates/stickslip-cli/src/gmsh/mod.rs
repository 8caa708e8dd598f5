//! The slider on a mesh of Gmsh: command line and report.

mod arguments;
mod compression;
mod faults;
mod report;
mod run;

pub use arguments::{Arguments, Solver};
pub use run::run;

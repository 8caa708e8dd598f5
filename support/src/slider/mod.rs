//! The command line and the report of the slider.

mod arguments;
mod report;

pub use arguments::{Arguments, Body, Coupling, Frequency, Scheme, Solver, Update};
pub use report::{RECORDING, Setup, report};

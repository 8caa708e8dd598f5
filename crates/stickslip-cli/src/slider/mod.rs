//! The slider: command line and report.

mod arguments;
mod choices;
mod plan;
mod report;
mod run;

pub use arguments::Arguments;
pub use choices::{Body, Coupling, Frequency, Scheme, Solver, Update};
pub use report::{RECORDING, Setup, report};
pub use run::run;

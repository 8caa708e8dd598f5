//! The spring slider: command line and report.

mod arguments;
mod report;
mod run;

pub use arguments::{Arguments, Experiment, Preset};
pub use report::{Record, Sample};
pub use run::run;

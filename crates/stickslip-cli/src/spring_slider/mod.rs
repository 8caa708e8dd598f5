//! The spring slider: command line and report.

mod arguments;
mod record;
mod report;
mod run;

pub use arguments::{Arguments, Experiment, Preset};
pub use record::{Record, Sample};
pub use run::run;

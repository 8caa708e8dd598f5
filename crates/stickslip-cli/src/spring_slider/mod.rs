//! The command line and the report of the spring slider.

mod arguments;
mod report;
mod run;

pub use arguments::{Arguments, Experiment, Preset};
pub use report::{Record, Sample};
pub use run::run;

//! The command line and the report of the spring slider.

mod arguments;
mod report;

pub use arguments::{Arguments, Experiment, Preset};
pub use report::{Record, Sample};

//! What is kept of a run.

mod history;
mod statistics;
mod work_precision;

pub use history::{Events, History, Sample};
pub use statistics::{Statistics, Total};
pub use work_precision::{Measurement, WorkPrecision, observed_order, seconds_to};

//! Runs: constant or adaptive steps, stops, events; methods for a point.

mod controller;
mod crossing;
mod drive;
mod growth;
mod limit;
mod local_error;
mod motion_error;
mod pace;
mod resolution;
mod runge_kutta;
mod stepper;
mod steps;

pub use limit::{ErrorOf, Limit, LocalError, VertexError};
pub(crate) use local_error::Comparison;
pub use local_error::ErrorControl;
pub use runge_kutta::RungeKutta;
pub use stepper::{Run, Stepper, Verdict};
pub use steps::Steps;

/// Why a run ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Ended {
    /// At the time of its plan.
    Time,
    /// After as many steps as were planned.
    Count,
    /// By its observer.
    Observer,
    /// Where the value passed zero.
    Crossing,
}

/// How a run went.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RunReport {
    /// Why it ended.
    pub ended: Ended,
    /// Steps accepted.
    pub accepted: usize,
    /// Steps taken back because their error was too large.
    pub rejected: usize,
    /// Steps that failed and were tried again.
    pub failed: usize,
    /// Steps of constant size that failed and were bridged by smaller ones.
    pub bridged: usize,
    /// The smallest and the largest step accepted \[s\].
    pub step_range: [f64; 2],
}

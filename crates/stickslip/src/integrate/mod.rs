//! Runs and what they report: time steppers, step sizes and error control, states of a step, errors by node; what a
//! coupling of your own works with.

mod compare;
mod controller;
mod crossing;
mod distance;
mod drive;
mod error_control;
mod runge_kutta;
mod stepper;
mod steps;

pub use crate::clock::Clock;
pub use crate::error::{ErrorOf, Limit, LocalError, VertexError};
pub use crate::step::{CouplingReport, StepMaps};
pub use crate::step_state::{ContactState, ControlState, StepReport};
pub(crate) use compare::Comparison;
pub use error_control::ErrorControl;
pub use runge_kutta::RungeKutta;
pub use stepper::{IntoControlFlow, Run, Stepper};
pub use steps::Steps;

/// Why a run ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum StopReason {
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
#[non_exhaustive]
pub struct RunReport {
    /// Why it ended.
    pub ended: StopReason,
    /// Steps accepted.
    pub accepted: usize,
    /// Steps taken back because their error was too large.
    pub rejected: usize,
    /// Steps that failed and were tried again.
    pub failed: usize,
    /// Steps of constant size that failed and were split into substeps.
    pub bridged: usize,
    /// The substeps that took their place.
    pub substeps: usize,
    /// The smallest and the largest step accepted \[s\].
    pub step_range: [f64; 2],
}

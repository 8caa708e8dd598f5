//! Runs and their reports: time steppers, step sizes and error control, states of a step, errors per node; interfaces
//! for a coupling of the user's own.

mod by_reference;
mod compare;
mod controller;
mod crossing;
mod distance;
mod drive;
mod error_control;
mod landing;
mod progress;
mod run;
mod runge_kutta;
mod sampling;
mod stepper;
mod steps;

pub use crate::clock::Clock;
pub use crate::error::{ErrorOf, Limit, LocalError, VertexError};
pub use crate::step::{CouplingReport, StepMaps};
pub use crate::step_state::{ContactState, ControlState, StepReport};
pub(crate) use compare::Comparison;
pub use error_control::ErrorControl;
pub use run::{IntoControlFlow, Run};
pub use runge_kutta::RungeKutta;
pub use stepper::Stepper;
pub use steps::Steps;

/// The reason for the end of a run.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum StopReason {
    /// The time of the plan was reached.
    Time,
    /// The planned number of steps was reached.
    Count,
    /// The observer ended the run.
    Observer,
    /// The value passed zero.
    Crossing,
}

/// The statistics of a run.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct RunReport {
    /// The reason for its end.
    pub ended: StopReason,
    /// Accepted steps.
    pub accepted: usize,
    /// Steps rejected because their error exceeded the tolerance.
    pub rejected: usize,
    /// Failed steps that were repeated.
    pub failed: usize,
    /// Failed steps of constant size that were split into substeps.
    pub substepped: usize,
    /// The substeps of these.
    pub substeps: usize,
    /// The smallest and the largest step accepted \[s\].
    pub step_range: [f64; 2],
}

//! What can go wrong when a step is taken. Nothing here holds an error of what is built on steps.

mod local;
mod step;

pub use local::{ErrorOf, Limit, LocalError, VertexError};
pub use step::{StepError, StepFailure};

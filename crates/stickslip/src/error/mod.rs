//! Errors of a step. No error here contains one of the layers above.

mod local;
mod step;

pub use local::{ErrorOf, Limit, LocalError, VertexError};
pub use step::{StepError, StepFailure};

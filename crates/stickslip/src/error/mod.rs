//! Errors of a step. No error here contains one of the layers above.

mod failure;
mod hint;
mod local;
mod place;
mod step;

pub use failure::StepFailure;
pub use local::{ErrorOf, Limit, LocalError, VertexError};
pub use place::Place;
pub(crate) use step::BODY_STRESS;
pub use step::StepError;

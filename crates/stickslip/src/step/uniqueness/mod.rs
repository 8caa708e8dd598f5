//! Uniqueness of a step's solution between its old and its new slip rates.

mod certificate;
mod convexity;
mod definite;

pub(crate) use certificate::Certificate;
pub(super) use certificate::{certify, refusal};
pub use convexity::Convexity;
pub(crate) use convexity::convexity;
pub(super) use definite::Definite;

//! The marks that identify a scene in files.

mod fingerprint;
mod mark;

pub(crate) use fingerprint::{Fingerprint, mixed, shares};
pub(crate) use mark::{CheckpointMismatch, Mark, Value, compare};

//! What tests keep of a run.

mod events;
mod history;

pub(crate) use events::Events;
pub(crate) use history::{History, Sample};

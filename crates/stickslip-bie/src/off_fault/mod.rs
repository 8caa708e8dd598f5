//! Displacement and stress off faults.

mod blocks;
mod error;
mod faults;
mod line;
mod patches;
mod receivers;
mod sources;

pub use error::ReceiverError;
pub use faults::OffFault;
pub use receivers::Receivers;
pub use sources::Sources;

pub(crate) use blocks::Blocks;
pub(crate) use line::{Jump, Lines, Segment};
pub(crate) use patches::Patches;
pub(crate) use sources::Cells;

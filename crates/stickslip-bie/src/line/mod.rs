//! Dipping faults below a free surface, lines in plane strain.

mod dislocation;
mod fault;
mod images;
mod kernel;
mod low_rank;
mod normal;

pub use fault::{DippingFault, Sense};
pub use kernel::DippingKernel;
pub use normal::DippingNormalKernel;

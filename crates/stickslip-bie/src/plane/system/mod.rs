//! Several planes in one half space.

mod algebra;
mod assembly;
mod between;
mod blocks;
mod contacts;
mod coupling;
mod fault_system;
mod kernel;
mod loading;
mod normal;
mod placement;
mod separation;
mod surface;

pub use contacts::SystemSection;
pub use fault_system::FaultSystem;
pub use kernel::SystemKernel;
pub use normal::SystemNormalKernel;
pub(crate) use placement::Axes;
pub use placement::Placement;

//! Planar faults of rectangular cells, with one or two components of slip.

mod angles;
mod assembly;
mod convolution;
mod dislocation;
mod fault;
mod kernel;
mod layer_entries;
mod layer_product;
mod layers;
mod loading;
mod matrix;
mod mirrored;
mod mode_matrices;
mod modes;
mod normal;
mod okada;
pub(crate) mod parts;
mod patches;
mod periodic;
mod ranks;
mod rectangles;
mod split;
mod stiffness;
mod system;
mod terms;
mod transform;
mod whole_space;

pub(crate) use angles::cos_sin;
pub use dislocation::RectangularDislocation;
pub(crate) use dislocation::require_poisson_ratio;
pub use fault::PlaneFault;
pub use kernel::PlaneKernel;
pub use normal::PlaneNormalKernel;
pub use rectangles::Rectangles;
pub use system::{FaultSystem, Placement, SystemKernel, SystemNormalKernel, SystemSection};
pub(crate) use terms::Terms;

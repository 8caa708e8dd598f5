//! Faults that are surfaces of triangles.

mod averaging;
mod consistency;
mod dense;
mod dislocation;
pub(crate) mod displacement;
mod edges;
mod elements;
mod error;
mod fault;
mod harmonic;
mod kernel;
mod loading;
mod mesh;
mod normal;
mod rock;
mod section;
mod stiffness;

pub(crate) use edges::Loop;
pub(crate) use rock::Rock;

pub use dislocation::TriangularDislocation;
pub use error::SurfaceError;
pub use fault::SurfaceFault;
pub use kernel::SurfaceKernel;
pub use loading::ResolvedStress;
pub use mesh::{CellAxes, SurfaceQuality, Triangles};
pub use normal::SurfaceNormalKernel;
pub use section::SurfaceSection;

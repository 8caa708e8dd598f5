//! Faults that are surfaces of triangles.

mod averaging;
mod consistency;
mod dense;
mod dislocation;
#[cfg_attr(not(test), allow(dead_code, reason = "receivers off the fault"))]
mod displacement;
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

pub use dislocation::TriangularDislocation;
pub use error::SurfaceError;
pub use fault::SurfaceFault;
pub use kernel::SurfaceKernel;
pub use loading::ResolvedStress;
pub use mesh::{CellAxes, SurfaceQuality, Triangles};
pub use normal::SurfaceNormalKernel;
pub use section::SurfaceSection;

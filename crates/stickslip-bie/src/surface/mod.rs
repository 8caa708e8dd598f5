//! Faults that are surfaces of triangles.

mod averaging;
mod consistency;
mod dislocation;
pub(crate) mod displacement;
mod edges;
mod elements;
mod error;
mod fault;
mod harmonic;
mod loading;
mod mesh;
mod pairs;
mod rock;
mod section;
mod stiffness;

pub(crate) use averaging::Averaging;
pub(crate) use edges::Loop;
pub(crate) use rock::Rock;

pub use dislocation::TriangularDislocation;
pub use error::SurfaceError;
pub use fault::SurfaceFault;
pub use loading::ResolvedStress;
pub use mesh::{CellAxes, SurfaceQuality, Triangles};
pub(crate) use pairs::SurfacePairs;
pub use section::SurfaceSection;

//! Faults that are surfaces of triangles.

mod dislocation;
#[cfg_attr(not(test), allow(dead_code, reason = "receivers off the fault"))]
mod displacement;
mod edges;
mod error;
#[cfg_attr(not(test), allow(dead_code, reason = "the half space of triangles"))]
mod harmonic;
mod mesh;

pub use dislocation::TriangularDislocation;
pub use error::SurfaceError;
pub use mesh::{CellAxes, SurfaceQuality, Triangles};

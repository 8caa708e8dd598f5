//! Faults that are surfaces of triangles.

mod dislocation;
mod edges;
mod error;
#[cfg_attr(not(test), allow(dead_code, reason = "the half space of triangles"))]
mod harmonic;
mod mesh;

pub use dislocation::TriangularDislocation;
pub use error::SurfaceError;
pub use mesh::{CellAxes, SurfaceQuality, Triangles};

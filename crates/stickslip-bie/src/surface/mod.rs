//! Faults that are surfaces of triangles.

mod dislocation;
mod edges;
mod error;
mod mesh;

pub use dislocation::TriangularDislocation;
pub use error::SurfaceError;
pub use mesh::{CellAxes, SurfaceQuality, Triangles};

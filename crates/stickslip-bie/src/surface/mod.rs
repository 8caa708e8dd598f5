//! Faults that are surfaces of triangles.

mod dislocation;
mod edges;

pub use dislocation::TriangularDislocation;

//! Surfaces of triangles.

mod adjacency;
mod axes;
mod depth;
mod orientation;
mod quality;
mod separation;
mod stl;
mod triangles;
mod vertices;

pub use axes::CellAxes;
pub use quality::SurfaceQuality;
pub use triangles::Triangles;

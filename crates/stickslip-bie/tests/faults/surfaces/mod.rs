//! Surfaces of triangles.

mod convergence;
mod dislocation;
mod fault;
mod half_space;
mod mesh;
pub(crate) mod meshes;
mod stl;

use nalgebra::Vector3;

/// Slip along strike, up dip, and opening: the axes of a triangle.
pub(crate) fn axes(corners: [[f64; 3]; 3]) -> [Vector3<f64>; 3] {
    let [a, b, c] = corners.map(Vector3::from);
    let normal = (b - a).cross(&(c - a)).normalize();
    let strike = Vector3::z().cross(&normal).normalize();
    [strike, normal.cross(&strike), normal]
}

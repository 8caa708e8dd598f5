//! A set of vertices with their share of a surface.

/// Vertices and the area that each of them stands for.
///
/// Made from a `Trace` of the finite element crate, or with [`Patch::point`] for a spring slider.
#[derive(Debug, Clone, PartialEq)]
pub struct Patch {
    /// Vertex indices, increasing.
    pub vertices: Vec<usize>,
    /// The integral of each vertex's hat function [m^2; m in 2D], one a vertex.
    pub weights: Vec<f64>,
}

impl Patch {
    /// Vertex 0 with the area `area` [m^2].
    pub fn point(area: f64) -> Self {
        Self {
            vertices: vec![0],
            weights: vec![area],
        }
    }
}

#[cfg(feature = "fem")]
impl<const D: usize> From<&stickslip_fem::Trace<D>> for Patch {
    fn from(trace: &stickslip_fem::Trace<D>) -> Self {
        Self {
            vertices: trace.vertices().to_vec(),
            weights: trace.weights().to_vec(),
        }
    }
}

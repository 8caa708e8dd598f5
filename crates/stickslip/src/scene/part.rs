//! A part of a boundary: vertices with their share of a surface.

use crate::SceneError;
use crate::contact::check::require;

/// Vertices of a boundary part, with what a scene needs to know of them.
///
/// Made from a `Trace` of the finite element crate, or with [`Part::point`] for a spring slider. Points and
/// normals have three coordinates, of which a plane body uses two.
#[derive(Debug, Clone, PartialEq)]
pub struct Part {
    /// Vertex indices, increasing.
    pub vertices: Vec<usize>,
    /// The integral of each vertex's hat function [m^2; m in 2D], one a vertex.
    pub weights: Vec<f64>,
    /// Where each vertex lies \[m\]; empty where nobody knows.
    pub points: Vec<[f64; 3]>,
    /// The outward unit normal at each vertex, zero where there is none; empty where nobody knows, as at a
    /// point.
    pub normals: Vec<[f64; 3]>,
    /// Coordinates in use: 2 in the plane, 3 in space, 0 for a point.
    pub dimension: usize,
    /// The mesh whose boundary it is a part of, by its fingerprint; `None` where nobody knows, as at a point.
    /// Parts of one scene are of one mesh.
    pub mesh: Option<u64>,
}

impl Part {
    /// Vertex 0 with the area `area` [m^2], which slides in every component.
    pub fn point(area: f64) -> Self {
        Self {
            vertices: vec![0],
            weights: vec![area],
            points: Vec::new(),
            normals: Vec::new(),
            dimension: 0,
            mesh: None,
        }
    }

    /// Checks a part that plays the role `what` in a body of `size` vertices.
    pub(crate) fn check(&self, what: &'static str, size: usize) -> Result<(), SceneError> {
        if self.vertices.is_empty() {
            return Err(SceneError::EmptyBoundary { what });
        }
        let expected = self.vertices.len();
        for (found, optional) in [
            (self.weights.len(), false),
            (self.points.len(), true),
            (self.normals.len(), true),
        ] {
            if found != expected && !(optional && found == 0) {
                return Err(SceneError::Length {
                    what,
                    expected,
                    found,
                });
            }
        }
        for (position, (&vertex, &weight)) in self.vertices.iter().zip(&self.weights).enumerate() {
            let increasing = position == 0 || self.vertices[position - 1] < vertex;
            let requirement = "a vertex of the mesh, above its predecessor";
            let legal = vertex < size && increasing;
            require(what, requirement, position, vertex as f64, legal)?;
            let requirement = "given weights that are finite and not negative";
            let legal = weight >= 0.0 && weight.is_finite();
            require(what, requirement, position, weight, legal)?;
        }
        for (position, normal) in self.normals.iter().enumerate() {
            let length = normal.iter().map(|n| n * n).sum::<f64>().sqrt();
            let legal = length == 0.0 || (length - 1.0).abs() <= 1e-9;
            let requirement = "given normals of unit length";
            require(what, requirement, position, length, legal)?;
        }
        Ok(())
    }
}

#[cfg(feature = "fem")]
impl<const D: usize> From<&stickslip_fem::Trace<D>> for Part {
    fn from(trace: &stickslip_fem::Trace<D>) -> Self {
        let padded = |x: &nalgebra::SVector<f64, D>| {
            std::array::from_fn(|c| x.get(c).copied().unwrap_or(0.0))
        };
        Self {
            vertices: trace.vertices().to_vec(),
            weights: trace.weights().to_vec(),
            points: trace.points().iter().map(padded).collect(),
            normals: trace.normals().iter().map(padded).collect(),
            dimension: D,
            mesh: Some(trace.mesh()),
        }
    }
}

impl From<&Part> for Part {
    fn from(part: &Part) -> Self {
        part.clone()
    }
}

//! A part of a boundary: vertices with their shares of a surface.

use nalgebra::{SMatrix, Vector3};
use stickslip_solvers::MeshId;

use crate::SceneError;
use crate::checks::require;

/// The vertices of a boundary part, with their geometry.
///
/// It is made from a `Trace` of the finite element crate, from the cells of a planar fault by boundary integrals, or
/// with [`BoundaryPart::point`] for a spring slider. Points and normals have three coordinates; a plane body uses two.
#[derive(Debug, Clone, PartialEq)]
pub struct BoundaryPart {
    /// Vertex indices, increasing.
    pub vertices: Vec<usize>,
    /// The integral of each vertex's hat function [m^2; m in 2D].
    pub weights: Vec<f64>,
    /// The position of each vertex \[m\]; empty if unknown.
    pub points: Vec<[f64; 3]>,
    /// The outward unit normal at each vertex, zero where it does not exist; empty if unknown, as at a point.
    pub normals: Vec<[f64; 3]>,
    /// The axes of the fixed or driven components at each vertex, orthonormal; empty for coordinate axes.
    pub axes: Vec<[[f64; 3]; 3]>,
    /// The opposite side of the fault along which the mesh was split; `None` for other parts.
    pub opposite: Option<OppositeSide>,
    /// The number of coordinates: 1 along a line fault by boundary integrals, 2 in the plane or on a planar fault, 3 in
    /// space or on several planar faults, 0 for a point.
    pub dimension: usize,
    /// The mesh; `None` if unknown, as at a point. The parts of a scene belong to one mesh.
    pub mesh: Option<MeshId>,
}

/// The other side of a cut through the mesh, in the order of the vertices of a part that is one of its sides.
#[derive(Debug, Clone, PartialEq)]
pub struct OppositeSide {
    /// The opposite vertex, at a tip the vertex itself.
    pub vertices: Vec<usize>,
    /// Whether a face connects the vertex to a tip. The normal stress there has no limit as cells shrink: it can be a
    /// tension on any mesh.
    pub beside_tip: Vec<bool>,
}

impl BoundaryPart {
    /// Vertex 0 with the area `area` [m^2]; all its components are tangential.
    pub fn point(area: f64) -> Self {
        Self {
            vertices: vec![0],
            weights: vec![area],
            points: Vec::new(),
            normals: Vec::new(),
            axes: Vec::new(),
            opposite: None,
            dimension: 0,
            mesh: None,
        }
    }

    /// Replaces the unit normals by a function of the position \[m\], such as those of the smooth surface that the mesh
    /// approximates. They are normalised.
    ///
    /// The normals of a `Trace` are the means over the faces at a vertex, weighted by area. A vertex has no normal
    /// where a face deviates from the mean by more than 30 degrees, at an edge or a corner.
    #[must_use]
    pub fn with_normals(mut self, normal: impl Fn(&[f64; 3]) -> [f64; 3]) -> Self {
        self.normals = (self.points.iter())
            .map(|x| {
                let normal = normal(x);
                let length = normal.iter().map(|n| n * n).sum::<f64>().sqrt();
                normal.map(|n| n / length)
            })
            .collect();
        self
    }

    /// Sets the axes of Dirichlet conditions by a function of the position \[m\]: component `c` of a velocity is along
    /// the axis number `c`. They are orthonormal; in the plane the third is `[0, 0, 1]`.
    #[must_use]
    pub fn with_axes(mut self, axes: impl Fn(&[f64; 3]) -> [[f64; 3]; 3]) -> Self {
        self.axes = self.points.iter().map(axes).collect();
        self
    }

    /// Sets the normal as the first axis and tangential directions as the others: `fix(part.along_normals(),
    /// Components::X)` is a roller condition on a surface of any shape. In the plane the second axis is the normal
    /// rotated to the left by a right angle. In space the others are orthogonal to the normal, and the second of them
    /// also to the coordinate with the smallest component of the normal.
    #[must_use]
    pub fn along_normals(mut self) -> Self {
        let plane = self.dimension == 2;
        self.axes = (self.normals.iter())
            .map(|&n| {
                if plane {
                    return [n, [-n[1], n[0], 0.0], [0.0, 0.0, 1.0]];
                }
                let normal = Vector3::from(n);
                let least = normal.iamin();
                let unit = Vector3::from_fn(|c, _| f64::from(u8::from(c == least)));
                let second = normal.cross(&unit).normalize();
                [n, second.into(), normal.cross(&second).into()]
            })
            .collect();
        self
    }

    /// The vertices at some positions.
    pub(crate) fn select(&self, positions: &[usize]) -> Self {
        Self {
            vertices: pick(&self.vertices, positions),
            weights: pick(&self.weights, positions),
            points: pick(&self.points, positions),
            normals: pick(&self.normals, positions),
            axes: pick(&self.axes, positions),
            opposite: self.opposite.as_ref().map(|side| OppositeSide {
                vertices: pick(&side.vertices, positions),
                beside_tip: pick(&side.beside_tip, positions),
            }),
            dimension: self.dimension,
            mesh: self.mesh,
        }
    }

    /// The axes of the vertex at a position as columns.
    pub(crate) fn axes_at<const C: usize>(&self, position: usize) -> SMatrix<f64, C, C> {
        match self.axes.get(position) {
            None => SMatrix::identity(),
            Some(axes) => SMatrix::from_fn(|row, column| axes[column][row]),
        }
    }

    /// Checks a part with the boundary condition `what` in a body of `size` vertices.
    pub(crate) fn check(
        &self,
        what: &'static str,
        size: usize,
        may_be_empty: bool,
    ) -> Result<(), SceneError> {
        if self.vertices.is_empty() && !may_be_empty {
            return Err(SceneError::EmptyBoundary { what });
        }
        let expected = self.vertices.len();
        for (found, optional) in [
            (self.weights.len(), false),
            (self.points.len(), true),
            (self.normals.len(), true),
            (self.axes.len(), true),
            (
                self.opposite.as_ref().map_or(0, |side| side.vertices.len()),
                true,
            ),
            (
                self.opposite
                    .as_ref()
                    .map_or(0, |side| side.beside_tip.len()),
                true,
            ),
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
        for (position, axes) in self.axes.iter().enumerate() {
            for (i, a) in axes.iter().enumerate() {
                for (j, b) in axes.iter().enumerate() {
                    let product: f64 = a.iter().zip(b).map(|(a, b)| a * b).sum();
                    let expected = f64::from(u8::from(i == j));
                    let legal = (product - expected).abs() <= 1e-9;
                    let requirement = "given axes that are orthogonal and of length 1";
                    require(what, requirement, position, product, legal)?;
                }
            }
        }
        Ok(())
    }
}

/// The values at some positions, as far as there are values.
fn pick<T: Copy>(values: &[T], positions: &[usize]) -> Vec<T> {
    let present = positions.iter().filter_map(|&k| values.get(k));
    present.copied().collect()
}

#[cfg(feature = "fem")]
impl<const D: usize> From<&stickslip_fem::Trace<D>> for BoundaryPart {
    fn from(trace: &stickslip_fem::Trace<D>) -> Self {
        let normals = smooth_normals(trace);
        let padded = |x: &nalgebra::SVector<f64, D>| {
            std::array::from_fn(|c| x.get(c).copied().unwrap_or(0.0))
        };
        Self {
            vertices: trace.vertices().to_vec(),
            weights: trace.weights().to_vec(),
            points: trace.points().iter().map(padded).collect(),
            normals: normals.iter().map(padded).collect(),
            axes: Vec::new(),
            opposite: opposite(trace),
            dimension: D,
            mesh: Some(trace.mesh().into()),
        }
    }
}

impl From<&BoundaryPart> for BoundaryPart {
    fn from(part: &BoundaryPart) -> Self {
        part.clone()
    }
}

/// The other side of a trace that is one side of a cut.
#[cfg(feature = "fem")]
fn opposite<const D: usize>(trace: &stickslip_fem::Trace<D>) -> Option<OppositeSide> {
    let vertices = trace.opposite()?.to_vec();
    let is_tip = |k: &usize| vertices[*k] == trace.vertices()[*k];
    let mut beside_tip = vec![false; vertices.len()];
    for face in trace.faces().iter().filter(|face| face.iter().any(is_tip)) {
        face.iter().for_each(|&k| beside_tip[k] = true);
    }
    Some(OppositeSide {
        vertices,
        beside_tip,
    })
}

/// The normals of a trace, zero where a face deviates from the mean of its vertex by more than 30 degrees.
#[cfg(feature = "fem")]
fn smooth_normals<const D: usize>(
    trace: &stickslip_fem::Trace<D>,
) -> Vec<nalgebra::SVector<f64, D>> {
    let mut normals = trace.normals().to_vec();
    let face_normals = trace.face_normals();
    for (face, normal) in trace.faces().iter().zip(&face_normals) {
        for &k in face {
            if trace.normals()[k].dot(normal) < crate::numerics::NUMERICS.smooth {
                normals[k] = nalgebra::SVector::zeros();
            }
        }
    }
    normals
}

use nalgebra::SVector;

use stickslip_core::compiled;

use crate::cut::Side;
use crate::identity::MeshIdentity;
use crate::simplex::{face_area, face_normal};
use crate::{FemError, Mesh};

/// A part of the boundary: its faces, and its vertices with the weights of the lumped integral.
///
/// With phi_p the hat function of vertex p and Gamma the union of the faces,
///
/// ```text
/// w_p = integral of phi_p over Gamma,    integral of f over Gamma ~ sum over p of w_p f(x_p)
/// ```
///
/// ```
/// use stickslip_fem::P1;
///
/// let space = P1::grid([5.0, 1.0], [5, 1])?;
/// let bottom = space.trace(|x| x[1] == 0.0)?;
/// assert_eq!(bottom.weights(), [0.5, 1.0, 1.0, 1.0, 1.0, 0.5]);
/// assert!(bottom.normals().iter().all(|n| n.as_slice() == [0.0, -1.0]));
/// # Ok::<(), stickslip_fem::FemError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Trace<const D: usize> {
    mesh: MeshIdentity,
    vertices: Vec<usize>,
    points: Vec<SVector<f64, D>>,
    normals: Vec<SVector<f64, D>>,
    weights: Vec<f64>,
    faces: Vec<[usize; D]>,
    areas: Vec<f64>,
    opposite: Option<Vec<usize>>,
}

/// The relative length of a mean normal, over that of its parts, below which it is no normal.
const NORMAL: f64 = 1e-9;

impl<const D: usize> Trace<D> {
    /// The part of all faces whose vertices satisfy a predicate.
    pub(crate) fn new(
        mesh: &Mesh<D>,
        on: &dyn Fn(&SVector<f64, D>) -> bool,
    ) -> Result<Self, FemError> {
        where_vertices_are(mesh, on)
    }

    /// The part of some faces of the boundary, by increasing position.
    pub(crate) fn of_faces(mesh: &Mesh<D>, places: &[usize]) -> Result<Self, FemError> {
        of_faces(mesh, places)
    }

    /// The vertices in increasing order, as indices into the mesh.
    pub fn vertices(&self) -> &[usize] {
        &self.vertices
    }

    /// The positions of the vertices \[m\], in the order of [`Trace::vertices`].
    pub fn points(&self) -> &[SVector<f64, D>] {
        &self.points
    }

    /// The outward unit normal at each vertex, the mean over its faces weighted by their areas; zero where they
    /// cancel. In the order of [`Trace::vertices`].
    ///
    /// On one side of a [split](Mesh::split) fault the weights are 1/length (D = 2) or sin(angle)/(l_1 l_2) with the
    /// edges of the face at the vertex (D = 3): exact on a circle or sphere, where slip must not change the normal
    /// stress. Both sides have exactly opposite normals. At a rim where other surfaces continue it they are those of all
    /// faces there, unless one of these deviates from the mean by more than 30 degrees.
    pub fn normals(&self) -> &[SVector<f64, D>] {
        &self.normals
    }

    /// The vertex on the other side of a [split](Mesh::split) fault for each vertex, as an index into the mesh; a tip is
    /// its own. In the order of [`Trace::vertices`]. `None` unless the faces are exactly those of one side.
    ///
    /// Both sides have the same points and weights, bit for bit, and opposite normals.
    #[doc(alias("pairs", "split nodes", "twin"))]
    pub fn opposite(&self) -> Option<&[usize]> {
        self.opposite.as_deref()
    }

    /// A value per vertex by a function of its position \[m\], in the order of [`Trace::vertices`].
    pub fn map<T>(&self, function: impl Fn(&SVector<f64, D>) -> T) -> Vec<T> {
        self.points.iter().map(function).collect()
    }

    /// The integral of each vertex' hat function [m^(D-1)], in the order of [`Trace::vertices`].
    pub fn weights(&self) -> &[f64] {
        &self.weights
    }

    /// The faces, each D positions in [`Trace::vertices`], ordered as in [`Mesh::boundary`].
    pub fn faces(&self) -> &[[usize; D]] {
        &self.faces
    }

    /// Length (D = 2) or area (D = 3) of each face [m^(D-1)].
    pub fn areas(&self) -> &[f64] {
        &self.areas
    }

    /// The outward unit normal of each face.
    pub fn face_normals(&self) -> Vec<SVector<f64, D>> {
        let normals = self.faces.iter().zip(&self.areas);
        normals
            .map(|(face, area)| face_normal(&face.map(|k| self.points[k])) / *area)
            .collect()
    }

    /// Length or area of the whole [m^(D-1)], the sum of the weights.
    pub fn measure(&self) -> f64 {
        self.areas.iter().sum()
    }

    /// The [identity](Mesh::identity) of its mesh.
    pub fn mesh(&self) -> MeshIdentity {
        self.mesh
    }
}

compiled! {
    fn where_vertices_are<D in 2, 3>(
        mesh: &Mesh<D>,
        on: &dyn Fn(&SVector<f64, D>) -> bool,
    ) -> Result<Trace<D>, FemError> {
        let on: Vec<bool> = mesh.vertices().iter().map(on).collect();
        let inside = |place: &usize| mesh.boundary[*place].iter().all(|&p| on[p as usize]);
        let chosen: Vec<usize> = (0..mesh.boundary.len()).filter(inside).collect();
        of_faces(mesh, &chosen)
    }

    fn of_faces<D in 2, 3>(mesh: &Mesh<D>, places: &[usize]) -> Result<Trace<D>, FemError> {
        if places.is_empty() {
            return Err(FemError::empty(
                "faces of the boundary that satisfy the predicate",
            ));
        }
        let chosen = places.iter().map(|&place| &mesh.boundary[place]);
        let mut vertices: Vec<usize> = (chosen.clone())
            .flat_map(|face| face.map(|p| p as usize))
            .collect();
        vertices.sort_unstable();
        vertices.dedup();
        let points: Vec<_> = vertices.iter().map(|&p| mesh.vertices()[p]).collect();
        let place = |p: u32| vertices.partition_point(|&q| q < p as usize);
        let faces: Vec<[usize; D]> = chosen.map(|face| face.map(place)).collect();
        let side = Side::of(mesh, places, &vertices);
        let (areas, weights, normals, lengths, opposite) = match side {
            Some(side) => {
                let opposite = Some(side.opposite);
                (
                    side.areas,
                    side.weights,
                    side.normals,
                    side.lengths,
                    opposite,
                )
            }
            None => {
                let areas: Vec<f64> = faces
                    .iter()
                    .map(|face| face_area(&face.map(|k| points[k])))
                    .collect();
                let mut weights = vec![0.0; vertices.len()];
                let mut normals = vec![SVector::zeros(); vertices.len()];
                for (face, area) in faces.iter().zip(&areas) {
                    let normal = face_normal(&face.map(|k| points[k]));
                    for &k in face {
                        weights[k] += area / D as f64;
                        normals[k] += normal;
                    }
                }
                (areas, weights.clone(), normals, weights, None)
            }
        };
        let normals = (normals.iter().zip(&lengths))
            .map(|(normal, parts)| {
                // What cancels on both sides of a sheet is rounding.
                let length = normal.norm();
                let length = if length > NORMAL * parts {
                    length
                } else {
                    f64::INFINITY
                };
                normal / length
            })
            .collect();
        Ok(Trace {
            mesh: mesh.identity(),
            vertices,
            points,
            normals,
            weights,
            faces,
            areas,
            opposite,
        })
    }
}

use nalgebra::SVector;

use crate::numbering::bounding_box;
use crate::points::Points;
use crate::simplex::{face_area, face_normal};
use crate::{FemError, Mesh};

/// Duplicate and hanging nodes of a nonconforming mesh: the result of [`Mesh::nonconforming_nodes`].
#[derive(Clone, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub struct NonconformingNodes<const D: usize> {
    /// Duplicate nodes, vertices at one position that are not merged: the first of those there, and each other one.
    pub vertices: Vec<[u32; 2]>,
    /// Hanging nodes: vertices on a face of the boundary, away from its corners.
    pub hanging: Vec<Hanging<D>>,
    /// Duplicate faces of the boundary at one position: the first of those there, and each other one.
    pub faces: Vec<[[u32; D]; 2]>,
}

/// A hanging node: a vertex on a face of the boundary, away from its corners.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Hanging<const D: usize> {
    /// The vertex.
    pub vertex: u32,
    /// The vertices of the face, ordered as in [`Mesh::boundary`].
    pub face: [u32; D],
}

impl<const D: usize> NonconformingNodes<D> {
    /// Whether the mesh is conforming.
    pub fn is_empty(&self) -> bool {
        self.vertices.is_empty() && self.hanging.is_empty() && self.faces.is_empty()
    }
}

impl<const D: usize> Mesh<D> {
    /// Duplicate and hanging nodes: places where parts of the boundary touch, and cells that look like neighbours are
    /// not connected. `near` \[m\] is the distance up to which points count as one. It is less than the shortest edge,
    /// and more than the rounding errors of the coordinates.
    ///
    /// A mesh may be cut open on purpose, along a fault or between bodies; more often a mesh generator did not merge
    /// its nodes, or refined one side of an interface. A node on the common edge of two faces hangs on both. The time
    /// is O(n log n) in the n vertices of the boundary, as long as boxes around faces contain few vertices.
    ///
    /// # Errors
    ///
    /// [`FemError::Value`] unless `near` is finite and not negative.
    ///
    /// ```
    /// use nalgebra::Vector2;
    /// use stickslip_fem::{Hanging, Mesh};
    ///
    /// // A triangle, and two on the other side of its edge from 1 to 2, which vertex 3 halves.
    /// let points = [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0), (0.5, 0.5), (1.0, 1.0)];
    /// let points = points.map(|(x, y)| Vector2::new(x, y)).to_vec();
    /// let mesh = Mesh::new(points, vec![0, 1, 2, 1, 4, 3, 3, 4, 2])?;
    /// let cracks = mesh.nonconforming_nodes(1e-10)?;
    /// assert_eq!(cracks.hanging, [Hanging { vertex: 3, face: [1, 2] }]);
    /// assert!(cracks.vertices.is_empty() && cracks.faces.is_empty());
    /// # Ok::<(), stickslip_fem::FemError>(())
    /// ```
    #[doc(alias("hanging nodes", "duplicate nodes"))]
    pub fn nonconforming_nodes(&self, near: f64) -> Result<NonconformingNodes<D>, FemError> {
        FemError::non_negative("distance [m]", near)?;
        let mut vertices: Vec<u32> = self.boundary.iter().flatten().copied().collect();
        vertices.sort_unstable();
        vertices.dedup();
        let at = |p: u32| self.vertices[p as usize];
        let points = Points::new(vertices.iter().map(|&p| (at(p), p)).collect());
        let around = SVector::repeat(near);

        let mut cracks = NonconformingNodes::default();
        let mut first: Vec<u32> = (0..self.vertices.len() as u32).collect();
        for &p in &vertices {
            let x = at(p);
            let mut lowest = p;
            points.inside(&(x - around), &(x + around), &mut |y, q| {
                if q < lowest && (y - x).norm() <= near {
                    lowest = q;
                }
            });
            if lowest < p {
                first[p as usize] = first[lowest as usize];
                cracks.vertices.push([first[p as usize], p]);
            }
        }
        let first = |p: u32| first[p as usize];
        for &face in &self.boundary {
            let corners = face.map(at);
            let (low, high) = bounding_box(&corners);
            let begin = cracks.hanging.len();
            points.inside(&(low - around), &(high + around), &mut |x, vertex| {
                let corner = face.iter().any(|&p| first(p) == first(vertex));
                if !corner && lies_on(x, &corners, near) {
                    cracks.hanging.push(Hanging { vertex, face });
                }
            });
            cracks.hanging[begin..].sort_unstable_by_key(|hanging| hanging.vertex);
        }
        let mut places: Vec<([u32; D], usize)> = (self.boundary.iter().enumerate())
            .map(|(k, face)| {
                let mut place = face.map(first);
                place.sort_unstable();
                (place, k)
            })
            .collect();
        places.sort_unstable();
        for same in places.chunk_by(|a, b| a.0 == b.0) {
            let face = |k: usize| self.boundary[same[k].1];
            let others = (1..same.len()).map(|k| [face(0), face(k)]);
            cracks.faces.extend(others);
        }
        Ok(cracks)
    }
}

/// Whether a point is at most `near` off a face, and at most `near` outside its sides.
fn lies_on<const D: usize>(x: &SVector<f64, D>, corners: &[SVector<f64, D>; D], near: f64) -> bool {
    let normal = face_normal(corners);
    let area = face_area(corners);
    // Divided twice: the square of a small area may vanish.
    let unit = normal / area;
    if (x - corners[0]).dot(&unit).abs() > near {
        return false;
    }
    (0..D).all(|k| {
        // The share of the face that lies beyond x as seen from corner k; 1 at the corner, 0 on its opposite side.
        let mut part = *corners;
        part[k] = *x;
        let share = face_normal(&part).dot(&unit) / area;
        let side = if D == 2 {
            1.0
        } else {
            (corners[(k + 1) % D] - corners[(k + 2) % D]).norm()
        };
        let height = (D - 1) as f64 * area / side;
        share * height >= -near
    })
}

//! Curved boundaries: new vertices of a part of the boundary are moved onto a curve or surface.

use nalgebra::SVector;

use crate::refine::refine;
use crate::simplex::Simplex;
use crate::weights::Weights;
use crate::{FemError, Hierarchy, Mesh, P1};

/// A named part of the boundary, and the map of a midpoint on it to its new position.
pub(crate) type Onto<'a, const D: usize> =
    (&'a str, &'a dyn Fn(&SVector<f64, D>) -> SVector<f64, D>);

/// A curved part of the boundary of one level.
pub(crate) struct Curve<'a, const D: usize> {
    level: usize,
    /// The faces of the part and, in space, their edges: increasing vertices, padded with `u32::MAX`.
    faces: Vec<[u32; D]>,
    onto: &'a dyn Fn(&SVector<f64, D>) -> SVector<f64, D>,
}

impl<'a, const D: usize> Curve<'a, D> {
    pub(crate) fn new(
        mesh: &Mesh<D>,
        level: usize,
        (part, onto): Onto<'a, D>,
    ) -> Result<Self, FemError> {
        let (mut faces, mut twins) = (Vec::new(), Vec::new());
        let mut places = mesh.faces_of(part)?.to_vec();
        // Both sides of a fault are moved alike.
        for twin in mesh.surfaces.cuts.iter().flat_map(|cut| &cut.twins) {
            let named = |place: &usize| places.binary_search(place).is_ok();
            match twin.iter().position(named) {
                Some(own) if !named(&twin[1 - own]) => twins.push(twin[1 - own]),
                _ => {}
            }
        }
        places.append(&mut twins);
        for place in places {
            let mut face = mesh.boundary[place];
            face.sort_unstable();
            faces.push(face);
            if D == 3 {
                faces.extend((0..D).map(|left_out| {
                    let mut edge = face;
                    edge[left_out..].rotate_left(1);
                    edge[D - 1] = u32::MAX;
                    edge
                }));
            }
        }
        faces.sort_unstable();
        faces.dedup();
        Ok(Self { level, faces, onto })
    }

    /// Whether an edge lies on the part. Vertices may have been added to the level.
    pub(crate) fn holds(&self, weights: &Weights, p: u32, q: u32) -> bool {
        (weights.between::<D>(&[p, q])).is_some_and(|face| self.faces.binary_search(&face).is_ok())
    }

    /// The new position of the midpoint of an edge on the part.
    pub(crate) fn middle(&self, ends: [&SVector<f64, D>; 2]) -> Result<SVector<f64, D>, FemError> {
        let x = 0.5 * (ends[0] + ends[1]);
        let moved = (self.onto)(&x);
        let (by, edge) = ((moved - x).norm(), (ends[1] - ends[0]).norm());
        if by <= 0.5 * edge {
            return Ok(moved);
        }
        Err(FemError::MovedAway {
            level: self.level,
            at: x.iter().copied().collect(),
            edge,
            by,
        })
    }

    /// Refuses a child that moved vertices have inverted or flattened.
    pub(crate) fn check(
        &self,
        vertices: &[SVector<f64, D>],
        part: &[u32],
        cell: usize,
    ) -> Result<(), FemError> {
        let simplex = Simplex::new(vertices, part);
        if simplex.is_solid() {
            return Ok(());
        }
        Err(FemError::DegenerateCell {
            level: Some(self.level),
            cell,
            volume: simplex.volume,
        })
    }
}

impl<const D: usize> Hierarchy<D> {
    /// Adds uniform refinements of the finest mesh, for a body with a curved boundary. Every new vertex on the named
    /// part, the midpoint of an edge, is moved by `onto`, for instance to its nearest point on the curve or surface.
    ///
    /// Vertices inside the body stay midpoints, and fields are interpolated as if all did. If parts of the boundary
    /// have different curves, name their union, and let `onto` decide by the position.
    ///
    /// # Errors
    ///
    /// As [`Hierarchy::refined`]; [`FemError::Unknown`]; [`FemError::MovedAway`] if a point is not finite or farther
    /// off than half of the edge; [`FemError::DegenerateCell`] if a cell is inverted or flat, because the coarse mesh
    /// is too coarse for the curve, or flat at it.
    pub fn refined_onto(
        mut self,
        levels: usize,
        part: &str,
        onto: impl Fn(&SVector<f64, D>) -> SVector<f64, D>,
    ) -> Result<Self, FemError> {
        self.expect_refinable(levels)?;
        for _ in 0..levels {
            let curve = Curve::new(self.finest(), self.level_count() - 1, (part, &onto))?;
            let finer = refine(self.finest(), Some(&curve))?;
            self.push(finer);
        }
        Ok(self)
    }
}

impl<const D: usize> P1<D> {
    /// This space, refined uniformly so many times, with the new vertices on a named part of the boundary moved onto a
    /// curve or surface. Errors as [`Hierarchy::refined_onto`].
    ///
    /// ```
    /// use nalgebra::Vector2;
    /// use stickslip_fem::{Mesh, P1};
    ///
    /// // A square, whose corners are on the unit circle.
    /// let corners = [(1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0)];
    /// let corners = corners.map(|(x, y)| Vector2::new(x, y)).to_vec();
    /// let square = Mesh::new(corners, vec![0, 1, 2, 0, 2, 3])?;
    /// let square = square.with_part("circle", &[[0, 1], [1, 2], [2, 3], [3, 0]])?;
    /// let disk = P1::new(square).refined_onto(5, "circle", |x| x.normalize())?;
    /// let length: f64 = disk.part("circle")?.weights().iter().sum();
    /// // An inscribed polygon of n sides is shorter by the factor sin(pi / n) / (pi / n).
    /// assert!((length / (256.0 * (std::f64::consts::PI / 128.0).sin()) - 1.0).abs() < 1e-12);
    /// # Ok::<(), stickslip_fem::FemError>(())
    /// ```
    pub fn refined_onto(
        self,
        levels: usize,
        part: &str,
        onto: impl Fn(&SVector<f64, D>) -> SVector<f64, D>,
    ) -> Result<Self, FemError> {
        Ok(Self {
            hierarchy: self.hierarchy.refined_onto(levels, part, onto)?,
        })
    }
}

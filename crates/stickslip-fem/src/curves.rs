//! Curved boundaries: new vertices of a part of the boundary are moved onto a curve or surface.

use nalgebra::SVector;

use crate::curve::Curve;
use crate::refine::refine;
use crate::{FemError, Hierarchy, P1};

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

//! Graded meshes: cells are bisected until none exceeds a size function.

use nalgebra::SVector;

use crate::curve::Onto;
use crate::grading::Grading;
use crate::{FemError, Hierarchy, P1};

/// Growth of the number of vertices at which a level is complete.
const GROWTH: f64 = 2.0;

/// Number of halvings of an edge at which a level is complete: smoothing does not resolve edges much longer than a
/// cell. Without this bound the number of cycles grows with the depth of refinement at a single point of a fine mesh.
const HALVINGS: usize = 2;

/// The largest number of rounds: D rounds halve all edges, and sizes are above [`LEAST`].
const ROUNDS: usize = 256;

/// Adds levels until no cell exceeds the size.
fn grade<const D: usize>(
    mut hierarchy: Hierarchy<D>,
    size: &impl Fn(&SVector<f64, D>) -> f64,
    onto: Option<Onto<'_, D>>,
    most: u32,
) -> Result<Hierarchy<D>, FemError> {
    let mut grading = Grading::new(&hierarchy, size, onto)?;
    for _ in 0..ROUNDS {
        let worst = grading.excess.iter().copied().fold(0.0, f64::max);
        let last = hierarchy.finest().vertex_count();
        let growth = grading.points.len() as f64 / last as f64;
        if grading.points.len() > most as usize {
            let count = grading.points.len() as u64;
            return Err(FemError::AboveLimit { count, most });
        }
        let deepest = grading.generations.iter().copied().max().unwrap_or(0);
        let full = growth >= GROWTH || usize::from(deepest) >= HALVINGS * D;
        if full || worst <= 1.0 && growth > 1.0 {
            grading.add_level(&mut hierarchy)?;
        }
        if worst <= 1.0 {
            return Ok(hierarchy);
        }
        grading.foretell(most)?;
        grading.round((0.5 * worst).max(1.0))?;
    }
    Err(FemError::SizeNotReached { rounds: ROUNDS })
}

impl<const D: usize> Hierarchy<D> {
    /// Adds levels until no cell of the finest one exceeds a size function \[m\] of the position: cells are bisected
    /// while their longest edge exceeds the least size at their vertices and midpoint.
    ///
    /// Each level has at least twice the vertices of the one before. Exceptions are the last level, and levels that are
    /// four times as fine at some point and refined at few. A multigrid cycle therefore costs up to three times that on
    /// the finest level, and once more for each factor of four at points in a mesh that is fine already. Triangles are
    /// bisected by the newest vertex, tetrahedra by marked faces: angles stay bounded. The children of a triangle have
    /// at most four shapes, those of a tetrahedron at most 36. A mesh that was not bisected, or was refined uniformly
    /// since, is marked by its longest edges.
    ///
    /// # Errors
    ///
    /// [`FemError::CellSize`] if a size is not finite or is below 2^-32 of the largest coordinate,
    /// [`FemError::TooMany`] if 32 bits do not number the mesh; this is predicted from a coarser one.
    pub fn graded(self, size: impl Fn(&SVector<f64, D>) -> f64) -> Result<Self, FemError> {
        grade(self, &size, None, u32::MAX)
    }

    /// As [`Hierarchy::graded`], unless the finest level would have more vertices than a limit, as predicted from coarser
    /// levels: no memory is taken for a mesh that is refused.
    ///
    /// # Errors
    ///
    /// [`FemError::AboveLimit`] with a lower bound of their number, beside those of [`Hierarchy::graded`].
    ///
    /// ```
    /// use stickslip_fem::{FemError, Hierarchy, P1};
    ///
    /// let coarse = Hierarchy::new(P1::<2>::grid([1.0, 1.0], [2, 2])?.mesh().clone());
    /// let refused = coarse.graded_within(|_| 1e-4, 1_000_000);
    /// assert!(matches!(refused, Err(FemError::AboveLimit { most: 1_000_000, .. })));
    /// # Ok::<(), FemError>(())
    /// ```
    pub fn graded_within(
        self,
        size: impl Fn(&SVector<f64, D>) -> f64,
        most: u32,
    ) -> Result<Self, FemError> {
        grade(self, &size, None, most)
    }

    /// As [`Hierarchy::graded`], with new vertices on a named part of the boundary moved by `onto`, as by
    /// [`Hierarchy::refined_onto`]. Its errors are possible, too.
    ///
    /// # Errors
    ///
    /// [`FemError::SizeNotReached`] if moving vertices makes cells grow.
    pub fn graded_onto(
        self,
        size: impl Fn(&SVector<f64, D>) -> f64,
        part: &str,
        onto: impl Fn(&SVector<f64, D>) -> SVector<f64, D>,
    ) -> Result<Self, FemError> {
        grade(self, &size, Some((part, &onto)), u32::MAX)
    }
}

impl<const D: usize> P1<D> {
    /// This space with cells no larger than a size function \[m\] of the position.
    ///
    /// A cell is bisected while its longest edge exceeds the least size at its vertices and midpoint. A size that grows
    /// with the distance from a contact resolves the contact at a small part of the cost of a uniform mesh: with h =
    /// h_0 + c times the distance, the number of cells grows as h_0^(1 - D), not h_0^-D. Levels and errors:
    /// [`Hierarchy::graded`].
    ///
    /// ```
    /// use stickslip_fem::P1;
    ///
    /// let space = P1::grid([5.0, 1.0], [5, 1])?.graded(|x| 0.01 + 0.3 * x[1])?;
    /// let fault = space.trace(|x| x[1] == 0.0)?;
    /// assert!(fault.vertices().len() > 500);
    /// assert!(space.vertex_count() < 7_000);
    /// # Ok::<(), stickslip_fem::FemError>(())
    /// ```
    pub fn graded(self, size: impl Fn(&SVector<f64, D>) -> f64) -> Result<Self, FemError> {
        Ok(Self {
            hierarchy: self.hierarchy.graded(size)?,
        })
    }

    /// As [`P1::graded`], unless it would have more than so many vertices: [`Hierarchy::graded_within`].
    pub fn graded_within(
        self,
        size: impl Fn(&SVector<f64, D>) -> f64,
        most: u32,
    ) -> Result<Self, FemError> {
        Ok(Self {
            hierarchy: self.hierarchy.graded_within(size, most)?,
        })
    }

    /// As [`P1::graded`], onto a curved part of the boundary: [`Hierarchy::graded_onto`].
    pub fn graded_onto(
        self,
        size: impl Fn(&SVector<f64, D>) -> f64,
        part: &str,
        onto: impl Fn(&SVector<f64, D>) -> SVector<f64, D>,
    ) -> Result<Self, FemError> {
        Ok(Self {
            hierarchy: self.hierarchy.graded_onto(size, part, onto)?,
        })
    }
}

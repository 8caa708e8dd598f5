//! The cells of a surface as receivers and sources of stress.

use nalgebra::{SMatrix, Vector3};

use super::Triangles;
use super::elements::Elements;
use crate::hmatrix::Extent;
use crate::interaction::{Pair, Pairs};

/// Rounding of unit vectors, and of coordinates as a share of the extent.
const ROUNDING: f64 = 1e-12;

/// The cells with the correction of their shear stress.
pub(crate) struct SurfacePairs<'a, const C: usize> {
    pub(super) elements: Elements<C>,
    pub(super) cells: &'a Triangles,
    pub(super) is_corrected: bool,
}

impl<const C: usize> SurfacePairs<'_, C> {
    /// The tractions at a point on a plane with a unit normal for each slip of a cell.
    pub(crate) fn tractions(
        &self,
        source: usize,
        at: &Vector3<f64>,
        normal: &Vector3<f64>,
    ) -> [Vector3<f64>; C] {
        let Elements {
            rock, loops, slips, ..
        } = &self.elements;
        rock.tractions(&loops[source], at, normal, &slips[source])
    }

    /// The centroid and the normal of a cell.
    pub(crate) fn center_and_normal(&self, cell: usize) -> [Vector3<f64>; 2] {
        [self.elements.centroids[cell], self.elements.axes[cell][2]]
    }

    /// The directions of slip of a cell.
    pub(crate) fn slips(&self, cell: usize) -> &[Vector3<f64>; C] {
        &self.elements.slips[cell]
    }

    /// The normal of the plane in which all cells are, up to rounding.
    fn plane(&self) -> Option<Vector3<f64>> {
        let axes = &self.elements.axes;
        let normal = axes[0][2];
        let corners = || (0..self.cells.count()).flat_map(|cell| self.cells.corners(cell));
        let extent = Extent::of_points(corners());
        let origin = self.elements.centroids[0];
        let bound = ROUNDING * extent.diameter();
        let is_level =
            |corner: [f64; 3]| (Vector3::from(corner) - origin).dot(&normal).abs() <= bound;
        let is_parallel = |axes: &[Vector3<f64>; 3]| axes[2].cross(&normal).norm() <= ROUNDING;
        (axes.iter().all(is_parallel) && corners().all(is_level)).then_some(normal)
    }
}

impl<const C: usize> Pairs<C> for SurfacePairs<'_, C> {
    fn count(&self) -> usize {
        self.cells.count()
    }

    fn extents(&self) -> Vec<Extent> {
        let cells = 0..self.cells.count();
        cells
            .map(|cell| Extent::of_points(self.cells.corners(cell)))
            .collect()
    }

    fn size(&self, cell: usize) -> f64 {
        self.cells.area(cell)
    }

    /// On a plane the normal stress is even in the distance across it, and odd: zero. A free surface leaves the symmetry to slip
    /// along strike on a vertical plane alone.
    fn changes_normal_stress(&self) -> bool {
        let slips_level =
            || (self.elements.slips.as_flattened().iter()).all(|slip| slip.z.abs() <= ROUNDING);
        match self.plane() {
            Some(normal) if self.elements.rock.has_surface() => {
                normal.z.abs() > ROUNDING || !slips_level()
            }
            plane => plane.is_none(),
        }
    }

    #[inline]
    fn pair(&self, receiver: usize, source: usize) -> Pair<C> {
        self.elements.pair(receiver, source)
    }

    fn correction(&self, cell: usize) -> Vec<(usize, SMatrix<f64, C, C>)> {
        if self.is_corrected {
            self.elements.correction(self.cells, cell)
        } else {
            Vec::new()
        }
    }
}

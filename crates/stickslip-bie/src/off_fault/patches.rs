//! Triangles and rectangles as sources of displacement and stress.

use nalgebra::{Matrix3, Vector3};

use crate::surface::{Loop, Rock};

/// Cells in space with `K` corners and `C` directions of slip each.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Patches<const C: usize, const K: usize> {
    pub(crate) rock: Rock,
    pub(crate) cells: Vec<(Loop<K>, [Vector3<f64>; C])>,
}

impl<const C: usize, const K: usize> Patches<C, K> {
    /// The longest edge of a cell, and the distance of a point from its nearest edge.
    pub(super) fn length_and_distance(&self, cell: usize, at: &Vector3<f64>) -> [f64; 2] {
        let corners = &self.cells[cell].0.corners;
        let (mut longest, mut nearest) = (0.0_f64, f64::INFINITY);
        for k in 0..K {
            let (begin, edge) = (corners[k], corners[(k + 1) % K] - corners[k]);
            let share = (at - begin).dot(&edge) / edge.norm_squared();
            let foot = begin + edge * share.clamp(0.0, 1.0);
            nearest = nearest.min((at - foot).norm());
            longest = longest.max(edge.norm());
        }
        [longest, nearest]
    }

    pub(super) fn displacements(&self, cell: usize, at: &Vector3<f64>) -> [Vector3<f64>; C] {
        let (edges, slips) = &self.cells[cell];
        self.rock.displacements(edges, at, slips)
    }

    pub(super) fn stresses(&self, cell: usize, at: &Vector3<f64>) -> [Matrix3<f64>; C] {
        let (edges, slips) = &self.cells[cell];
        self.rock.stresses(edges, at, slips)
    }
}

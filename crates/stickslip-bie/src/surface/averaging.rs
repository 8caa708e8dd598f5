//! The mean of the normal stress over cells that share a vertex.
//!
//! On a curved surface the normal stress of constant triangles has a zigzag between neighbours, which does not vanish with
//! the size of the cells. Its mean by area does.

use nalgebra::Vector3;

use super::Triangles;

/// The sine of the angle between normals below which cells are of one plane.
const PLANAR: f64 = 1e-9;

/// Weights of cells in the mean at each; none on planes, where nothing is to be averaged.
#[derive(Debug)]
pub(crate) struct Averaging {
    starts: Vec<usize>,
    weights: Vec<(usize, f64)>,
}

impl Averaging {
    pub(crate) fn new(cells: &Triangles) -> Self {
        let mut found = Self {
            starts: vec![0],
            weights: Vec::new(),
        };
        let normal = |cell: usize| Vector3::from(cells.axes(cell).normal);
        for cell in 0..cells.count() {
            let around = cells.vertex_neighbors(cell);
            let own = normal(cell);
            let bends = |&other: &usize| own.cross(&normal(other)).norm() > PLANAR;
            if around.iter().any(bends) {
                let total: f64 = around.iter().map(|&other| cells.area(other)).sum();
                let weights = around
                    .iter()
                    .map(|&other| (other, cells.area(other) / total));
                found.weights.extend(weights);
            }
            found.starts.push(found.weights.len());
        }
        found
    }

    /// The cells of the mean at a cell with their weights; empty if it is the cell's own value.
    pub(crate) fn weights(&self, cell: usize) -> &[(usize, f64)] {
        &self.weights[self.starts[cell]..self.starts[cell + 1]]
    }

    /// The mean of values at a cell.
    pub(crate) fn mean(&self, cell: usize, value: impl Fn(usize) -> f64) -> f64 {
        match self.weights(cell) {
            [] => value(cell),
            weights => weights
                .iter()
                .map(|&(other, weight)| weight * value(other))
                .sum(),
        }
    }
}

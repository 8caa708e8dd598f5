//! The matrices of the images of a fault, entry by entry.

use super::dislocation::{Plane, Traction};
use super::low_rank::Entries;

/// The force on cell `i` of the image of slip on cell `j`.
pub(super) struct Images<F> {
    pub(super) plane: Plane,
    pub(super) count: usize,
    /// The distance of the first cell down dip.
    pub(super) begin: f64,
    pub(super) scale: f64,
    /// In radians.
    pub(super) dip: f64,
    pub(super) component: F,
}

impl<F: Fn(Traction) -> f64> Images<F> {
    /// On cell `i`, of a dislocation at the upper end of cell `j`. Distances are counted in cells.
    fn of_edge(&self, i: usize, j: usize) -> f64 {
        let (center, edge) = (self.begin + i as f64 + 0.5, self.begin + j as f64);
        (self.component)(self.plane.image(center, edge))
    }
}

impl<F: Fn(Traction) -> f64> Entries for Images<F> {
    fn count(&self) -> usize {
        self.count
    }

    fn scale(&self) -> f64 {
        self.scale
    }

    /// The image of a cell at the distance `s` is `2 s sin(dip)` away from it.
    fn spacing(&self) -> f64 {
        0.5 * self.dip.sin()
    }

    fn row(&self, i: usize, row: &mut [f64]) {
        let mut upper = self.of_edge(i, 0);
        for (j, entry) in row.iter_mut().enumerate() {
            let lower = self.of_edge(i, j + 1);
            *entry = upper - lower;
            upper = lower;
        }
    }

    fn column(&self, j: usize, column: &mut [f64]) {
        for (i, entry) in column.iter_mut().enumerate() {
            *entry = self.of_edge(i, j) - self.of_edge(i, j + 1);
        }
    }
}

//! The correction that makes tractions of constant triangles converge.
//!
//! The traction of cells of constant slip at centroids has an error in proportion to the gradient of slip, whatever the
//! size of the cells: a zigzag between neighbours. On a plane the slip `a (r . e) phi(r)`, odd about the centroid of a
//! cell, has no traction there, so that what the cells have is the error for this gradient. It is subtracted for the
//! gradient that a cell and its three neighbours have.

use nalgebra::{Matrix2, SMatrix, Vector2, Vector3};

use super::Triangles;
use super::elements::Elements;

/// The radius of `phi` by the root of a cell's area.
const RADIUS: f64 = 3.0;
/// The radii beyond which `phi = exp(-(r/radius)^4)` is 0.
const REACH: f64 = 2.0;
/// The determinant, by the square of the trace, below which centroids are in a line.
const LINE: f64 = 1e-6;

/// The change of the shear stress [Pa/m] at a cell per slip of itself and its neighbours.
pub(crate) type Correction<const C: usize> = Vec<(usize, SMatrix<f64, C, C>)>;

impl<const C: usize> Elements<C> {
    /// The correction at a cell; none where a neighbour is missing.
    pub(crate) fn correction(&self, cells: &Triangles, cell: usize) -> Correction<C> {
        let &[Some(a), Some(b), Some(c)] = cells.neighbors(cell) else {
            return Vec::new();
        };
        let stencil = [cell, a, b, c];
        let Some(weights) = self.gradient(cell, &stencil) else {
            return Vec::new();
        };
        let [s, d, _] = self.axes[cell];
        let defect = self.defect(cells, cell);
        let of = |(&other, weight): (&usize, &Vector2<f64>)| {
            let block = SMatrix::from_fn(|row, column| {
                let slip = &self.slips[other][column];
                let of_slip = [s, d].map(|axis| slip.dot(&axis));
                let sum = (0..2).flat_map(|a| (0..2).map(move |k| (a, k)));
                -sum.map(|(a, k)| defect[row][a][k] * of_slip[a] * weight[k])
                    .sum::<f64>()
            });
            (other, block)
        };
        stencil.iter().zip(&weights).map(of).collect()
    }

    /// The position of a cell as seen from another, along strike and up dip.
    fn seen(&self, from: usize, cell: usize) -> Vector2<f64> {
        let apart = self.centroids[cell] - self.centroids[from];
        let [s, d, _] = &self.axes[from];
        Vector2::new(apart.dot(s), apart.dot(d))
    }

    /// The weights of a linear fit's gradient.
    fn gradient(&self, cell: usize, stencil: &[usize; 4]) -> Option<[Vector2<f64>; 4]> {
        let places = stencil.map(|other| self.seen(cell, other));
        let mean = places.iter().sum::<Vector2<f64>>() * 0.25;
        let places = places.map(|place| place - mean);
        let matrix: Matrix2<f64> = places.iter().map(|place| place * place.transpose()).sum();
        if matrix.determinant() < LINE * matrix.trace() * matrix.trace() {
            return None;
        }
        let inverse = matrix.try_inverse()?;
        Some(places.map(|place| inverse * place))
    }

    /// The traction along each direction of slip of the slip along strike and up dip that grows along either.
    fn defect(&self, cells: &Triangles, cell: usize) -> [[[f64; 2]; 2]; C] {
        let radius = RADIUS * self.areas[cell].sqrt();
        let mut sums = [[[0.0; 2]; 2]; C];
        let [s, d, _] = self.axes[cell];
        for other in self.about(cells, cell, REACH * radius) {
            let place = self.seen(cell, other);
            let distance = (self.centroids[other] - self.centroids[cell]).norm();
            let phi = (-(distance / radius).powi(4)).exp();
            let normal = self.axes[other][2];
            let slips = [s, d].map(|slip: Vector3<f64>| slip - normal * normal.dot(&slip));
            let tractions = self.without_surface(cell, other, &slips);
            for (sums, direction) in sums.iter_mut().zip(&self.slips[cell]) {
                for (sums, traction) in sums.iter_mut().zip(&tractions) {
                    let along = traction.dot(direction) * phi;
                    sums[0] += along * place.x;
                    sums[1] += along * place.y;
                }
            }
        }
        sums
    }

    /// The cells of the sheet about a cell, connected across edges within a distance.
    fn about(&self, cells: &Triangles, cell: usize, distance: f64) -> Vec<usize> {
        let mut found = vec![cell];
        let mut next = 0;
        while let Some(&current) = found.get(next) {
            next += 1;
            for &other in cells.neighbors(current).iter().flatten() {
                let apart = (self.centroids[other] - self.centroids[cell]).norm();
                if apart < distance && !found.contains(&other) {
                    found.push(other);
                }
            }
        }
        found
    }
}

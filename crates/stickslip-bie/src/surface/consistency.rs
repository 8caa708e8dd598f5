//! The correction that makes tractions of constant triangles converge.
//!
//! The traction of cells of constant slip at centroids has an error that alternates between neighbours and is in
//! proportion to the gradient of slip, whatever the size of the cells. On a plane a slip `a (r . e) phi(|r|)` about the
//! centroid of a cell has no traction at that centroid, because it is odd. The traction that the cells give for it is
//! therefore the error at a gradient of 1. This error times the gradient of slip, by a linear fit to a cell and its
//! neighbours, is subtracted.
//!
//! At a free surface the plane is continued above it by reflected cells. At other rims slip ends, and so does the slip
//! `a (r . e) phi(|r|)`; cells at these rims are left as they are.

use nalgebra::{Matrix2, SMatrix, Vector2, Vector3};

use super::Triangles;
use super::edges::Loop;
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
        let neighbors = cells.neighbors(cell);
        let ends = |k: usize| neighbors[k].is_none() && !self.is_at_surface(cells, cell, k);
        if (0..3).any(ends) {
            return Vec::new();
        }
        let stencil: Vec<_> = [cell]
            .into_iter()
            .chain(neighbors.iter().copied().flatten())
            .collect();
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

    /// Whether the edge from a corner to the next is at a free surface.
    fn is_at_surface(&self, cells: &Triangles, cell: usize, k: usize) -> bool {
        let corners = cells.corners(cell);
        self.rock.has_surface() && corners[k][2] == 0.0 && corners[(k + 1) % 3][2] == 0.0
    }

    /// The position of a cell as seen from another, along strike and up dip.
    fn seen(&self, from: usize, cell: usize) -> Vector2<f64> {
        self.position(from, &self.centroids[cell])
    }

    fn position(&self, from: usize, point: &Vector3<f64>) -> Vector2<f64> {
        let apart = point - self.centroids[from];
        let [s, d, _] = &self.axes[from];
        Vector2::new(apart.dot(s), apart.dot(d))
    }

    /// The weights of a linear fit's gradient.
    fn gradient(&self, cell: usize, stencil: &[usize]) -> Option<Vec<Vector2<f64>>> {
        let places: Vec<_> = (stencil.iter())
            .map(|&other| self.seen(cell, other))
            .collect();
        let mean = places.iter().sum::<Vector2<f64>>() / stencil.len() as f64;
        let places: Vec<_> = places.iter().map(|place| place - mean).collect();
        let matrix: Matrix2<f64> = places.iter().map(|place| place * place.transpose()).sum();
        if matrix.determinant() < LINE * matrix.trace() * matrix.trace() {
            return None;
        }
        let inverse = matrix.try_inverse()?;
        Some(places.iter().map(|place| inverse * place).collect())
    }

    /// The traction along each direction of slip of the slip along strike and up dip that grows along either.
    fn defect(&self, cells: &Triangles, cell: usize) -> [[[f64; 2]; 2]; C] {
        let radius = RADIUS * self.areas[cell].sqrt();
        let mut sums = [[[0.0; 2]; 2]; C];
        let [s, d, _] = self.axes[cell];
        let mut add = |source: &Loop, normal: &Vector3<f64>| {
            let center = source.corners.iter().sum::<Vector3<f64>>() / 3.0;
            let distance = (center - self.centroids[cell]).norm();
            if distance >= REACH * radius {
                return;
            }
            let place = self.position(cell, &center) * (-(distance / radius).powi(4)).exp();
            let slips = [s, d].map(|slip: Vector3<f64>| slip - normal * normal.dot(&slip));
            let tractions = self.without_surface(cell, source, &slips);
            for (sums, direction) in sums.iter_mut().zip(&self.slips[cell]) {
                for (sums, traction) in sums.iter_mut().zip(&tractions) {
                    let along = traction.dot(direction);
                    sums[0] += along * place.x;
                    sums[1] += along * place.y;
                }
            }
        };
        let about = self.about(cells, cell, REACH * radius);
        let above = self.distance_to_surface(cells, cell, &about);
        for &other in &about {
            let (source, normal) = (&self.loops[other], &self.axes[other][2]);
            add(source, normal);
            let Some(above) = above else {
                continue;
            };
            let reflected = |v: &Vector3<f64>, line: f64| v + d * (2.0 * (line - v.dot(&d)));
            let line = self.centroids[cell].dot(&d) + above;
            let [a, b, c] = source.corners.each_ref().map(|v| reflected(v, line));
            add(&Loop::new([a, c, b]), &reflected(normal, 0.0));
        }
        sums
    }

    /// The distance up dip from a centroid to a free surface that cells about it reach.
    fn distance_to_surface(&self, cells: &Triangles, cell: usize, about: &[usize]) -> Option<f64> {
        let reach = |&other: &usize| (0..3).any(|k| self.is_at_surface(cells, other, k));
        let distance = -self.centroids[cell].z / self.axes[cell][1].z;
        (about.iter().any(reach) && distance > 0.0).then_some(distance)
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

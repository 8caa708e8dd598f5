//! A surface unrolled into the plane: distances along strike and down dip.

use std::collections::BTreeMap;

use stickslip::bie::Triangles;
use stickslip::nalgebra::{Matrix2, Vector2, Vector3};

/// The gap between sheets, as a share of the largest width.
const GAP: f64 = 0.06;
/// The relative residual at which the iteration ends.
const CLOSE: f64 = 1e-8;

/// The corners of each cell along strike and up dip \[km\], sheets beside one another, 0 at the top of each.
///
/// The coordinates `u` and `v` of vertices have gradients as near as possible to strike and up dip of each cell, by least
/// squares: lengths are those of the surface wherever it can be unrolled.
pub(super) fn unrolled(cells: &Triangles) -> Vec<[[f64; 2]; 3]> {
    // Sheets that share a vertex have one each.
    let mut numbers = BTreeMap::new();
    let corners: Vec<[usize; 3]> = (cells.triangles().iter().enumerate())
        .map(|(cell, corners)| {
            corners.map(|corner| {
                let next = numbers.len();
                *numbers.entry((cells.sheet(cell), corner)).or_insert(next)
            })
        })
        .collect();
    let slopes: Vec<_> = (0..cells.count()).map(|cell| slopes(cells, cell)).collect();
    let system = System {
        corners: &corners,
        slopes: &slopes,
        areas: (0..cells.count()).map(|cell| cells.area(cell)).collect(),
        count: numbers.len(),
    };
    let [u, v] = [0, 1].map(|c| system.solve(c));
    let mut sheets =
        vec![[f64::INFINITY, f64::NEG_INFINITY, f64::NEG_INFINITY]; cells.sheet_count()];
    for (&(sheet, _), &n) in &numbers {
        let [left, right, top] = sheets[sheet];
        sheets[sheet] = [left.min(u[n]), right.max(u[n]), top.max(v[n])];
    }
    let widest = sheets.iter().map(|[left, right, _]| right - left);
    let gap = GAP * widest.fold(0.0, f64::max);
    let mut begin = 0.0;
    let begins: Vec<f64> = (sheets.iter())
        .map(|[left, right, _]| {
            let own = begin - left;
            begin += right - left + gap;
            own
        })
        .collect();
    let place = |sheet: usize, n: usize| {
        [
            (u[n] + begins[sheet]) / 1e3,
            (v[n] - sheets[sheet][2]) / 1e3,
        ]
    };
    (corners.iter().enumerate())
        .map(|(cell, corners)| corners.map(|n| place(cells.sheet(cell), n)))
        .collect()
}

/// The gradients of the hat functions of the corners of a cell, along strike and up dip [1/m].
fn slopes(cells: &Triangles, cell: usize) -> [Vector2<f64>; 3] {
    let axes = cells.axes(cell);
    let [s, d] = [axes.strike, axes.up_dip].map(Vector3::from);
    let [a, b, c] = cells.corners(cell).map(|corner| {
        let corner = Vector3::from(corner);
        Vector2::new(corner.dot(&s), corner.dot(&d))
    });
    let sides = Matrix2::from_columns(&[b - a, c - a]);
    // A cell is not degenerate.
    let inverse = sides.try_inverse().unwrap_or_else(Matrix2::zeros);
    let [b, c] = [0, 1].map(|row| inverse.row(row).transpose());
    [-b - c, b, c]
}

/// The normal equations of the gradients.
struct System<'a> {
    corners: &'a [[usize; 3]],
    slopes: &'a [[Vector2<f64>; 3]],
    areas: Vec<f64>,
    count: usize,
}

impl System<'_> {
    /// `sum area slope . g`, for a gradient of each cell.
    fn gather(&self, gradient: impl Fn(usize) -> Vector2<f64>) -> Vec<f64> {
        let mut sums = vec![0.0; self.count];
        for (cell, (corners, slopes)) in self.corners.iter().zip(self.slopes).enumerate() {
            let gradient = gradient(cell) * self.areas[cell];
            for (&corner, slope) in corners.iter().zip(slopes) {
                sums[corner] += slope.dot(&gradient);
            }
        }
        sums
    }

    /// The coordinate with a gradient of 1 along axis `c`, by conjugate gradients; a constant per sheet is free.
    fn solve(&self, c: usize) -> Vec<f64> {
        let axis = Vector2::ith(c, 1.0);
        let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
        let mut residual = self.gather(|_| axis);
        let (mut x, mut along) = (vec![0.0; self.count], residual.clone());
        let mut size = dot(&residual, &residual);
        let end = CLOSE * CLOSE * size;
        for _ in 0..10 * self.count {
            if size <= end {
                break;
            }
            let image = self.gather(|cell| {
                let parts = self.corners[cell].iter().zip(&self.slopes[cell]);
                parts.map(|(&corner, slope)| slope * along[corner]).sum()
            });
            let step = size / dot(&along, &image);
            for i in 0..self.count {
                x[i] += step * along[i];
                residual[i] -= step * image[i];
            }
            let before = std::mem::replace(&mut size, dot(&residual, &residual));
            for (along, residual) in along.iter_mut().zip(&residual) {
                *along = residual + size / before * *along;
            }
        }
        x
    }
}

#[cfg(test)]
mod tests {
    use stickslip::bie::Triangles;

    use super::unrolled;

    /// A quarter of a cylinder of radius R is a rectangle of its arc, to the polygon's error; two of them are side by side.
    #[test]
    fn cylinders_unroll_into_rectangles() -> Result<(), Box<dyn std::error::Error>> {
        let (radius, count) = (10e3, 24);
        let (mut points, mut triangles) = (Vec::new(), Vec::new());
        for sheet in 0..2 {
            let first = points.len();
            for j in 0..=count {
                let angle = j as f64 / count as f64 * std::f64::consts::FRAC_PI_2;
                let (sin, cos) = angle.sin_cos();
                points.extend((0..=4).map(|i| {
                    let x = 3e3 * f64::from(i) + 40e3 * f64::from(sheet);
                    [x, -radius * (1.0 - cos), -1e3 - radius * sin]
                }));
            }
            for corner in (0..count).flat_map(|j| (0..4).map(move |i| first + 5 * j + i)) {
                triangles.extend([
                    [corner, corner + 1, corner + 6],
                    [corner, corner + 6, corner + 5],
                ]);
            }
        }
        let corners = unrolled(&Triangles::new(&points, &triangles)?);
        let ends = |c: usize| {
            let values = || corners.iter().flatten().map(|place| place[c]);
            (
                values().fold(f64::INFINITY, f64::min),
                values().fold(f64::NEG_INFINITY, f64::max),
            )
        };
        let arc = 2e-3 * radius * count as f64 * (std::f64::consts::PI / 4.0 / count as f64).sin();
        let close = |a: f64, b: f64| (a - b).abs() < 1e-4;
        let ((left, right), (bottom, top)) = (ends(0), ends(1));
        assert!(close(left, 0.0) && close(right, 24.72), "{left} {right}");
        assert!(close(top, 0.0) && close(bottom, -arc), "{bottom} {arc}");
        Ok(())
    }
}

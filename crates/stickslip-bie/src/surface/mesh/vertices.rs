//! The vertices of triangles: those that coincide are one.

use std::collections::HashMap;

use super::super::SurfaceError;

/// The share of the box within which points coincide.
pub(crate) const COINCIDENT: f64 = 1e-9;

/// Points that triangles use, each once, in the order of the first triangle that does.
pub(super) struct Vertices {
    pub(super) points: Vec<[f64; 3]>,
    pub(super) triangles: Vec<[usize; 3]>,
    /// The number of points that coincide with another.
    pub(super) merged: usize,
}

impl Vertices {
    pub(super) fn new(points: &[[f64; 3]], triangles: &[[usize; 3]]) -> Result<Self, SurfaceError> {
        check(points, triangles)?;
        let used = || triangles.iter().flatten().map(|&point| &points[point]);
        let within = COINCIDENT * diagonal(used());
        let mut found = Self {
            points: Vec::new(),
            triangles: Vec::with_capacity(triangles.len()),
            merged: 0,
        };
        let mut numbers = vec![None; points.len()];
        let mut grid = HashMap::new();
        for triangle in triangles {
            let mut of_triangle = [0; 3];
            for (number, &point) in of_triangle.iter_mut().zip(triangle) {
                *number = *numbers[point]
                    .get_or_insert_with(|| found.number(&mut grid, points[point], within));
            }
            found.triangles.push(of_triangle);
        }
        Ok(found)
    }

    /// The number of a point, from a grid of cells that are much larger than the distance of what coincides.
    fn number(
        &mut self,
        grid: &mut HashMap<[i64; 3], Vec<usize>>,
        point: [f64; 3],
        within: f64,
    ) -> usize {
        let width = (16.0 * within).max(f64::MIN_POSITIVE);
        let key = |shift: [f64; 3]| {
            [0, 1, 2].map(|c| ((point[c] + shift[c] * within) / width).floor() as i64)
        };
        for corner in 0..8 {
            let shift = [0, 1, 2].map(|c| if corner >> c & 1 == 1 { 1.0 } else { -1.0 });
            for &number in grid.get(&key(shift)).into_iter().flatten() {
                let apart = [0, 1, 2].map(|c| self.points[number][c] - point[c]);
                if apart.iter().map(|x| x * x).sum::<f64>() <= within * within {
                    self.merged += 1;
                    return number;
                }
            }
        }
        let number = self.points.len();
        self.points.push(point);
        grid.entry(key([0.0; 3])).or_default().push(number);
        number
    }
}

fn check(points: &[[f64; 3]], triangles: &[[usize; 3]]) -> Result<(), SurfaceError> {
    if triangles.is_empty() {
        return Err(SurfaceError::Empty);
    }
    for (point, position) in points.iter().enumerate() {
        if let Some(&value) = position.iter().find(|value| !value.is_finite()) {
            return Err(SurfaceError::NotFinite { point, value });
        }
    }
    for (triangle, corners) in triangles.iter().enumerate() {
        if let Some(&point) = corners.iter().find(|&&point| point >= points.len()) {
            let count = points.len();
            return Err(SurfaceError::Index {
                triangle,
                point,
                count,
            });
        }
    }
    Ok(())
}

/// The least and the largest coordinates of points.
pub(crate) fn bounds<'a>(points: impl Iterator<Item = &'a [f64; 3]>) -> [[f64; 3]; 2] {
    let none = [[f64::INFINITY; 3], [f64::NEG_INFINITY; 3]];
    points.fold(none, |[low, high], point| {
        [
            std::array::from_fn(|c| low[c].min(point[c])),
            std::array::from_fn(|c| high[c].max(point[c])),
        ]
    })
}

/// The diagonal of the box of points.
pub(super) fn diagonal<'a>(points: impl Iterator<Item = &'a [f64; 3]>) -> f64 {
    let [low, high] = bounds(points);
    let sides = [0, 1, 2].map(|c| high[c] - low[c]);
    sides.iter().map(|side| side * side).sum::<f64>().sqrt()
}

//! Interpolation between the vertices of a contact.

use super::SeasPoint;
use crate::record::check::require;
use crate::record::tracing::along;
use crate::{ContactView, SceneError};

/// A relative distance by which rounding may move a point beyond the end of a fault.
const ROUNDING: f64 = 1e-9;
/// The relative distance of vertices from a straight line.
const STRAIGHT: f64 = 1e-6;

/// A position as a weighted mean of vertices.
#[derive(Debug, Clone)]
pub(super) struct Place {
    /// Two vertices on a line, four on a plane, fewer at an end; weights sum to 1.
    shares: Vec<(usize, f64)>,
}

impl Place {
    fn of(shares: &[(usize, f64)]) -> Self {
        let sum: f64 = shares.iter().map(|(_, share)| share).sum();
        let shares = shares.iter().filter(|(_, share)| *share > 0.0);
        Self {
            shares: shares.map(|(k, share)| (*k, share / sum)).collect(),
        }
    }

    /// The mean of a quantity of vertices.
    pub(super) fn mean(&self, value: impl Fn(usize) -> f64) -> f64 {
        let values = self.shares.iter().map(|(k, share)| share * value(*k));
        values.sum()
    }
}

/// Linear interpolation on a line, bilinear on a plane; within half a cell of an end the values of the last cell.
pub(super) enum Map {
    Line {
        order: Vec<usize>,
        axis: Axis,
    },
    Plane {
        cells: Vec<[f64; 3]>,
        axes: [Axis; 2],
    },
}

impl Map {
    /// The map for points such as `point`.
    pub(super) fn new<const C: usize>(
        contact: &ContactView<'_, C>,
        point: SeasPoint,
    ) -> Result<Self, SceneError> {
        let dimension = contact.dimension();
        match point {
            SeasPoint::Line(_) => {
                let requirement = "that of a fault along a line, 1 or 2, for a point on one";
                let legal = dimension == 1 || dimension == 2;
                require(DIMENSION, requirement, dimension as f64, legal)?;
                let requirement = "at most 1e-6 of its length, for a point on a line";
                let bend = bend(contact);
                let what = "distance of a vertex from the line through the fault, over its length";
                require(what, requirement, bend, bend <= STRAIGHT)?;
                Ok(Self::line(contact))
            }
            SeasPoint::Plane(_) => {
                let requirement = "that of a plane of rectangular cells, 2, for a point on one";
                require(DIMENSION, requirement, dimension as f64, dimension == 2)?;
                Ok(Self::plane(contact))
            }
        }
    }

    fn line<const C: usize>(contact: &ContactView<'_, C>) -> Self {
        let (order, positions) = along(contact);
        let axis = Axis::new(positions, |position| {
            // Vertices of a mesh lie at the ends.
            if contact.dimension() == 1 {
                0.5 * contact.weight(order[position])
            } else {
                0.0
            }
        });
        Self::Line { order, axis }
    }

    fn plane<const C: usize>(contact: &ContactView<'_, C>) -> Self {
        let cells: Vec<[f64; 3]> = (0..contact.len()).map(|k| contact.point(k)).collect();
        let lines = [0, 1].map(|c| {
            let mut line: Vec<f64> = cells.iter().map(|cell| cell[c]).collect();
            line.sort_by(f64::total_cmp);
            line.dedup();
            line
        });
        let spacing = |line: &Vec<f64>| {
            let pairs = line.windows(2).map(|pair| pair[1] - pair[0]);
            pairs.fold(f64::INFINITY, f64::min)
        };
        // A single row or column is as wide as its area says, a single cell is a square.
        let area = if cells.is_empty() {
            0.0
        } else {
            contact.weight(0)
        };
        let sizes = match lines.each_ref().map(spacing) {
            [x, y] if x.is_finite() && y.is_finite() => [x, y],
            [x, _] if x.is_finite() => [x, area / x],
            [_, y] if y.is_finite() => [area / y, y],
            _ => [area.sqrt(); 2],
        };
        let [x, y] = lines;
        let axes = [(x, sizes[0]), (y, sizes[1])];
        let axes = axes.map(|(line, size)| Axis::new(line, |_| 0.5 * size));
        Self::Plane { cells, axes }
    }

    /// A point as a mean of vertices.
    pub(super) fn place(&self, point: SeasPoint) -> Result<Place, SceneError> {
        for x in point.coordinates() {
            require("position of a station [m]", "finite", *x, x.is_finite())?;
        }
        self.shares(point).ok_or_else(|| {
            let ends = match self {
                Self::Line { axis, .. } => vec![axis.ends()],
                Self::Plane { axes, .. } => axes.iter().map(Axis::ends).collect(),
            };
            let point = point.coordinates().to_vec();
            SceneError::OutsideContact { point, ends }
        })
    }

    fn shares(&self, point: SeasPoint) -> Option<Place> {
        match (self, point) {
            (Self::Line { order, axis }, SeasPoint::Line(x)) => {
                let shares = axis.shares(x)?;
                let shares = shares.map(|(position, share)| (order[position], share));
                Some(Place::of(&shares))
            }
            (Self::Plane { cells, axes }, SeasPoint::Plane(point)) => {
                let [columns, rows] = [0, 1].map(|c| axes[c].shares(point[c]));
                let (columns, rows) = (columns?, rows?);
                let mut shares = Vec::with_capacity(4);
                let mut nearest = (None, 0.0);
                for (row, down) in rows {
                    for (column, across) in columns {
                        let (x, y) = (axes[0].positions[column], axes[1].positions[row]);
                        let share = down * across;
                        let cell = cells.iter().position(|cell| cell[0] == x && cell[1] == y);
                        if share > nearest.1 {
                            nearest = (cell, share);
                        }
                        shares.extend(cell.map(|cell| (cell, share)));
                    }
                }
                // The cells of a section may leave out the cell in which the point lies.
                nearest.0?;
                Some(Place::of(&shares))
            }
            _ => None,
        }
    }
}

const DIMENSION: &str = "dimension of the contact";

/// Increasing positions, and how far the first and the last cell reach beyond them \[m\].
pub(super) struct Axis {
    positions: Vec<f64>,
    margins: [f64; 2],
}

impl Axis {
    fn new(positions: Vec<f64>, margin: impl Fn(usize) -> f64) -> Self {
        let last = positions.len().saturating_sub(1);
        let margins = if positions.is_empty() {
            [0.0; 2]
        } else {
            [margin(0), margin(last)]
        };
        Self { positions, margins }
    }

    fn ends(&self) -> [f64; 2] {
        let [first, last] = [self.positions.first(), self.positions.last()];
        let [first, last] = [first, last].map(|x| x.copied().unwrap_or(f64::NAN));
        [first - self.margins[0], last + self.margins[1]]
    }

    /// The positions on both sides of `x` with their shares, none outside of the ends.
    fn shares(&self, x: f64) -> Option<[(usize, f64); 2]> {
        let [begin, end] = self.ends();
        let slack = ROUNDING * (end - begin);
        if !(begin - slack..=end + slack).contains(&x) {
            return None;
        }
        let last = self.positions.len() - 1;
        let after = self.positions.partition_point(|position| *position <= x);
        let (low, high) = (after.saturating_sub(1), after.min(last));
        let length = self.positions[high] - self.positions[low];
        let share = if length > 0.0 {
            (x - self.positions[low]) / length
        } else {
            0.0
        };
        Some([(low, 1.0 - share), (high, share)])
    }
}

/// The largest distance of a vertex from the line between the first vertex and the farthest one, over its length.
fn bend<const C: usize>(contact: &ContactView<'_, C>) -> f64 {
    let ways = || {
        let vertices = 0..contact.len();
        vertices.map(|k| [0, 1].map(|c| contact.point(k)[c] - contact.point(0)[c]))
    };
    let length = |way: &[f64; 2]| way[0].hypot(way[1]);
    let farthest = ways().max_by(|a, b| length(a).total_cmp(&length(b)));
    let way = farthest.unwrap_or_default();
    let square = length(&way).powi(2);
    if square == 0.0 {
        return 0.0;
    }
    let off = ways().map(|x| (x[0] * way[1] - x[1] * way[0]).abs() / square);
    off.fold(0.0, f64::max)
}

//! The box of a cell or a cluster.

/// A box along the axes \[m\]: that of a cell, or of several. Cells in a plane leave the third coordinate at 0.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Extent {
    /// The least coordinates.
    pub min: [f64; 3],
    /// The largest coordinates.
    pub max: [f64; 3],
}

impl Extent {
    /// The box of points; without a point it is empty, from infinity to minus infinity.
    pub fn of_points(points: impl IntoIterator<Item = [f64; 3]>) -> Self {
        let boxes = points.into_iter().map(|point| Self {
            min: point,
            max: point,
        });
        Self::of_boxes(boxes)
    }

    /// The box of boxes.
    pub fn of_boxes(boxes: impl IntoIterator<Item = Self>) -> Self {
        let empty = Self {
            min: [f64::INFINITY; 3],
            max: [f64::NEG_INFINITY; 3],
        };
        boxes.into_iter().fold(empty, |all, one| Self {
            min: [0, 1, 2].map(|i| all.min[i].min(one.min[i])),
            max: [0, 1, 2].map(|i| all.max[i].max(one.max[i])),
        })
    }

    /// The lengths of its edges.
    pub fn lengths(&self) -> [f64; 3] {
        [0, 1, 2].map(|i| self.max[i] - self.min[i])
    }

    /// The length of its diagonal.
    pub fn diameter(&self) -> f64 {
        norm(self.lengths())
    }

    /// The distance of two boxes, 0 if they touch or overlap.
    pub fn distance(&self, other: &Self) -> f64 {
        norm([0, 1, 2].map(|i| {
            let gap = (self.min[i] - other.max[i]).max(other.min[i] - self.max[i]);
            gap.max(0.0)
        }))
    }

    /// Twice the center along an axis.
    pub(super) fn place(&self, axis: usize) -> f64 {
        self.min[axis] + self.max[axis]
    }

    pub(super) fn is_finite(&self) -> bool {
        let numbers = [self.min, self.max];
        numbers.as_flattened().iter().all(|x| x.is_finite())
    }
}

fn norm(lengths: [f64; 3]) -> f64 {
    lengths.iter().map(|x| x * x).sum::<f64>().sqrt()
}

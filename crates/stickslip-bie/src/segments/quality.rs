//! How even and how smooth polylines are.

use super::Segments;

/// The ratio of lengths of neighbours beyond which they are listed.
const UNEQUAL: f64 = 1.2;

/// How even and how smooth segments are: stress on them is less exact where neighbours are of unequal length, and the normal
/// stress at a bend grows with slip as 1/h.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct SegmentsQuality {
    /// The largest ratio of the lengths of two neighbours, at least 1.
    pub largest_ratio: f64,
    /// The pairs of neighbours of a ratio beyond 1.2.
    pub unequal: Vec<[usize; 2]>,
    /// The largest angle between two neighbours \[degrees\].
    pub largest_bend: f64,
    /// The neighbours there; `None` without neighbours.
    pub largest_bend_between: Option<[usize; 2]>,
}

impl Segments {
    /// How even and how smooth the segments are.
    pub fn quality(&self) -> SegmentsQuality {
        let mut quality = SegmentsQuality {
            largest_ratio: 1.0,
            unequal: Vec::new(),
            largest_bend: 0.0,
            largest_bend_between: None,
        };
        let pairs = (0..self.count()).filter_map(|cell| Some([cell, self.next(cell)?]));
        for pair in pairs {
            let [a, b] = pair.map(|cell| self.length(cell));
            let ratio = (a / b).max(b / a);
            quality.largest_ratio = quality.largest_ratio.max(ratio);
            if ratio > UNEQUAL {
                quality.unequal.push(pair);
            }
            let bend = self.angle(pair);
            if quality.largest_bend_between.is_none() || bend > quality.largest_bend {
                quality.largest_bend = bend;
                quality.largest_bend_between = Some(pair);
            }
        }
        quality
    }

    /// The larger angle of a cell with its neighbours along its fault \[degrees\]: where a fault bends by more than a degree
    /// or so at a cell, its normal stress may vanish there by slip.
    pub fn bend_at(&self, cell: usize) -> f64 {
        let next = self.next(cell).map(|next| [cell, next]);
        let previous = self.previous(cell).map(|previous| [previous, cell]);
        let pairs = [previous, next].into_iter().flatten();
        pairs.map(|pair| self.angle(pair)).fold(0.0, f64::max)
    }

    /// The cell behind a cell, across the first point of a closed fault, too.
    fn next(&self, cell: usize) -> Option<usize> {
        let cells = self.cells_of(self.fault_of(cell));
        let next = if cell + 1 < cells.end {
            cell + 1
        } else {
            cells.start
        };
        (next != cell && self.ends(next)[0] == self.ends(cell)[1]).then_some(next)
    }

    fn previous(&self, cell: usize) -> Option<usize> {
        let cells = self.cells_of(self.fault_of(cell));
        let previous = if cell > cells.start { cell } else { cells.end } - 1;
        (self.next(previous) == Some(cell)).then_some(previous)
    }

    /// The angle between two cells \[degrees\].
    fn angle(&self, pair: [usize; 2]) -> f64 {
        let [u, v] = pair.map(|cell| {
            let [a, b] = self.ends(cell);
            [b[0] - a[0], b[1] - a[1]]
        });
        let turn = (u[0] * v[1] - u[1] * v[0]).atan2(u[0] * v[0] + u[1] * v[1]);
        turn.abs().to_degrees()
    }
}

//! Cells of a plane.

use super::DiffusionError;
use super::error::finite;
use super::faces::conductance;
use super::side::Side;

/// Equal rectangular cells of a plane, along strike and down dip.
///
/// Cells along strike are numbered first, as those of a planar fault.
///
/// ```
/// use stickslip_fields::Plane;
///
/// let plane = Plane::new([[-400.0, 400.0], [-400.0, 400.0]], [80, 80])?;
/// assert_eq!((plane.count(), plane.center(81)), (6400, [-385.0, -385.0]));
/// # Ok::<(), stickslip_fields::DiffusionError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Plane {
    /// The ends along strike and down dip \[m\].
    ends: [[f64; 2]; 2],
    counts: [usize; 2],
    /// The lengths of a cell \[m\].
    lengths: [f64; 2],
}

impl Plane {
    /// So many cells between the ends, along strike and down dip \[m\].
    ///
    /// # Errors
    /// [`DiffusionError`] for no cells, and for ends that are not finite or do not increase.
    pub fn new(ends: [[f64; 2]; 2], counts: [usize; 2]) -> Result<Self, DiffusionError> {
        let mut lengths = [0.0; 2];
        for (length, (ends, count)) in lengths.iter_mut().zip(ends.iter().zip(counts)) {
            if count == 0 {
                let what = "cells of a plane along a side";
                return Err(DiffusionError::Count {
                    what,
                    expected: 1,
                    found: 0,
                });
            }
            finite("begin of a plane [m]", None, ends[0])?;
            finite("end of a plane [m]", None, ends[1])?;
            if ends[1] <= ends[0] {
                return Err(DiffusionError::Value {
                    what: "end of a plane [m]",
                    cell: None,
                    requirement: "beyond its begin",
                    value: ends[1],
                });
            }
            *length = (ends[1] - ends[0]) / count as f64;
        }
        Ok(Self {
            ends,
            counts,
            lengths,
        })
    }

    /// The number of cells.
    pub fn count(&self) -> usize {
        self.counts[0] * self.counts[1]
    }

    /// The numbers of cells along strike and down dip.
    pub fn counts(&self) -> [usize; 2] {
        self.counts
    }

    /// The lengths of a cell along strike and down dip \[m\].
    pub fn lengths(&self) -> [f64; 2] {
        self.lengths
    }

    /// The centre of a cell \[m\].
    pub fn center(&self, cell: usize) -> [f64; 2] {
        let at = [cell % self.counts[0], cell / self.counts[0]];
        [0, 1].map(|axis| self.ends[axis][0] + (at[axis] as f64 + 0.5) * self.lengths[axis])
    }

    pub(super) fn ends(&self) -> [[f64; 2]; 2] {
        self.ends
    }

    /// The cell that holds a position, the first at an edge; none outside.
    pub(super) fn cell_at(&self, position: [f64; 2]) -> Option<usize> {
        let mut at = [0; 2];
        for axis in 0..2 {
            let [begin, end] = self.ends[axis];
            if !(position[axis] >= begin && position[axis] <= end) {
                return None;
            }
            let place = ((position[axis] - begin) / self.lengths[axis]).ceil() as usize;
            at[axis] = place.saturating_sub(1).min(self.counts[axis] - 1);
        }
        Some(at[1] * self.counts[0] + at[0])
    }

    /// The numbers of inner faces across strike and across dip; those across strike come first.
    pub(super) fn faces(&self) -> [usize; 2] {
        let [columns, rows] = self.counts;
        [(columns - 1) * rows, columns * (rows - 1)]
    }

    /// The conductances of the inner faces, from the mobility of each cell.
    pub(super) fn conductances(&self, mobility: &[f64], faces: &mut [f64]) {
        let ([columns, _], [width, height]) = (self.counts, self.lengths);
        let (across_strike, across_dip) = faces.split_at_mut(self.faces()[0]);
        let of = |cells: [usize; 2], length: f64, distance: f64| {
            length * conductance(cells.map(|cell| mobility[cell]), [0.5 * distance; 2])
        };
        for (row, faces) in across_strike.chunks_mut((columns - 1).max(1)).enumerate() {
            for (column, face) in faces.iter_mut().enumerate() {
                let cell = row * columns + column;
                *face = of([cell, cell + 1], height, width);
            }
        }
        for (cell, face) in across_dip.iter_mut().enumerate() {
            *face = of([cell, cell + columns], width, height);
        }
    }

    /// Adds `weight` times the volume rates that flow into each cell from the others.
    pub(super) fn add_flow(&self, faces: &[f64], pressure: &[f64], weight: f64, into: &mut [f64]) {
        let columns = self.counts[0];
        let (across_strike, across_dip) = faces.split_at(self.faces()[0]);
        let rows = pressure.chunks(columns).zip(into.chunks_mut(columns));
        for ((pressure, into), row) in rows.zip(0..) {
            let faces = &across_strike[row * (columns - 1)..(row + 1) * (columns - 1)];
            let mut before = 0.0;
            for (i, face) in faces.iter().enumerate() {
                let flow = weight * face * (pressure[i + 1] - pressure[i]);
                into[i] += flow - before;
                before = flow;
            }
            into[columns - 1] -= before;
        }
        for (row, faces) in across_dip.chunks(columns).enumerate() {
            let (above, below) = into[row * columns..].split_at_mut(columns);
            let pressure = pressure[row * columns..].split_at(columns);
            for (i, face) in faces.iter().enumerate() {
                let flow = weight * face * (pressure.1[i] - pressure.0[i]);
                above[i] += flow;
                below[i] -= flow;
            }
        }
    }

    /// Adds half the volume rate along a direction through each of its faces to both of its cells.
    pub(super) fn add_half_flow(
        &self,
        direction: usize,
        faces: &[f64],
        pressure: &[f64],
        rates: &mut [f64],
    ) {
        let (columns, first) = (self.counts[0], self.faces()[0]);
        let mut add = |face: f64, cells: [usize; 2]| {
            let half = 0.5 * face * (pressure[cells[0]] - pressure[cells[1]]);
            rates[cells[0]] += half;
            rates[cells[1]] += half;
        };
        if direction == 0 {
            for (number, &face) in faces[..first].iter().enumerate() {
                let cell = number + number / (columns - 1);
                add(face, [cell, cell + 1]);
            }
        } else {
            for (cell, &face) in faces[first..].iter().enumerate() {
                add(face, [cell, cell + columns]);
            }
        }
    }

    /// The cells at a side, the length of their face and one over its distance [1/m].
    pub(super) fn at_side(&self, side: Side) -> Vec<(usize, f64, f64)> {
        let ([columns, rows], [width, height]) = (self.counts, self.lengths);
        match side {
            Side::Begin | Side::End => {
                let column = if side == Side::End { columns - 1 } else { 0 };
                (0..rows)
                    .map(|row| (row * columns + column, height, 2.0 / width))
                    .collect()
            }
            Side::Top | Side::Bottom => {
                let row = if side == Side::Bottom { rows - 1 } else { 0 };
                (0..columns)
                    .map(|column| (row * columns + column, width, 2.0 / height))
                    .collect()
            }
        }
    }
}

//! Flow of fourth order on planes.

use super::side::Side;
use super::{Boundary, Cells, Diffusion, DiffusionError, Plane};

/// Of the third difference in the flow through a face.
const FLOW: f64 = 1.0 / 12.0;
/// Of the second difference between the mean of a cell and the value at its centre.
const MEAN: f64 = 1.0 / 24.0;

impl Diffusion {
    /// Takes the flow through faces to fourth order in the size of cells, on a plane; for pressures that are smooth on the
    /// scale of cells, such as those of Gaussian sources.
    ///
    /// ```text
    /// flow = c (p_1 - p_0) - (1/12) c (p_2 - 3 p_1 + 3 p_0 - p_-1)
    /// ```
    ///
    /// A stage solves with the first part, and again with the second part of that solution: a step takes twice the time. It
    /// is of second order where conductances change, and left out beside sealed cells and at sides of given pressure or
    /// flux. Pressures are those at the centres of cells. Pressure may undershoot near a point source, and the cell of a
    /// well shows the pressure at another radius.
    ///
    /// # Errors
    /// [`DiffusionError::Place`] for cells that are no plane.
    pub fn with_fourth_order(mut self) -> Result<Self, DiffusionError> {
        let Cells::Plane(plane) = &self.cells else {
            return Err(DiffusionError::Place {
                what: "flow",
                place: "fourth order",
                cells: self.cells.kind(),
                instead: "a plane",
            });
        };
        if !self.fourth_order {
            for injection in self
                .injections
                .iter_mut()
                .filter(|injection| injection.spread)
            {
                plane.sharpen(&mut injection.shares);
            }
        }
        self.fourth_order = true;
        self.changed();
        Ok(self)
    }

    /// Adds `weight` times what the flow of fourth order has beyond that of second order.
    pub(super) fn add_fourth_order(
        &self,
        faces: &[f64],
        pressure: &[f64],
        weight: f64,
        into: &mut [f64],
    ) {
        let Cells::Plane(plane) = &self.cells else {
            return;
        };
        if !self.fourth_order {
            return;
        }
        let sealed = |side: Side| self.sides[side as usize] == Boundary::Sealed;
        let ends = [[Side::Begin, Side::End], [Side::Top, Side::Bottom]].map(|of| of.map(sealed));
        for pencil in plane.pencils() {
            let faces = |i: usize| faces[pencil.first_face + i * pencil.stride_of_faces];
            pencil.add_curvature(faces, pressure, ends[pencil.direction], weight, into);
        }
    }
}

/// A row or a column of cells.
struct Pencil {
    direction: usize,
    count: usize,
    first: usize,
    stride: usize,
    first_face: usize,
    stride_of_faces: usize,
}

impl Pencil {
    /// The cell of a number.
    fn cell(&self, i: usize) -> usize {
        self.first + i * self.stride
    }

    /// Adds `-weight/12` of the second difference of `c_i (p_(i+1) - 2 p_i + p_(i-1))`: symmetric, and no volume is lost.
    /// Pressure is even at sealed ends.
    fn add_curvature(
        &self,
        faces: impl Fn(usize) -> f64,
        pressure: &[f64],
        sealed: [bool; 2],
        weight: f64,
        into: &mut [f64],
    ) {
        let (last, mut before) = (self.count - 1, 0.0);
        for i in 0..self.count {
            let at = |i: usize| pressure[self.cell(i)];
            let left = (i > 0).then(|| (faces(i - 1), at(i - 1) - at(i)));
            let right = (i < last).then(|| (faces(i), at(i + 1) - at(i)));
            let own = match (left, right) {
                (Some((left, to_left)), Some((right, to_right))) => {
                    let sum = left + right;
                    let mean = if sum > 0.0 {
                        2.0 * left * right / sum
                    } else {
                        0.0
                    };
                    mean * (to_left + to_right)
                }
                (None, Some((face, change))) if sealed[0] => face * change,
                (Some((face, change)), None) if sealed[1] => face * change,
                _ => 0.0,
            };
            if i > 0 {
                let flow = weight * FLOW * (own - before);
                into[self.cell(i - 1)] -= flow;
                into[self.cell(i)] += flow;
            }
            before = own;
        }
    }
}

impl Plane {
    fn pencils(&self) -> impl Iterator<Item = Pencil> {
        let ([columns, rows], across_strike) = (self.counts(), self.faces()[0]);
        let along_strike = (0..rows).map(move |row| Pencil {
            direction: 0,
            count: columns,
            first: row * columns,
            stride: 1,
            first_face: row * (columns - 1),
            stride_of_faces: 1,
        });
        let down_dip = (0..columns).map(move |column| Pencil {
            direction: 1,
            count: rows,
            first: column,
            stride: columns,
            first_face: across_strike + column,
            stride_of_faces: columns,
        });
        along_strike.chain(down_dip)
    }

    /// Turns shares that are means over cells into those of centres; their sum stays.
    pub(super) fn sharpen(&self, shares: &mut Vec<(usize, f64)>) {
        let mut means = vec![0.0; self.count()];
        for &(cell, share) in &*shares {
            means[cell] += share;
        }
        let mut centers = means.clone();
        for pencil in self.pencils() {
            for i in 1..pencil.count {
                let [left, right] = [pencil.cell(i - 1), pencil.cell(i)];
                let flow = MEAN * (means[right] - means[left]);
                centers[left] -= flow;
                centers[right] += flow;
            }
        }
        shares.clear();
        shares.extend(
            centers
                .into_iter()
                .enumerate()
                .filter(|&(_, share)| share != 0.0),
        );
    }
}

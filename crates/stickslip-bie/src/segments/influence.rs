//! The traction on cells due to slip on others.

use nalgebra::Complex;

use super::Segments;
use super::orientation::Side;
use super::potentials::Space;
use crate::Mode;

/// Shear stress in the direction of slip and normal stress, compression positive \[Pa\].
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Traction {
    pub(super) shear: f64,
    pub(super) normal: f64,
}

/// A cell with its sides.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Cell {
    pub(super) ends: [Complex<f64>; 2],
    /// The unit vector from begin to end.
    pub(super) direction: Complex<f64>,
    pub(super) side: Side,
}

impl Cell {
    fn center(&self) -> Complex<f64> {
        (self.ends[0] + self.ends[1]) * 0.5
    }
}

/// The tractions at the centres of cells due to slip by 1 m.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Influence {
    pub(super) space: Space,
    mode: Mode,
    /// 1 for positive slip up dip, else -1.
    pub(super) sense: f64,
    pub(super) cells: Vec<Cell>,
}

impl Influence {
    pub(super) fn new(segments: &Segments, space: Space, mode: Mode, sense: f64) -> Self {
        let sides = Side::of_cells(segments);
        let cells = sides.into_iter().enumerate().map(|(cell, side)| {
            let ends = segments.ends(cell).map(|[x, z]| Complex::new(x, z));
            Cell {
                direction: (ends[1] - ends[0]) / segments.length(cell),
                ends,
                side,
            }
        });
        Self {
            space,
            mode,
            sense,
            cells: cells.collect(),
        }
    }

    /// On cell `i` due to slip on cell `j`.
    pub(super) fn traction(&self, i: usize, j: usize) -> Traction {
        let (on, of) = (&self.cells[i], &self.cells[j]);
        let z = on.center();
        match self.mode {
            Mode::Antiplane => {
                let jump = of.side.antiplane_jump();
                let stress = self.space.antiplane(of.ends, jump, z);
                // (sxy, szy) . i t of sxy - i szy.
                let left = -(stress * on.direction).im;
                Traction {
                    shear: on.side.antiplane_jump() * left,
                    normal: 0.0,
                }
            }
            Mode::InPlane { .. } => {
                let jump = of.side.in_plane_jump(of.direction);
                let stress = self.space.in_plane(of.ends, jump, z);
                // In axes along the cell and to its left.
                let turned = stress.deviator * on.direction * on.direction;
                Traction {
                    shear: -0.5 * on.side.right() * turned.im,
                    normal: -0.5 * self.sense * (stress.trace + turned.re),
                }
            }
        }
    }
}

//! The cells of a fault, as fields need them.

use pyo3::prelude::*;
use stickslip::fields::{Cells as FluidCells, DiffusionError, Line, Plane};

use crate::errors::{Bare, argument};
use crate::faults::Layout;
use crate::fields::diffusion::refused;

/// The cells of a fault.
#[derive(Clone, Copy)]
pub(crate) enum Ground {
    /// Equal cells of a line between two ends \[m\].
    Line([f64; 2], usize),
    /// Those of a plane, along strike and down dip.
    Plane([[f64; 2]; 2], [usize; 2]),
    /// Those of several planes.
    Planes,
}

/// The cells of a fault, with their layout.
#[derive(Clone, Copy)]
pub(crate) struct Cells {
    pub(crate) ground: Ground,
    pub(crate) layout: Layout,
}

impl Cells {
    /// The cells on which fluid diffuses.
    pub(super) fn for_fluid(&self, name: &str) -> PyResult<FluidCells> {
        let cells: Result<FluidCells, DiffusionError> = match self.ground {
            Ground::Line(ends, count) => Line::uniform(ends, count).map(Into::into),
            Ground::Plane(ends, counts) => Plane::new(ends, counts).map(Into::into),
            Ground::Planes => {
                let requirement = "ThermalPressurization or ShearHeating on several planes";
                return Err(argument(name, requirement, Bare("Diffusion".to_owned())));
            }
        };
        cells.map_err(refused(name))
    }

    pub(super) fn is_line(&self) -> bool {
        matches!(self.ground, Ground::Line(..))
    }
}

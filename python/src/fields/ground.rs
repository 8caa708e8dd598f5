//! The cells of a fault, as fields need them.

use std::ops::Range;

use pyo3::prelude::*;
use stickslip::fields::{Cells as FluidCells, Line, Plane};

use crate::errors::{Bare, argument};
use crate::faults::Layout;
use crate::fields::diffusion::refused;

/// The ends along strike and down dip \[m\], and the numbers of cells.
pub(crate) type Rectangles = ([[f64; 2]; 2], [usize; 2]);

/// The cells of a fault.
pub(crate) enum Ground {
    /// Points along which no fluid flows, by what they are: those of a slider, or of a contact of a body.
    Apart(&'static str),
    /// Equal cells of a line between two ends \[m\].
    Line([f64; 2], usize),
    /// Those of a plane.
    Plane(Rectangles),
    /// Those of several planes.
    Planes(Vec<Rectangles>),
}

/// The cells of a fault, with their layout.
pub(crate) struct Cells {
    pub(crate) ground: Ground,
    pub(crate) layout: Layout,
}

impl Cells {
    /// So many points of what has this name.
    pub(crate) fn apart(of: &'static str, count: usize) -> Self {
        let layout = Layout { count, shape: None };
        Self {
            ground: Ground::Apart(of),
            layout,
        }
    }

    /// The cells of a field that follows one plane of several, and their numbers; none for a field on all cells.
    pub(super) fn of_plane(
        &self,
        name: &str,
        plane: Option<usize>,
    ) -> PyResult<Option<(Self, Range<usize>)>> {
        let name = format!("{name}.plane");
        let Ground::Planes(planes) = &self.ground else {
            return match plane {
                None => Ok(None),
                Some(plane) => Err(argument(&name, "None but on a FaultSystem", plane)),
            };
        };
        let Some((number, &of)) = plane.and_then(|n| Some((n, planes.get(n)?))) else {
            let requirement = format!("the number of one of {} planes, from 0", planes.len());
            let given = plane.map_or("None".to_owned(), |plane| plane.to_string());
            return Err(argument(&name, &requirement, Bare(given)));
        };
        let count = |&(_, [columns, rows]): &Rectangles| columns * rows;
        let first = planes[..number].iter().map(count).sum::<usize>();
        let [columns, rows] = of.1;
        let layout = Layout {
            count: count(&of),
            shape: Some([rows, columns]),
        };
        let cells = Self {
            ground: Ground::Plane(of),
            layout,
        };
        Ok(Some((cells, first..first + layout.count)))
    }

    /// The cells on which fluid diffuses.
    pub(super) fn for_fluid(&self, name: &str) -> PyResult<FluidCells> {
        match &self.ground {
            Ground::Line(ends, count) => {
                let line = Line::uniform(*ends, *count);
                Ok(line.map_err(refused(name))?.into())
            }
            Ground::Plane((ends, counts)) => {
                let plane = Plane::new(*ends, *counts);
                Ok(plane.map_err(refused(name))?.into())
            }
            Ground::Apart(of) => Err(refuse_fluid(name, of)),
            Ground::Planes(_) => Err(refuse_fluid(name, "several planes")),
        }
    }

    pub(super) fn is_line(&self) -> bool {
        matches!(self.ground, Ground::Line(..))
    }
}

/// The exception of a fluid that nothing takes along.
fn refuse_fluid(name: &str, of: &str) -> PyErr {
    let requirement = format!("ThermalPressurization or ShearHeating on {of}");
    argument(name, &requirement, Bare("Diffusion".to_owned()))
}

//! Sides of the cells: sealed, or with a given pressure or flux.

use super::error::{finite, positive};
use super::{Cells, Diffusion, DiffusionError, Place};

/// A side of a line or a plane.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Side {
    /// The begin of a line, or of a plane along strike.
    Begin,
    /// The end of a line, or of a plane along strike.
    End,
    /// The begin of a plane down dip.
    Top,
    /// The end of a plane down dip.
    Bottom,
}

/// The condition at a side.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[doc(alias("Dirichlet", "Neumann", "no flux"))]
pub enum Boundary {
    /// No fluid passes.
    #[default]
    Sealed,
    /// A pressure \[Pa\].
    Pressure(f64),
    /// A Darcy velocity into the cells [m/s].
    Flux(f64),
}

/// The exchange of a cell with a side of given pressure.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Outlet {
    pub cell: usize,
    /// Conductance over mobility.
    pub geometry: f64,
    pub pressure: f64,
    /// The side, none for another face.
    pub side: Option<Side>,
}

/// The volume rate into a cell through a side of given flux.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Inflow {
    pub cell: usize,
    pub rate: f64,
    pub side: Side,
}

impl Side {
    pub(super) const ALL: [Self; 4] = [Self::Begin, Self::End, Self::Top, Self::Bottom];

    /// The direction of its outward normal among the directions of the cells.
    pub(super) fn outward(self, direction: usize) -> Option<f64> {
        match (self, direction) {
            (Self::Begin, 0) | (Self::Top, 1) => Some(-1.0),
            (Self::End, 0) | (Self::Bottom, 1) => Some(1.0),
            _ => None,
        }
    }

    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Begin => "the begin",
            Self::End => "the end",
            Self::Top => "the top",
            Self::Bottom => "the bottom",
        }
    }
}

impl Diffusion {
    /// Sets the condition at a side, which is sealed else.
    ///
    /// The pressure of a side holds at the outer edge of its cells. At the end of a trace it holds within a thousandth of
    /// the length of the cell.
    ///
    /// # Errors
    /// [`DiffusionError`] for a side that the cells do not have, and a pressure or flux that is not finite.
    pub fn with_side(mut self, side: Side, boundary: Boundary) -> Result<Self, DiffusionError> {
        match boundary {
            Boundary::Sealed => {}
            Boundary::Pressure(value) => finite("pressure of a side [Pa]", None, value)?,
            Boundary::Flux(value) => finite("flux of a side [m/s]", None, value)?,
        }
        let known = match &self.cells {
            Cells::Line(_) => matches!(side, Side::Begin | Side::End),
            Cells::Plane(_) => true,
            Cells::Network(_) => false,
        };
        if !known {
            return Err(self.cells.misplaced("side", side.name()));
        }
        self.sides[side as usize] = boundary;
        self.place_sides();
        Ok(self)
    }

    /// Opens a face of a cell to a given pressure: at the rim of a network, or towards another fracture. The face has a
    /// length \[m\] (1 on lines) and a distance from the pressure of the cell \[m\].
    ///
    /// # Errors
    /// [`DiffusionError`] for a place outside of the cells, a length or distance that is not above 0, and a pressure that
    /// is not finite.
    pub fn with_open_face(
        mut self,
        place: impl Into<Place>,
        [length, distance]: [f64; 2],
        pressure: f64,
    ) -> Result<Self, DiffusionError> {
        positive("length of an open face [m]", None, length)?;
        positive("distance of an open face [m]", None, distance)?;
        finite("pressure of an open face [Pa]", None, pressure)?;
        let (cell, geometry) = (self.cells.at("open face", place.into())?, length / distance);
        self.outlets.push(Outlet {
            cell,
            geometry,
            pressure,
            side: None,
        });
        self.changed();
        Ok(self)
    }

    /// The exchange with all sides.
    fn place_sides(&mut self) {
        self.outlets.retain(|outlet| outlet.side.is_none());
        self.inflows.clear();
        for side in Side::ALL {
            let boundary = self.sides[side as usize];
            for (cell, length, to_side) in self.cells.at_side(side) {
                match boundary {
                    Boundary::Sealed => {}
                    Boundary::Pressure(pressure) => {
                        let geometry = length * to_side;
                        self.outlets.push(Outlet {
                            cell,
                            geometry,
                            pressure,
                            side: Some(side),
                        });
                    }
                    Boundary::Flux(flux) => {
                        let rate = flux * length * self.properties.thickness[cell];
                        self.inflows.push(Inflow { cell, rate, side });
                    }
                }
            }
        }
        self.changed();
    }
}

impl Cells {
    /// The cells at a side, each with the length of its face \[m\] (1 on a line) and one over its distance [1/m].
    fn at_side(&self, side: Side) -> Vec<(usize, f64, f64)> {
        match (self, side) {
            (Self::Line(line), Side::Begin | Side::End) => {
                let (cell, to_side) = line.to_side(side == Side::End);
                vec![(cell, 1.0, to_side)]
            }
            (Self::Line(_) | Self::Network(_), _) => Vec::new(),
            (Self::Plane(plane), side) => plane.at_side(side),
        }
    }
}

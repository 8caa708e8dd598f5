//! The conditions at the sides of the cells.

use super::error::{finite, positive};
use super::side::{Inflow, Outlet};
use super::{Boundary, Cells, Diffusion, DiffusionError, Place, Side};

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

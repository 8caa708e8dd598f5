//! The cells of a fault, and the faces between them.

use super::{DiffusionError, Line, Network, Plane};

/// The cells on which pore pressure diffuses.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum Cells {
    /// Cells along a line.
    Line(Line),
    /// Cells of a plane.
    Plane(Plane),
    /// Cells in any arrangement.
    Network(Network),
}

impl From<Network> for Cells {
    fn from(network: Network) -> Self {
        Self::Network(network)
    }
}

impl From<Plane> for Cells {
    fn from(plane: Plane) -> Self {
        Self::Plane(plane)
    }
}

impl From<Line> for Cells {
    fn from(line: Line) -> Self {
        Self::Line(line)
    }
}

/// A place on the cells.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Place {
    /// The position along a line \[m\].
    Along(f64),
    /// The position along strike and down dip on a plane \[m\].
    On([f64; 2]),
    /// A cell, in the order of the vertices.
    Cell(usize),
}

impl From<f64> for Place {
    fn from(position: f64) -> Self {
        Self::Along(position)
    }
}

impl From<[f64; 2]> for Place {
    fn from(position: [f64; 2]) -> Self {
        Self::On(position)
    }
}

impl Place {
    pub(super) fn kind(self) -> &'static str {
        match self {
            Self::Along(_) => "a position along a line",
            Self::On(_) => "a position on a plane",
            Self::Cell(_) => "a cell",
        }
    }
}

impl Cells {
    /// The number of cells.
    pub fn count(&self) -> usize {
        match self {
            Self::Line(line) => line.count(),
            Self::Plane(plane) => plane.count(),
            Self::Network(network) => network.count(),
        }
    }

    /// The size of each cell: a length \[m\] on lines, an area [m^2] else.
    pub(super) fn sizes(&self) -> Vec<f64> {
        match self {
            Self::Line(line) => line.lengths().to_vec(),
            Self::Plane(plane) => vec![plane.lengths()[0] * plane.lengths()[1]; plane.count()],
            Self::Network(network) => network.areas().to_vec(),
        }
    }

    /// The vertex of each cell.
    pub(super) fn vertices(&self) -> Vec<usize> {
        match self {
            Self::Line(line) => line.vertices().to_vec(),
            _ => (0..self.count()).collect(),
        }
    }

    /// The number of inner faces.
    pub(super) fn faces(&self) -> usize {
        match self {
            Self::Line(line) => line.count() - 1,
            Self::Plane(plane) => plane.faces().iter().sum(),
            Self::Network(network) => network.edges().len(),
        }
    }

    /// The conductances of the inner faces, from the mobility of each cell.
    pub(super) fn conductances(&self, mobility: &[f64], faces: &mut [f64]) {
        match self {
            Self::Line(line) => line.conductances(mobility, faces),
            Self::Plane(plane) => plane.conductances(mobility, faces),
            Self::Network(network) => network.conductances(mobility, faces),
        }
    }

    /// Whether fluid can flow from each cell to each other one.
    pub(super) fn is_connected(&self, faces: &[f64]) -> bool {
        match self {
            Self::Network(network) => network.is_connected(faces),
            _ => faces.iter().all(|&face| face > 0.0),
        }
    }

    /// Adds the volume rates that flow into each cell from the others.
    pub(super) fn add_flow(&self, faces: &[f64], pressure: &[f64], into: &mut [f64]) {
        match self {
            Self::Line(_) => Line::add_flow(faces, pressure, into),
            Self::Plane(plane) => plane.add_flow(faces, pressure, 1.0, into),
            Self::Network(network) => network.add_flow(faces, pressure, 1.0, into),
        }
    }

    /// The number of directions along which fluid flows from cell to cell; 0 without directions.
    pub(super) fn directions(&self) -> usize {
        match self {
            Self::Line(_) => 1,
            Self::Plane(_) => 2,
            Self::Network(_) => 0,
        }
    }

    /// Adds half the volume rate along a direction through each of its faces to each cell.
    pub(super) fn add_half_flow(
        &self,
        direction: usize,
        faces: &[f64],
        pressure: &[f64],
        rates: &mut [f64],
    ) {
        match self {
            Self::Line(_) => Line::add_half_flow(faces, pressure, rates),
            Self::Plane(plane) => plane.add_half_flow(direction, faces, pressure, rates),
            Self::Network(_) => {}
        }
    }

    /// The length of a face across a direction \[m\]; 1 on a line.
    pub(super) fn width(&self, direction: usize) -> f64 {
        match self {
            Self::Line(_) | Self::Network(_) => 1.0,
            Self::Plane(plane) => plane.lengths()[1 - direction],
        }
    }

    /// The word for their kind.
    pub(super) fn kind(&self) -> &'static str {
        match self {
            Self::Line(_) => "line",
            Self::Plane(_) => "plane",
            Self::Network(_) => "network",
        }
    }

    fn place(&self) -> &'static str {
        match self {
            Self::Line(_) => "a position along it",
            Self::Plane(_) => "a position along strike and down dip",
            Self::Network(_) => "cells",
        }
    }

    /// The cell of a place.
    pub(super) fn at(&self, what: &'static str, place: Place) -> Result<usize, DiffusionError> {
        match (self, place) {
            (_, Place::Cell(vertex)) => {
                let cell = self.vertices().iter().position(|&of| of == vertex);
                cell.ok_or_else(|| DiffusionError::Outside {
                    what,
                    position: vec![vertex as f64],
                    begin: vec![0.0],
                    end: vec![self.count() as f64 - 1.0],
                })
            }
            (Self::Line(line), Place::Along(position)) => {
                let [begin, end] = line.ends();
                line.cell_at(position)
                    .ok_or_else(|| DiffusionError::Outside {
                        what,
                        position: vec![position],
                        begin: vec![begin],
                        end: vec![end],
                    })
            }
            (Self::Plane(plane), Place::On(position)) => {
                plane
                    .cell_at(position)
                    .ok_or_else(|| DiffusionError::Outside {
                        what,
                        position: position.to_vec(),
                        begin: plane.ends().map(|ends| ends[0]).to_vec(),
                        end: plane.ends().map(|ends| ends[1]).to_vec(),
                    })
            }
            _ => Err(self.misplaced(what, place.kind())),
        }
    }

    pub(super) fn misplaced(&self, what: &'static str, place: &'static str) -> DiffusionError {
        DiffusionError::Place {
            what,
            place,
            cells: self.kind(),
            instead: self.place(),
        }
    }
}

//! The cells of the fault, and diffusion on them.

use stickslip::bie::{Cells, Rectangles};
use stickslip::fields::{self, Boundary, Diffusion, Hydraulics, Line, Plane, Side, Well};

use super::wells::Place;
use super::{Arguments, Failed, Sides, Zone};
use crate::earthquakes::stations::Station;

/// The largest number of cells.
const MOST: f64 = 1e6;
/// The number of cells along a side by default: one is at the centre.
const BY_DEFAULT: [f64; 2] = [41.0, 201.0];
/// The length of a cell by default, on a plane and on a line \[m\].
const CELL: [f64; 2] = [15.0, 10.0];

/// The cells of a fault.
#[derive(Debug, Clone, Copy)]
pub(super) enum Grid {
    Line(Cells),
    Plane(Rectangles),
}

impl Grid {
    pub(super) fn new(arguments: &Arguments) -> Result<Self, Failed> {
        let geometry = &arguments.geometry;
        let kind = usize::from(geometry.line);
        let cell = geometry.cell.unwrap_or(CELL[kind]);
        let side = |flag: &str, length: Option<f64>| {
            let length = length.unwrap_or(cell * BY_DEFAULT[kind]);
            let count = (length / cell).round();
            if count < 1.0 || (count * cell / length - 1.0).abs() > 1e-9 {
                return Err(Failed::from(format!(
                    "--cell {cell}: {flag} of {length} m is not a whole number of cells"
                )));
            }
            if count > MOST {
                return Err(
                    format!("--cell {cell}: more than {MOST} cells along {length} m").into(),
                );
            }
            Ok(Cells::new([-0.5 * length, 0.5 * length], count as usize)?)
        };
        let along = side("a --length", geometry.length)?;
        if geometry.line {
            return Ok(Self::Line(along));
        }
        let plane = Rectangles::new(along, side("a --width", geometry.width)?);
        if plane.count() as f64 > MOST {
            return Err(format!("--cell {cell}: {} cells, more than {MOST}", plane.count()).into());
        }
        Ok(Self::Plane(plane))
    }

    pub(super) fn count(&self) -> usize {
        match self {
            Self::Line(cells) => cells.count(),
            Self::Plane(cells) => cells.count(),
        }
    }

    /// The length of a cell \[m\].
    pub(super) fn cell(&self) -> f64 {
        match self {
            Self::Line(cells) => cells.length(),
            Self::Plane(cells) => cells.along_strike().length(),
        }
    }

    /// The centre of a cell along strike and down dip \[m\].
    pub(super) fn center(&self, cell: usize) -> [f64; 2] {
        match self {
            Self::Line(cells) => [cells.center(cell), 0.0],
            Self::Plane(cells) => cells.center(cell),
        }
    }

    /// The station at a position, which lies on the fault.
    pub(super) fn station(&self, [x, y]: [f64; 2]) -> Result<Station, Failed> {
        let holds = |cells: &Cells, at: f64| cells.ends()[0] <= at && at <= cells.ends()[1];
        let outside = |range: String| {
            Failed::from(format!(
                "({x}, {y}) m is not on the fault, which reaches {range}"
            ))
        };
        match self {
            Self::Line(cells) if y == 0.0 && holds(cells, x) => {
                let mut station = Station::on_line(cells, x);
                station.position = [x, y];
                Ok(station)
            }
            Self::Line(cells) => {
                let [begin, end] = cells.ends();
                Err(outside(format!("from {begin} m to {end} m along strike")))
            }
            Self::Plane(cells) => {
                let (along, down) = (cells.along_strike(), cells.down_dip());
                if holds(along, x) && holds(down, y) {
                    return Ok(Station::on_plane(cells, [x, y]));
                }
                let ([a, b], [c, d]) = (along.ends(), down.ends());
                Err(outside(format!(
                    "from {a} m to {b} m along strike and from {c} m to {d} m down dip"
                )))
            }
        }
    }

    /// The cell that holds a position, the first of several at an edge.
    pub(super) fn cell_at(&self, at: [f64; 2]) -> Result<usize, Failed> {
        self.station(at)?;
        let place = |cells: &Cells, at: f64| {
            let place = ((at - cells.ends()[0]) / cells.length()).ceil() as usize;
            place.saturating_sub(1).min(cells.count() - 1)
        };
        Ok(match self {
            Self::Line(cells) => place(cells, at[0]),
            Self::Plane(cells) => {
                let (along, down) = (cells.along_strike(), cells.down_dip());
                cells.index([place(along, at[0]), place(down, at[1])])
            }
        })
    }

    /// A position in words.
    pub(super) fn name(&self, [x, y]: [f64; 2]) -> String {
        match self {
            Self::Line(_) => format!("{x} m"),
            Self::Plane(_) => format!("({x}, {y}) m"),
        }
    }

    /// The radius of the circle, or half the length of the line, that so many cells fill \[m\].
    pub(super) fn radius(&self, count: usize) -> f64 {
        match self {
            Self::Line(cells) => 0.5 * count as f64 * cells.length(),
            Self::Plane(cells) => (count as f64 * cells.area() / std::f64::consts::PI).sqrt(),
        }
    }

    /// The cells along strike at a distance down dip, with their positions \[m\].
    pub(super) fn along_strike(&self, y: f64) -> Vec<(usize, f64)> {
        match self {
            Self::Line(cells) => (0..cells.count()).map(|k| (k, cells.center(k))).collect(),
            Self::Plane(cells) => {
                let (along, down) = (cells.along_strike(), cells.down_dip());
                let row = ((y - down.ends()[0]) / down.length()) as usize;
                let row = row.min(down.count() - 1);
                let columns = 0..along.count();
                columns
                    .map(|column| (cells.index([column, row]), along.center(column)))
                    .collect()
            }
        }
    }

    /// Diffusion of the fluid of wells.
    pub(super) fn diffusion(&self, zone: &Zone, wells: &[Place]) -> Result<Diffusion, Failed> {
        let hydraulics = Hydraulics {
            permeability: zone.permeability.into(),
            viscosity: zone.viscosity.into(),
            storage: zone.storage.into(),
            thickness: zone.thickness.into(),
        };
        let sides: &[Side] = match self {
            Self::Line(_) => &[Side::Begin, Side::End],
            Self::Plane(_) => &[Side::Begin, Side::End, Side::Top, Side::Bottom],
        };
        let mut field = match self {
            Self::Line(cells) => {
                Diffusion::new(Line::uniform(cells.ends(), cells.count())?, &hydraulics)?
            }
            Self::Plane(cells) => {
                let sides = [cells.along_strike(), cells.down_dip()];
                let plane = Plane::new(sides.map(Cells::ends), sides.map(Cells::count))?;
                Diffusion::new(plane, &hydraulics)?
            }
        };
        if zone.sides == Sides::Drained {
            for &side in sides {
                field = field.with_side(side, Boundary::Pressure(0.0))?;
            }
        }
        for Place { at, rates } in wells {
            let cell = fields::Place::Cell(self.cell_at(*at)?);
            field = field.with_well(Well::new(cell, rates.clone()))?;
        }
        Ok(field)
    }
}

//! The place of a vertex of a contact.

use std::fmt;

use crate::BoundaryPart;

/// The place of a vertex of a contact, in errors.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct Place {
    /// The vertex of the body.
    pub vertex: usize,
    /// The contact, as in [`Snapshot::contact`](crate::Snapshot::contact): counted from 0.
    pub contact: usize,
    /// The number of the vertex in the contact.
    pub number: usize,
    /// The position \[m\]; `None` if unknown, as at a point.
    pub point: Option<[f64; 3]>,
    /// The number of coordinates of the position.
    pub dimension: usize,
    /// The row and the column, down dip and along strike and counted from 0, in a contact whose cells are a rectangle
    /// of a plane.
    pub cell: Option<[usize; 2]>,
}

impl Place {
    /// The place of vertex number `number` of a contact.
    pub(crate) fn of(part: &BoundaryPart, contact: usize, number: usize) -> Self {
        Self {
            vertex: part.vertices[number],
            contact,
            number,
            point: part.points.get(number).copied(),
            dimension: part.dimension,
            cell: cell(part, number),
        }
    }
}

/// The row and the column of a point among those of a plane of cells, which has no normals.
fn cell(part: &BoundaryPart, number: usize) -> Option<[usize; 2]> {
    let point = part.points.get(number)?;
    if part.dimension != 2 || !part.normals.is_empty() {
        return None;
    }
    let lines = [1, 0].map(|c| {
        let mut values: Vec<f64> = part.points.iter().map(|point| point[c]).collect();
        values.sort_by(f64::total_cmp);
        values.dedup();
        (
            values.iter().position(|&value| value == point[c]),
            values.len(),
        )
    });
    let [(row, rows), (column, columns)] = lines;
    let is_rectangle = rows > 1 && columns > 1 && rows * columns == part.points.len();
    is_rectangle.then_some([row?, column?])
}

/// In one line: "vertex 12 is number 3 of contact(0), at [1.5, 0] m".
impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self {
            vertex,
            contact,
            number,
            ..
        } = self;
        write!(
            f,
            "vertex {vertex} is number {number} of contact({contact})"
        )?;
        if let Some([row, column]) = self.cell {
            write!(f, ", in row {row} and column {column}")?;
        }
        if let Some(point) = &self.point {
            write!(f, ", at {:?} m", &point[..self.dimension.min(3)])?;
        }
        Ok(())
    }
}

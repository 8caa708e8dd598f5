//! The place of a vertex of a contact.

use std::fmt;

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
    /// The angle by which the fault bends there \[degrees\], if its normal stress follows slip; `None` where it is straight.
    /// At sharp bends normal stress grows as the inverse length of cells: spread them over many cells.
    pub bend: Option<f64>,
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
        if let Some(bend) = self.bend {
            write!(f, ", where the fault bends by {bend:.3} degrees")?;
        }
        Ok(())
    }
}

//! The place of a vertex of a contact.

use crate::BoundaryPart;
use crate::error::Place;

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
            bend: None,
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

//! Sheets of triangles, and the side to which their normals point.

use super::super::SurfaceError;
use super::adjacency::Neighbors;

/// The share of a sheet's area below which its mean normal counts as horizontal.
const VERTICAL: f64 = 1e-6;

/// The sheet of each triangle, and whether its corners are to be taken in the other order.
pub(super) struct Orientation {
    pub(super) sheets: Vec<usize>,
    pub(super) flipped: Vec<bool>,
}

/// Walks over edges, so that neighbours agree. Then the normal of each sheet is up on average, or that of its largest
/// triangle if the sheet is vertical. `areas` are the vectors of triangles as they are.
pub(super) fn orient(
    points: &[[f64; 3]],
    triangles: &[[usize; 3]],
    neighbors: &[Neighbors],
    areas: &[nalgebra::Vector3<f64>],
) -> Result<Orientation, SurfaceError> {
    let count = triangles.len();
    let mut found = Orientation {
        sheets: vec![usize::MAX; count],
        flipped: vec![false; count],
    };
    let mut sheet = 0;
    for first in 0..count {
        if found.sheets[first] != usize::MAX {
            continue;
        }
        found.sheets[first] = sheet;
        let mut cells = vec![first];
        let mut next = 0;
        while let Some(&cell) = cells.get(next) {
            next += 1;
            for k in 0..3 {
                let Some(other) = neighbors[cell][k] else {
                    continue;
                };
                let edge = [triangles[cell][k], triangles[cell][(k + 1) % 3]];
                let flipped = found.flipped[cell] ^ runs_along(&triangles[other], edge);
                if found.sheets[other] == usize::MAX {
                    found.sheets[other] = sheet;
                    found.flipped[other] = flipped;
                    cells.push(other);
                } else if found.flipped[other] != flipped {
                    return Err(SurfaceError::NotOrientable {
                        triangles: [cell, other],
                        edge: edge.map(|vertex| points[vertex]),
                    });
                }
            }
        }
        turn_up(&cells, areas, &mut found.flipped);
        sheet += 1;
    }
    Ok(found)
}

/// Whether a triangle runs along an edge in this direction.
fn runs_along(corners: &[usize; 3], [a, b]: [usize; 2]) -> bool {
    (0..3).any(|k| corners[k] == a && corners[(k + 1) % 3] == b)
}

/// Turns a sheet over if its normal is down.
fn turn_up(cells: &[usize], areas: &[nalgebra::Vector3<f64>], flipped: &mut [bool]) {
    let (mut up, mut area, mut largest) = (0.0, 0.0, (0.0, false));
    for &cell in cells {
        let own = areas[cell].norm();
        up += if flipped[cell] {
            -areas[cell].z
        } else {
            areas[cell].z
        };
        area += own;
        if own > largest.0 {
            largest = (own, flipped[cell]);
        }
    }
    let down = if up.abs() < VERTICAL * area {
        largest.1
    } else {
        up < 0.0
    };
    if down {
        cells
            .iter()
            .for_each(|&cell| flipped[cell] = !flipped[cell]);
    }
}

//! Faces of the boundary: those of exactly one cell.

use crate::FemError;

/// The boundary faces of the cells of D + 1 positively ordered vertices, each ordered so that its normal
/// points outward.
///
/// The two cells of an inner face give it opposite orientations: an odd and an even order of its vertices. Otherwise
/// both lie on one side of it, and the mesh is folded there.
pub(crate) fn boundary_faces<const D: usize>(cells: &[u32]) -> Result<Vec<[u32; D]>, FemError> {
    // The orientation is in the last bit of the place.
    let mut faces: Vec<([u32; D], usize)> = (0..cells.len())
        .map(|index| {
            let mut key = face(cells, index);
            let odd = sort(&mut key);
            (key, 2 * index + usize::from(odd))
        })
        .collect();
    faces.sort_unstable();
    let mut boundary = Vec::new();
    for shared in faces.chunk_by(|a, b| a.0 == b.0) {
        match shared {
            [(_, place)] => boundary.push(face(cells, place / 2)),
            [(_, first), (_, second)] if first % 2 != second % 2 => {}
            folded => return Err(fold(cells, folded)),
        }
    }
    Ok(boundary)
}

/// Sorts the vertices of a face. Returns whether that takes an odd number of exchanges.
#[inline]
fn sort<const D: usize>(face: &mut [u32; D]) -> bool {
    let mut order = |i: usize, j: usize| {
        let (a, b) = (face[i], face[j]);
        (face[i], face[j]) = (a.min(b), a.max(b));
        a > b
    };
    if D == 2 {
        order(0, 1)
    } else {
        order(0, 1) ^ order(1, 2) ^ order(0, 1)
    }
}

/// The error for cells at one face, more than one on one of its sides.
fn fold<const D: usize>(cells: &[u32], shared: &[([u32; D], usize)]) -> FemError {
    let mut at_face: Vec<usize> = shared
        .iter()
        .map(|(_, place)| place / 2 / (D + 1))
        .collect();
    at_face.sort_unstable();
    let corners = |cell: usize| {
        let mut corners = cells[cell * (D + 1)..(cell + 1) * (D + 1)].to_vec();
        corners.sort_unstable();
        corners
    };
    for (k, &first) in at_face.iter().enumerate() {
        for &second in &at_face[k + 1..] {
            if corners(first) == corners(second) {
                return FemError::repeated("cells", [first, second]);
            }
        }
    }
    FemError::FoldedCells {
        cells: at_face,
        face: shared[0].0.to_vec(),
    }
}

/// The face opposite to the vertex at this position of the list of cells.
pub(crate) fn face<const D: usize>(cells: &[u32], index: usize) -> [u32; D] {
    let (cell, opposite) = (index / (D + 1), index % (D + 1));
    let mut face = std::array::from_fn(|k| cells[cell * (D + 1) + k + usize::from(k >= opposite)]);
    if opposite % 2 == 1 {
        face.swap(D - 2, D - 1);
    }
    face
}

/// The children of a face under red refinement, in the same orientation; `vertex` and `midpoint` number the vertices of
/// the refined mesh.
pub(crate) fn split_face<const D: usize>(
    face: [u32; D],
    vertex: impl Fn(u32) -> u32,
    midpoint: impl Fn(u32, u32) -> u32,
) -> impl Iterator<Item = [u32; D]> {
    const SEGMENTS: &[&[(usize, usize)]] = &[&[(0, 0), (0, 1)], &[(0, 1), (1, 1)]];
    const TRIANGLES: &[&[(usize, usize)]] = &[
        &[(0, 0), (0, 1), (0, 2)],
        &[(0, 1), (1, 1), (1, 2)],
        &[(0, 2), (1, 2), (2, 2)],
        &[(0, 1), (1, 2), (0, 2)],
    ];
    let parts = if D == 2 { SEGMENTS } else { TRIANGLES };
    parts.iter().map(move |part| {
        std::array::from_fn(|k| {
            let (i, j) = part[k];
            if i == j {
                vertex(face[i])
            } else {
                midpoint(face[i], face[j])
            }
        })
    })
}

//! Faces of the boundary: those of exactly one cell.

use crate::FemError;

/// The boundary faces of the cells of D + 1 positively ordered vertices, each ordered so that its normal
/// points outward.
pub(crate) fn boundary_faces<const D: usize>(cells: &[u32]) -> Result<Vec<[u32; D]>, FemError> {
    let corners = D + 1;
    let mut faces: Vec<([u32; D], usize)> = (0..cells.len())
        .map(|index| {
            let mut key = face(cells, index);
            key.sort_unstable();
            (key, index)
        })
        .collect();
    faces.sort_unstable();
    let mut boundary = Vec::new();
    for shared in faces.chunk_by(|a, b| a.0 == b.0) {
        match shared {
            [(_, index)] => boundary.push(face(cells, *index)),
            [_, _] => {}
            more => {
                return Err(FemError::OverlappingCells {
                    cell: more[0].1 / corners,
                });
            }
        }
    }
    Ok(boundary)
}

/// The face opposite to the vertex at this place of the list of cells.
fn face<const D: usize>(cells: &[u32], index: usize) -> [u32; D] {
    let (cell, opposite) = (index / (D + 1), index % (D + 1));
    let mut face = std::array::from_fn(|k| cells[cell * (D + 1) + k + usize::from(k >= opposite)]);
    if opposite % 2 == 1 {
        face.swap(D - 2, D - 1);
    }
    face
}

/// The parts that red refinement makes of a face, in the same orientation; `vertex` and `midpoint` number
/// the vertices of the refined mesh.
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

//! Feature of a vertex: the interior, a face, an edge or a corner of the body.

use nalgebra::Matrix3;

use crate::Mesh;
use crate::simplex::face_normal;

/// The share of the squared normals around a vertex from which they count as different: planes with an angle of more
/// than 26 degrees.
const BENT: f64 = 0.05;

/// The number of independent normals of the boundary at each vertex: 0 in the interior, 1 on a smooth part of the
/// boundary, and so on up to D at a corner.
pub(super) fn features<const D: usize>(mesh: &Mesh<D>) -> Vec<u8> {
    // The mean of n n^T over the faces at a vertex, by area; without a third component where there is none.
    let mut moments = vec![Matrix3::<f64>::zeros(); mesh.vertex_count()];
    for face in mesh.boundary() {
        let normal = face_normal(&face.map(|p| mesh.vertices()[p as usize]));
        let area = normal.norm();
        for &p in face {
            for r in 0..D {
                for c in 0..D {
                    moments[p as usize][(r, c)] += normal[r] * normal[c] / area;
                }
            }
        }
    }
    let count = |moment: &Matrix3<f64>| {
        let shares = moment.symmetric_eigenvalues();
        let limit = BENT * moment.trace();
        shares.iter().filter(|&&share| share > limit).count() as u8
    };
    moments.iter().map(count).collect()
}

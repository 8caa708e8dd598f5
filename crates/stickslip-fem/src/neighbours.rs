//! Which vertices of a mesh act on a part of its boundary.

use crate::Mesh;

/// The cosine of an angle that is a right one up to rounding.
const RIGHT: f64 = 1e-9;

/// The pairs of vertices, at least one of them among `vertices`, that a Laplacian couples:
///
/// ```text
/// integral of grad phi_p . grad phi_q != 0
/// ```
///
/// Opposite the right angles of a grid the integral is zero; an operator need not keep an entry there.
pub(crate) fn neighbours<const D: usize>(mesh: &Mesh<D>, vertices: &[usize]) -> Vec<[u32; 2]> {
    let mut there = vec![false; mesh.vertex_count()];
    for &vertex in vertices {
        there[vertex] = true;
    }
    let mut terms = Vec::new();
    for cell in mesh.cells() {
        if !cell.iter().any(|&p| there[p as usize]) {
            continue;
        }
        let simplex = mesh.simplex(cell);
        for (i, &p) in cell.iter().enumerate() {
            for (j, &q) in cell.iter().enumerate() {
                if p < q && (there[p as usize] || there[q as usize]) {
                    let (one, other) = (&simplex.gradients[i], &simplex.gradients[j]);
                    let size = simplex.volume * one.norm() * other.norm();
                    terms.push(([p, q], simplex.volume * one.dot(other), size));
                }
            }
        }
    }
    terms.sort_unstable_by_key(|(pair, ..)| *pair);
    (terms.chunk_by(|(one, ..), (other, ..)| one == other))
        .filter(|terms| {
            let sum: f64 = terms.iter().map(|(_, term, _)| term).sum();
            let size: f64 = terms.iter().map(|(.., size)| size).sum();
            sum.abs() > RIGHT * size
        })
        .map(|terms| terms[0].0)
        .collect()
}

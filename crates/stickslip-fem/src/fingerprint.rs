//! Fingerprints of meshes.

use nalgebra::SVector;

use crate::{FemError, Mesh};

/// A hash of vertices and cells: each word in turn is mixed in by a folded product with an odd constant (2^64 over the
/// golden ratio). Source: Wang Yi, wyhash (2019).
pub(crate) fn fingerprint<const D: usize>(vertices: &[SVector<f64, D>], cells: &[u32]) -> u64 {
    const FACTOR: u64 = 0x9e37_79b9_7f4a_7c15;
    let mix = |hash: u64, word: u64| {
        let product = u128::from(hash ^ word) * u128::from(FACTOR);
        // The sum keeps a zero from absorbing what follows.
        (product as u64 ^ (product >> 64) as u64).wrapping_add(FACTOR)
    };
    // -0 equals 0, and is it after the addition.
    let coordinates = vertices.iter().flatten().map(|x| (x + 0.0).to_bits());
    let hash = coordinates.fold(vertices.len() as u64, mix);
    cells.iter().map(|&p| u64::from(p)).fold(hash, mix)
}

/// The name of a trace in errors.
pub(crate) const PART: &str = "part of the boundary";

/// The identity of a mesh: its size, and its [fingerprint](Mesh::fingerprint). Parts and matrices have that of their
/// mesh.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct MeshIdentity {
    /// The number of vertices.
    pub vertices: usize,
    /// The number of cells.
    pub cells: usize,
    /// The hash of vertices and cells.
    pub fingerprint: u64,
}

impl<const D: usize> Mesh<D> {
    /// The identity by which parts, matrices and solvers are matched with this mesh.
    pub fn identity(&self) -> MeshIdentity {
        MeshIdentity {
            vertices: self.vertex_count(),
            cells: self.cell_count(),
            fingerprint: self.fingerprint(),
        }
    }
}

/// Refuses data of another mesh.
pub(crate) fn same_mesh(
    what: &'static str,
    expected: MeshIdentity,
    found: MeshIdentity,
) -> Result<(), FemError> {
    if expected == found {
        return Ok(());
    }
    Err(FemError::Mesh {
        what,
        expected,
        found,
    })
}

/// The difference in size of two meshes, if any.
pub(crate) fn other_mesh(expected: &MeshIdentity, found: &MeshIdentity) -> String {
    let (vertices, cells) = (found.vertices, found.cells);
    if (expected.vertices, expected.cells) == (vertices, cells) {
        return format!("of as many vertices ({vertices}) and cells ({cells}) at other places");
    }
    format!(
        "of {vertices} vertices and {cells} cells, that at hand has {} and {}",
        expected.vertices, expected.cells
    )
}

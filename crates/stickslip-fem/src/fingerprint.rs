//! Fingerprints of meshes.

use nalgebra::SVector;

use crate::{FemError, MeshIdentity};

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

//! Which mesh is meant.

use std::hash::{DefaultHasher, Hash, Hasher};

use nalgebra::SVector;

use crate::FemError;

/// A hash of what a mesh is made of.
pub(crate) fn fingerprint<const D: usize>(vertices: &[SVector<f64, D>], cells: &[u32]) -> u64 {
    let mut hasher = DefaultHasher::new();
    for x in vertices {
        for coordinate in x {
            // -0 equals 0, and is it after the addition.
            (coordinate + 0.0).to_bits().hash(&mut hasher);
        }
    }
    cells.hash(&mut hasher);
    hasher.finish()
}

/// Refuses a part of the boundary of another mesh.
pub(crate) fn same_mesh(expected: u64, found: u64) -> Result<(), FemError> {
    if expected == found {
        Ok(())
    } else {
        Err(FemError::OtherMesh { expected, found })
    }
}

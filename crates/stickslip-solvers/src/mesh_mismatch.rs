use thiserror::Error;

use crate::MeshId;

/// A mesh mismatch: a part of a problem belongs to another mesh, possibly one of equal size, or to another reduced
/// body.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("{what} belongs to another mesh, fault or reduced body than the scene, {}: make both from one space or fault", other_mesh(.expected, .found))]
#[non_exhaustive]
pub struct MeshMismatch {
    /// The part: "contact 2", "mass matrix", "solver".
    pub what: String,
    /// The mesh of the body: the given one, or that of the first matrix or part that has one.
    pub expected: MeshId,
    /// The mesh of the part.
    pub found: MeshId,
}

/// The sizes of two meshes.
fn other_mesh(expected: &MeshId, found: &MeshId) -> String {
    if (expected.vertices, expected.elements) == (found.vertices, found.elements) {
        return format!("also of {found}");
    }
    format!("of {found}, and the scene has {expected}")
}

impl MeshMismatch {
    /// The mismatch of two meshes.
    pub fn new(what: impl ToString, expected: impl Into<MeshId>, found: impl Into<MeshId>) -> Self {
        Self {
            what: what.to_string(),
            expected: expected.into(),
            found: found.into(),
        }
    }

    /// Accepts equal meshes, or an unknown one.
    ///
    /// # Errors
    ///
    /// [`MeshMismatch`] for different meshes.
    pub fn check(
        what: impl ToString,
        expected: Option<MeshId>,
        found: Option<MeshId>,
    ) -> Result<(), Self> {
        match (expected, found) {
            (Some(expected), Some(found)) if expected != found => {
                Err(Self::new(what, expected, found))
            }
            _ => Ok(()),
        }
    }
}

use thiserror::Error;

/// A mesh mismatch: a part of a problem belongs to another mesh, possibly one of equal size, or to another reduced
/// body. Both are identified by their fingerprints.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("{what} belongs to another mesh or reduced body than the scene: make both from one space")]
#[non_exhaustive]
pub struct MeshMismatch {
    /// The part: "contact 2", "mass matrix", "solver".
    pub what: String,
    /// The fingerprint of the body's mesh: the given one, or that of the first matrix or part that has one.
    pub expected: u64,
    /// The fingerprint of the part's own mesh.
    pub found: u64,
}

impl MeshMismatch {
    /// The mismatch of two fingerprints.
    pub fn new(what: impl ToString, expected: u64, found: u64) -> Self {
        Self {
            what: what.to_string(),
            expected,
            found,
        }
    }

    /// Accepts equal fingerprints, or an unknown one.
    ///
    /// # Errors
    ///
    /// [`MeshMismatch`] for different fingerprints.
    pub fn check(
        what: impl ToString,
        expected: Option<u64>,
        found: Option<u64>,
    ) -> Result<(), Self> {
        match (expected, found) {
            (Some(expected), Some(found)) if expected != found => {
                Err(Self::new(what, expected, found))
            }
            _ => Ok(()),
        }
    }
}

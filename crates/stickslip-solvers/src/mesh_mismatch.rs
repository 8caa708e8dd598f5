use thiserror::Error;

/// Something that belongs to another mesh than the rest of a problem, maybe one of equal size, or to another reduced
/// body; both are known by their fingerprints.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("{what} belongs to another mesh or reduced body than the scene: make both from one space")]
#[non_exhaustive]
pub struct MeshMismatch {
    /// What it is: "contact 2", "mass matrix", "solver".
    pub what: String,
    /// The fingerprint of the body's mesh: that which was given, or that of the first matrix or part that has one.
    pub expected: u64,
    /// The fingerprint of its own mesh.
    pub found: u64,
}

impl MeshMismatch {
    /// Of something with two fingerprints.
    pub fn new(what: impl ToString, expected: u64, found: u64) -> Self {
        Self {
            what: what.to_string(),
            expected,
            found,
        }
    }

    /// Passes fingerprints that are the same, or of which one is unknown.
    ///
    /// # Errors
    ///
    /// [`MeshMismatch`] otherwise.
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

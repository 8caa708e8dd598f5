//! What can go wrong when a run is recorded.

use thiserror::Error;

/// A recorder that cannot be made, or that cannot write.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum RecordError {
    /// A row cannot be written.
    #[error("cannot write what was recorded: {0}")]
    Write(#[from] std::io::Error),
    /// A vertex that the body does not have.
    #[error("no vertex {vertex}: the body has {count}")]
    Vertex {
        /// The vertex asked for.
        vertex: usize,
        /// How many there are.
        count: usize,
    },
    /// A contact that the scene does not have.
    #[error("no contact {contact}: the scene has {count}")]
    Contact {
        /// The contact asked for, counted from 0.
        contact: usize,
        /// How many there are.
        count: usize,
    },
    /// A mesh, or a part of its boundary, that is not the one recorded.
    #[cfg(feature = "vtk")]
    #[error("{what}: {expected} vertices expected, {found} found")]
    Mesh {
        /// What was given.
        what: &'static str,
        /// The vertices of the body or of the contact.
        expected: usize,
        /// Those found.
        found: usize,
    },
    /// Another mesh, or a part of another one's boundary, maybe of equal size.
    #[cfg(feature = "vtk")]
    #[error("{what} of mesh {found:016x}, the body lies on {expected:016x}")]
    OtherMesh {
        /// What was given.
        what: &'static str,
        /// The fingerprint of the body's mesh.
        expected: u64,
        /// The one found.
        found: u64,
    },
    /// A part of the boundary with other vertices than the contact.
    #[cfg(feature = "vtk")]
    #[error("trace: contact {contact} has vertex {expected} where it has {found}")]
    Place {
        /// The contact, counted from 0.
        contact: usize,
        /// A vertex of the contact.
        expected: usize,
        /// The vertex in its place.
        found: usize,
    },
    /// A file that cannot be written.
    #[cfg(feature = "vtk")]
    #[error("cannot write {}: {source}", .path.display())]
    File {
        /// Where it was to be.
        path: std::path::PathBuf,
        /// Why not.
        source: vtkio::Error,
    },
    /// The stress cannot be computed.
    #[cfg(feature = "vtk")]
    #[error("stress: {0}")]
    Stress(#[from] stickslip_fem::FemError),
    /// A setting out of its range.
    #[error("{what} must be {requirement}, is {value:e}")]
    Setting {
        /// What was given.
        what: &'static str,
        /// What holds for a legal value.
        requirement: &'static str,
        /// The value.
        value: f64,
    },
}

/// Refuses a setting out of its range.
pub(super) fn require(
    what: &'static str,
    requirement: &'static str,
    value: f64,
    legal: bool,
) -> Result<(), RecordError> {
    if legal {
        return Ok(());
    }
    Err(RecordError::Setting {
        what,
        requirement,
        value,
    })
}

/// Refuses a number that is not positive and finite.
pub(super) fn positive(what: &'static str, value: f64) -> Result<(), RecordError> {
    let legal = value > 0.0 && value.is_finite();
    require(what, "positive and finite", value, legal)
}

/// Refuses a vertex that is none.
pub(super) fn check_vertex(vertex: usize, count: usize) -> Result<(), RecordError> {
    if vertex < count {
        return Ok(());
    }
    Err(RecordError::Vertex { vertex, count })
}

/// Refuses a contact that is none.
pub(super) fn check_contact(contact: usize, count: usize) -> Result<(), RecordError> {
    if contact < count {
        return Ok(());
    }
    Err(RecordError::Contact { contact, count })
}

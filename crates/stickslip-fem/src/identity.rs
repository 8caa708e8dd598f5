//! What data are matched with their mesh by.

/// The identity of a mesh: its size, and its [fingerprint](crate::Mesh::fingerprint). Parts and matrices have that of their
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

use std::fmt;

/// The identity of a mesh, of the cells of a fault, or of a reduced body: its size, and a fingerprint by which meshes of
/// equal size are told apart.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct MeshId {
    /// The number of vertices.
    pub vertices: usize,
    /// The number of elements, for a mesh of finite elements.
    pub elements: Option<usize>,
    /// A hash of the vertices and elements.
    pub fingerprint: u64,
}

impl fmt::Display for MeshId {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "{} vertices", self.vertices)?;
        match self.elements {
            Some(elements) => write!(formatter, " and {elements} elements"),
            None => Ok(()),
        }
    }
}

#[cfg(feature = "fem")]
impl From<stickslip_fem::MeshIdentity> for MeshId {
    fn from(mesh: stickslip_fem::MeshIdentity) -> Self {
        Self {
            vertices: mesh.vertices,
            elements: Some(mesh.cells),
            fingerprint: mesh.fingerprint,
        }
    }
}

use thiserror::Error;

/// Errors in naming a surface inside a mesh and in splitting the mesh along it.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum SurfaceError {
    /// A face of the surface does not belong to exactly two cells: it lies on the boundary, or is no face of the mesh.
    #[error(
        "face {index} of the surface {surface:?}, of vertices {face:?}, is not inside the body: it belongs to {cells} \
         cells{}",
        if *cells == 1 { "; on the boundary name a part" } else { "" }
    )]
    NotInside {
        /// Name of the surface.
        surface: String,
        /// Position of the face in the list.
        index: usize,
        /// The vertices of the face.
        face: Vec<u32>,
        /// The number of cells that it belongs to.
        cells: usize,
    },
    /// More than two faces of a surface meet at one vertex (D = 2) or edge (D = 3), or the surface touches itself, an
    /// earlier fault or the boundary of the body at a vertex.
    #[error(
        "the surface {surface:?} is not a manifold: {faces} of its faces meet at the vertices {vertices:?}, near {at:?}; \
         name its branches as surfaces of their own, and split the through-going one first"
    )]
    NotManifold {
        /// Name of the surface.
        surface: String,
        /// The number of its faces there.
        faces: usize,
        /// The vertex, or the two of the edge.
        vertices: Vec<u32>,
        /// The position, the midpoint of an edge \[m\].
        at: Vec<f64>,
    },
    /// A surface is one-sided, as a Moebius strip is: it has no plus and minus side.
    #[error(
        "the surface {surface:?} is one-sided (non-orientable): sides are exchanged on a path around it through the \
         vertices {vertices:?}, near {at:?}; name parts of it as surfaces of their own"
    )]
    OneSided {
        /// Name of the surface.
        surface: String,
        /// The vertex or edge at which the sides of neighbouring faces disagree.
        vertices: Vec<u32>,
        /// The position, the midpoint of an edge \[m\].
        at: Vec<f64>,
    },
    /// All vertices of a connected part of a surface lie at its edge inside the body: no vertex is doubled, and it
    /// cannot slip anywhere.
    #[error(
        "the surface {surface:?} opens nowhere: all vertices of its {faces} faces around {at:?} are at its edge; refine \
         the mesh before it is split"
    )]
    OpensNowhere {
        /// Name of the surface.
        surface: String,
        /// The number of faces of this connected part.
        faces: usize,
        /// The midpoint of one of them \[m\].
        at: Vec<f64>,
    },
}

//! How the cells of a mesh are cut next.

/// The marks for further cuts of a mesh.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Marks {
    /// Without bisected cells: the cells that red refinement takes with their first two vertices exchanged, see
    /// `refine`.
    Reflected(Vec<bool>),
    /// The first two vertices of each cell are the ends of the edge to be halved.
    Bisected(Vec<Tag>),
}

/// The data of a tetrahedron about its faces besides the order of its corners; nothing in a triangle.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Tag {
    /// The corner opposite to the marked edge in the face of corners 0, 2, 3 and in that of 1, 2, 3.
    pub(crate) opposite: [u8; 2],
    /// Distinguishes the second bisection from the first, in which the marked edges are in one plane.
    pub(crate) flagged: bool,
}

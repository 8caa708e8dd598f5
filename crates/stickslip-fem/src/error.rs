use thiserror::Error;

use crate::MeshIdentity;
use crate::identity::other_mesh;

/// Errors in building a mesh, a space or an operator.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum FemError {
    /// A parameter is out of its range.
    #[error(
        "{what} must be {requirement}, is {value:?}{}",
        cell.map_or_else(String::new, |cell| format!(" in cell {cell}"))
    )]
    Value {
        /// The parameter, with its unit: "Young's modulus \[Pa\]".
        what: &'static str,
        /// The requirement of a legal value.
        requirement: &'static str,
        /// The value.
        value: f64,
        /// Index of the cell of the parameter, if it depends on the cell.
        cell: Option<usize>,
    },
    /// A list has the wrong length.
    #[error("{found} {what}, expected {expected}")]
    Length {
        /// The entries of the list: "vectors of a field on the mesh".
        what: &'static str,
        /// The length that fits.
        expected: usize,
        /// The length given.
        found: usize,
    },
    /// A collection is empty: the cells of a mesh, samples, the faces of a trace, or a named group.
    #[error("no {what}{}", if name.is_empty() { String::new() } else { format!(" {name:?}") })]
    Empty {
        /// The missing members: "cells", "samples", "faces of the boundary that satisfy the predicate" or "members of
        /// the group".
        what: &'static str,
        /// The name of the group, else empty.
        name: String,
    },
    /// A vertex or a sample violates a requirement: finite coordinates or values, or a cell at each vertex, without
    /// which its row of every operator would vanish.
    #[error("{what} {index} must have {requirement}")]
    Point {
        /// The point: "vertex" or "sample".
        what: &'static str,
        /// Its index.
        index: usize,
        /// The requirement.
        requirement: &'static str,
    },
    /// A cell or a material refers to something that does not exist.
    #[error("{by} names {what} {index}, the mesh has {count}")]
    OutOfRange {
        /// The reference: "vertex" or "cell".
        what: &'static str,
        /// The index referred to.
        index: usize,
        /// The number of existing ones.
        count: usize,
        /// The referring item, as "cell 3" or `material "granite"`.
        by: String,
    },
    /// A cell is flat up to rounding, or its vertices are in the wrong order. In a refined mesh new vertices of the
    /// boundary were moved so far that a child of the cell is inverted or flat.
    #[error(
        "{}cell {cell}{} is inverted or degenerate: volume {volume:?}",
        if level.is_some() { "a part of " } else { "" },
        level.map_or_else(String::new, |level| format!(" of level {level}"))
    )]
    DegenerateCell {
        /// Level of the refined mesh, 0 the coarsest; `None` for a cell of a mesh itself.
        level: Option<usize>,
        /// Index of the cell, that of the parent on that level.
        cell: usize,
        /// The signed volume of the cell or child [m^D].
        volume: f64,
    },
    /// Two cells lie on the same side of their common face and overlap; with more than two cells at one face some
    /// always do.
    #[error("cells {cells:?} overlap: at the face of vertices {face:?} two lie on one side")]
    FoldedCells {
        /// Indices of the cells that share the face, increasing.
        cells: Vec<usize>,
        /// The vertices of the face, increasing.
        face: Vec<u32>,
    },
    /// Two cells have the same vertices, two samples the same point, or a named group lists a face or a cell twice.
    #[error(
        "{what} {} and {}{} are the same",
        .places[0],
        .places[1],
        if name.is_empty() { String::new() } else { format!(" of {name:?}") }
    )]
    Repeated {
        /// The items: "cells", "samples", "faces of the part" or "cells of the material".
        what: &'static str,
        /// Their positions in the list.
        places: [usize; 2],
        /// The name of the group, else empty.
        name: String,
    },
    /// Two parts of the boundary or surfaces, two groups of cells or two values have one name.
    #[error("the name {name:?} is there twice")]
    RepeatedName {
        /// The name.
        name: String,
    },
    /// The number of vertices of a mesh or blocks of a matrix exceeds `u32`.
    #[error("at least {count} {what} are too many: they are numbered by 32 bits")]
    TooMany {
        /// The items: "vertices" or "blocks of a matrix".
        what: &'static str,
        /// A lower bound for their number, saturating.
        count: u64,
    },
    /// More vertices than a mesh may have.
    #[error(
        "the mesh would have {count} vertices or more, above the limit of {most}: take larger cells"
    )]
    AboveLimit {
        /// A lower bound for their number.
        count: u64,
        /// The limit.
        most: u32,
    },
    /// A cell size is illegal: it must be finite, and not so small that rounding of coordinates changes shapes.
    #[error("size {value:?} m of cells at {at:?} is not finite or below {least:?} m")]
    CellSize {
        /// The size \[m\].
        value: f64,
        /// The position \[m\].
        at: Vec<f64>,
        /// The least size, 2^-32 of the largest coordinate \[m\].
        least: f64,
    },
    /// Cells still exceed their size: moving new vertices of the boundary makes cells grow.
    #[error("cells exceed their size after {rounds} rounds of bisection")]
    SizeNotReached {
        /// Number of rounds, each of which bisects the cells that exceed it most.
        rounds: usize,
    },
    /// A new vertex of the boundary was moved too far. It may move by half of the edge that it halves: then the edge's
    /// children are not longer than the edge.
    #[error(
        "the midpoint {at:?} of an edge of {edge:?} m, cut from level {level}, is moved by {by:?} m, more than half of it"
    )]
    MovedAway {
        /// Level of the refined mesh, 0 the coarsest.
        level: usize,
        /// The position of the vertex before the move \[m\].
        at: Vec<f64>,
        /// The length of the edge \[m\].
        edge: f64,
        /// The distance of the move \[m\]; not finite if the new position is not.
        by: f64,
    },
    /// A face of a named part does not belong to exactly one cell: it lies inside the body, or is no face of it.
    #[error(
        "face {index} of the part {part:?}, of vertices {face:?}, is not on the boundary: it belongs to {cells} cells"
    )]
    NotOnBoundary {
        /// Name of the part.
        part: String,
        /// Position of the face in the list.
        index: usize,
        /// The vertices of the face.
        face: Vec<u32>,
        /// The number of cells that it belongs to.
        cells: usize,
    },
    /// No part of the boundary, surface or group of cells has this name.
    #[error("no {what} is called {name:?}; there are {known:?}")]
    Unknown {
        /// The item: "part of the boundary", "surface inside the body" or "material".
        what: &'static str,
        /// The requested name.
        name: String,
        /// The existing names.
        known: Vec<String>,
    },
    /// Values are given by names of materials, and a cell has none or two of them.
    #[error(
        "cell {cell} of the materials {materials:?} has {values} values by their names, must have 1"
    )]
    CellValues {
        /// Index of the cell.
        cell: usize,
        /// The number of its values.
        values: usize,
        /// Without a value the first named group of the cell, if any; with two those of the values.
        materials: Vec<String>,
    },
    /// The samples are neither on a full grid nor on a line, as linear interpolation requires.
    #[error(
        "{samples} samples with {along:?} different coordinates along the axes are neither a full grid nor on a line: \
         take the nearest"
    )]
    Scattered {
        /// Number of samples.
        samples: usize,
        /// Different coordinates along each axis.
        along: Vec<usize>,
    },
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
    /// More than two faces of one sheet of a surface meet at one vertex (D = 2) or edge (D = 3), or the surface touches
    /// itself, an earlier fault or the boundary of the body at a vertex.
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
    /// Two of the surfaces along which a mesh is to be split have a face in common.
    #[error(
        "the surfaces {:?} and {:?} overlap: both have the face of vertices {face:?} at {at:?}; leave it to one of them",
        .surfaces[0],
        .surfaces[1]
    )]
    Overlap {
        /// Names of the surfaces.
        surfaces: [String; 2],
        /// The vertices of the first common face, increasing.
        face: Vec<u32>,
        /// Its midpoint \[m\].
        at: Vec<f64>,
    },
    /// A surface begins where an earlier one ended at a tip, which stays closed: both are one fault.
    #[error(
        "the surface {surface:?} continues {earlier:?} at the vertices {vertices:?}, near {at:?}, along which the mesh \
         has been split before; split it along both at once, by `split_all`"
    )]
    Continues {
        /// Name of the surface.
        surface: String,
        /// Name of the earlier one.
        earlier: String,
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
        /// Name of the surface, or of all that continue one another.
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
    /// A part of the boundary or a matrix belongs to another mesh, possibly one of equal size.
    #[error("the {what} belongs to another mesh, {}; make both from one space", other_mesh(.expected, .found))]
    Mesh {
        /// The part or matrix.
        what: &'static str,
        /// The mesh at hand.
        expected: MeshIdentity,
        /// Its own mesh.
        found: MeshIdentity,
    },
}

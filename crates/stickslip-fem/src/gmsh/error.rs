use std::fmt;
use std::io;
use std::path::PathBuf;

use thiserror::Error;

use crate::FemError;

/// Where in a file something is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Place {
    /// The line of a text, from 1.
    Line(usize),
    /// The offset in a binary file, from 0.
    Byte(usize),
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Line(line) => write!(f, "line {line}"),
            Self::Byte(byte) => write!(f, "byte {byte}"),
        }
    }
}

/// Why a file of Gmsh is no mesh. Nodes, elements and groups are meant by their numbers in the file.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum GmshError {
    /// The file cannot be read.
    #[error("cannot read {}: {source}", .path.display())]
    Read {
        /// Where it was to be.
        path: PathBuf,
        /// Why not.
        source: io::Error,
    },
    /// The file does not begin as a mesh of Gmsh does.
    #[error("not a mesh of Gmsh: the file does not begin with $MeshFormat")]
    NotGmsh,
    /// Another version of the format.
    #[error(
        "version {version} of the format is not read: save as version 4.1 or 2.2, Mesh.MshFileVersion = 4.1"
    )]
    Version {
        /// The version.
        version: f64,
    },
    /// Numbers of another size.
    #[error("numbers of {size} bytes are not read: the file must come from a program of 64 bits")]
    DataSize {
        /// Size of a number \[byte\].
        size: i32,
    },
    /// A binary file tells the order of its bytes by the number one, and it does not.
    #[error("the order of bytes is unknown: {found:?} is the number one in neither")]
    Endianness {
        /// What stands in its place.
        found: [u8; 4],
    },
    /// The file ends too early.
    #[error("{at}: the file ends where {expected} was expected")]
    Ended {
        /// What was to follow.
        expected: &'static str,
        /// Where it ends.
        at: Place,
    },
    /// Something else was to be there.
    #[error("{at}: found \"{found}\" in place of {expected}")]
    Unexpected {
        /// What was to be there.
        expected: &'static str,
        /// The beginning of what is there.
        found: String,
        /// Where.
        at: Place,
    },
    /// A section does not end where it should by the number of its items.
    #[error("{at}: found \"{found}\" in place of $End{section}")]
    NotClosed {
        /// The section.
        section: &'static str,
        /// The beginning of what is there.
        found: String,
        /// Where.
        at: Place,
    },
    /// A section does not hold as many items as it declares.
    #[error("${section} at {at} declares {declared} items and holds {found}")]
    Count {
        /// The section.
        section: &'static str,
        /// The number declared.
        declared: u64,
        /// The number found.
        found: u64,
        /// Where.
        at: Place,
    },
    /// A section is not there.
    #[error("no section ${section}")]
    MissingSection {
        /// The section.
        section: &'static str,
    },
    /// A section is there twice.
    #[error("{at}: a second section ${section}")]
    RepeatedSection {
        /// The section.
        section: &'static str,
        /// Where the second one begins.
        at: Place,
    },
    /// Two names for one group.
    #[error("{at}: a second name for group {number} of dimension {dimension}")]
    RepeatedGroup {
        /// Dimension of the group.
        dimension: usize,
        /// Its number.
        number: u32,
        /// Where the second one is.
        at: Place,
    },
    /// Two entities of one dimension have one number.
    #[error("{at}: a second entity {entity} of dimension {dimension}")]
    RepeatedEntity {
        /// Dimension of the entity.
        dimension: usize,
        /// Its number.
        entity: i32,
        /// Where the second one is.
        at: Place,
    },
    /// An entity belongs to more than 64 groups.
    #[error(
        "{at}: entity {entity} of dimension {dimension} belongs to {groups} groups, at most 64 are read"
    )]
    TooManyGroups {
        /// Dimension of the entity.
        dimension: usize,
        /// Its number.
        entity: i32,
        /// The number of its groups.
        groups: u64,
        /// Where.
        at: Place,
    },
    /// Elements are on an entity that is not listed, so that their groups are unknown; so in partitioned meshes.
    #[error("{at}: elements on entity {entity} of dimension {dimension}, which is not listed")]
    UnknownEntity {
        /// Dimension of the entity.
        dimension: usize,
        /// Its number.
        entity: i32,
        /// Where the elements begin.
        at: Place,
    },
    /// Elements of one dimension on an entity of another one.
    #[error("{at}: elements of kind {kind} on an entity of dimension {dimension}")]
    BlockDimension {
        /// The kind of the elements.
        kind: &'static str,
        /// Dimension of the entity.
        dimension: usize,
        /// Where the elements begin.
        at: Place,
    },
    /// An element is neither line nor triangle nor tetrahedron of first order.
    #[error("{at}: element {element} is a {kind} (kind {number}): {remedy}")]
    Kind {
        /// The element.
        element: u64,
        /// Gmsh's number of its kind.
        number: i32,
        /// Its kind.
        kind: &'static str,
        /// What to export instead.
        remedy: &'static str,
        /// Where it is.
        at: Place,
    },
    /// An element has more dimensions than the mesh asked for.
    #[error(
        "{at}: element {element} is a {kind}, which a mesh of {dimension} dimensions does not have"
    )]
    Dimension {
        /// The element.
        element: u64,
        /// Its kind.
        kind: &'static str,
        /// Dimensions of the mesh.
        dimension: usize,
        /// Where it is.
        at: Place,
    },
    /// No element has the dimension of the mesh.
    #[error(
        "no elements of {dimension} dimensions: was the mesh generated and saved? Elements outside of groups are \
             saved by Mesh.SaveAll = 1"
    )]
    NoCells {
        /// Dimensions of the mesh.
        dimension: usize,
    },
    /// An element names a node that is not there.
    #[error("{at}: element {element} names node {node}, which is not there")]
    UnknownNode {
        /// The element.
        element: u64,
        /// The node it names.
        node: u64,
        /// Where the element is.
        at: Place,
    },
    /// Two nodes have one number.
    #[error("{at}: a second node {node}")]
    RepeatedNode {
        /// The node.
        node: u64,
        /// Where the second one is.
        at: Place,
    },
    /// No element at all has the node.
    #[error("{at}: node {node} belongs to no element")]
    UnusedNode {
        /// The node.
        node: u64,
        /// Where it is.
        at: Place,
    },
    /// A coordinate is infinite or not a number.
    #[error("{at}: node {node} has a coordinate that is not finite")]
    NotFinite {
        /// The node.
        node: u64,
        /// Where it is.
        at: Place,
    },
    /// A plane mesh has one third coordinate.
    #[error(
        "{at}: node {node} lies at z = {z:e}, the first one at z = {first:e}; a plane mesh lies in a plane of constant z"
    )]
    NotPlane {
        /// The node.
        node: u64,
        /// Its third coordinate \[m\].
        z: f64,
        /// That of the first node \[m\].
        first: f64,
        /// Where it is.
        at: Place,
    },
    /// An element is flat up to rounding.
    #[error("{at}: element {element} is flat, of volume {volume:e}")]
    Flat {
        /// The element.
        element: u64,
        /// Its volume [m^D].
        volume: f64,
        /// Where it is.
        at: Place,
    },
    /// Two elements have the same nodes.
    #[error("{at}: elements {} and {} have the same nodes", .elements[0], .elements[1])]
    Repeated {
        /// The elements.
        elements: [u64; 2],
        /// Where the second one is.
        at: Place,
    },
    /// Elements overlap: two are on one side of a face that they share.
    #[error("{at}: elements {elements:?} overlap, two lie on one side of the nodes {nodes:?}")]
    Overlap {
        /// The elements at the face.
        elements: Vec<u64>,
        /// The nodes of the face.
        nodes: Vec<u64>,
        /// Where the last element is.
        at: Place,
    },
    /// A group has a name and no elements.
    #[error("the group {name:?} of dimension {dimension} has no elements")]
    EmptyGroup {
        /// Its name.
        name: String,
        /// Its dimension.
        dimension: usize,
    },
    /// A group of faces is not on the boundary. A fault inside of a body is no part of its boundary: cut the body open
    /// there, with nodes of their own on each side (the plugin `Crack` of Gmsh).
    #[error(
        "{at}: element {element} of the group {group:?} is not on the boundary of the body: it belongs to {cells} cells"
    )]
    NotOnBoundary {
        /// Name of the group.
        group: String,
        /// The element.
        element: u64,
        /// The number of cells that it belongs to.
        cells: usize,
        /// Where it is.
        at: Place,
    },
    /// More than two elements of a group of faces meet at one node (D = 2) or edge (D = 3), so that it is no surface.
    #[error("{at}: {} elements of the group {group:?} meet at the nodes {nodes:?}: {elements:?}", .elements.len())]
    NotManifold {
        /// Name of the group.
        group: String,
        /// The elements.
        elements: Vec<u64>,
        /// The node, or the two of the edge.
        nodes: Vec<u64>,
        /// Where the last element is.
        at: Place,
    },
    /// The mesh is refused for another reason, two groups of one name for instance.
    #[error(transparent)]
    Mesh(#[from] FemError),
}

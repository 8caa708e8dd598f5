//! Why a file holds no mesh and no samples.

use std::borrow::Cow;
use std::fmt;
use std::io;
use std::path::PathBuf;

use thiserror::Error;

use crate::FemError;

/// Where in a file something is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum FilePlace {
    /// The line of a text, from 1.
    Line(usize),
    /// The line and column of a table, from 1.
    Entry {
        /// The line.
        line: usize,
        /// The column.
        column: usize,
    },
    /// The offset in a binary file, from 0.
    Byte(usize),
}

impl fmt::Display for FilePlace {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Line(line) => write!(f, "line {line}"),
            Self::Entry { line, column } => write!(f, "line {line}, column {column}"),
            Self::Byte(byte) => write!(f, "byte {byte}"),
        }
    }
}

/// Something that has a number in a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FileItem {
    /// What it is: "node", "entity" or "name of group".
    pub what: &'static str,
    /// Its number in the file.
    pub number: i128,
    /// The dimension of an entity or a group.
    pub dimension: Option<usize>,
}

impl FileItem {
    #[cfg(feature = "gmsh")]
    pub(crate) fn new(
        what: &'static str,
        number: impl Into<i128>,
        dimension: Option<usize>,
    ) -> Self {
        Self {
            what,
            number: number.into(),
            dimension,
        }
    }
}

impl fmt::Display for FileItem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} {}", self.what, self.number)?;
        match self.dimension {
            Some(dimension) => write!(f, " of dimension {dimension}"),
            None => Ok(()),
        }
    }
}

/// Why a file of Gmsh is no mesh, or a table no samples. Nodes, elements and groups are meant by their numbers in the
/// file.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum ReadError {
    /// The file cannot be read.
    #[error("cannot read {}: {source}", .path.display())]
    Read {
        /// Where it was to be.
        path: PathBuf,
        /// Why not.
        source: io::Error,
    },
    /// The format is not one that is read.
    #[error("{what} {value} is not read: {remedy}")]
    Format {
        /// The "version of the format" or the "size of numbers \[byte\]".
        what: &'static str,
        /// Its value.
        value: f64,
        /// What to save instead.
        remedy: &'static str,
    },
    /// A section without which the others cannot be read as a mesh.
    #[error("{at}: the section ${section} is not read: {remedy}")]
    Section {
        /// Its name.
        section: &'static str,
        /// What to save instead.
        remedy: &'static str,
        /// Where it is.
        at: FilePlace,
    },
    /// Something else was to be there; or the file ends too early.
    #[error(
        "{at}: {}",
        match found {
            Some(found) => format!("found \"{found}\" in place of {expected}"),
            None => format!("the file ends where {expected} was expected"),
        }
    )]
    Unexpected {
        /// What was to be there.
        expected: Cow<'static, str>,
        /// The beginning of what is there, `None` at the end of the file.
        found: Option<String>,
        /// Where.
        at: FilePlace,
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
        at: FilePlace,
    },
    /// Something is missing: a section, the elements of a group, or those of the mesh.
    #[error(
        "no {what}{}{}: {remedy}",
        if name.is_empty() { String::new() } else { format!(" {name:?}") },
        dimension.map_or_else(String::new, |dimension| format!(" of dimension {dimension}"))
    )]
    Empty {
        /// What it is: "section", "elements in the group" or "elements".
        what: &'static str,
        /// The name of the section or group, empty for the mesh.
        name: String,
        /// The dimension of the group or mesh.
        dimension: Option<usize>,
        /// What to do about it.
        remedy: &'static str,
    },
    /// Two items have one number.
    #[error("{at}: a second {item}")]
    Repeated {
        /// The number.
        item: FileItem,
        /// Where the second one is.
        at: FilePlace,
    },
    /// An element names a node that is not there, or an entity, whose groups are unknown then, as in partitioned meshes.
    #[error("{at}: element {element} names {item}, which is not there")]
    Unknown {
        /// What is not there.
        item: FileItem,
        /// The element, the first one on an entity.
        element: u64,
        /// Where that is.
        at: FilePlace,
    },
    /// An entity belongs to more than 64 groups.
    #[error("{at}: {entity} belongs to {groups} groups, at most 64 are read")]
    TooManyGroups {
        /// The entity.
        entity: FileItem,
        /// The number of its groups.
        groups: u64,
        /// Where.
        at: FilePlace,
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
        at: FilePlace,
    },
    /// An element has more dimensions than the mesh asked for, or another dimension than its entity.
    #[error(
        "{at}: element {element} is a {kind}, which {whole} of {dimension} dimensions does not have"
    )]
    Dimension {
        /// The element, the first one on an entity.
        element: u64,
        /// Its kind.
        kind: &'static str,
        /// What it belongs to: "a mesh" or "an entity".
        whole: &'static str,
        /// The dimensions of that.
        dimension: usize,
        /// Where it is.
        at: FilePlace,
    },
    /// A node that no element has, or with a coordinate that is infinite or not a number.
    #[error("{at}: node {node} must have {requirement}")]
    Node {
        /// The node.
        node: u64,
        /// What it lacks: "an element" or "finite coordinates".
        requirement: &'static str,
        /// Where it is.
        at: FilePlace,
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
        at: FilePlace,
    },
    /// An element is flat up to rounding.
    #[error("{at}: element {element} is flat, of volume {volume:e}")]
    Flat {
        /// The element.
        element: u64,
        /// Its volume [m^D].
        volume: f64,
        /// Where it is.
        at: FilePlace,
    },
    /// Two elements have the same nodes, or two lines of a table the same point.
    #[error("{at}: {what} {} and {} have the same {share}", .numbers[0], .numbers[1])]
    Same {
        /// What they are: "elements" or "lines".
        what: &'static str,
        /// Their numbers.
        numbers: [u64; 2],
        /// What they share: "nodes" or "point".
        share: &'static str,
        /// Where the second one is.
        at: FilePlace,
    },
    /// Elements overlap: two are on one side of a face that they share.
    #[error("{at}: elements {elements:?} overlap, two lie on one side of the nodes {nodes:?}")]
    Overlap {
        /// The elements at the face.
        elements: Vec<u64>,
        /// The nodes of the face.
        nodes: Vec<u64>,
        /// Where the last element is.
        at: FilePlace,
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
        at: FilePlace,
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
        at: FilePlace,
    },
    /// The mesh or the samples are refused for another reason, two groups of one name for instance.
    #[error(transparent)]
    Fem(#[from] FemError),
}

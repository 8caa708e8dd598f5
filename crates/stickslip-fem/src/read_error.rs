//! Errors in reading a mesh or samples from a file.

use std::borrow::Cow;
use std::io;
use std::path::PathBuf;

use thiserror::Error;

use crate::FemError;
use crate::file_place::{FileItem, FilePlace};

/// Errors of a file of Gmsh as a mesh, or of a table as samples. Nodes, elements and groups have their numbers in the
/// file.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum ReadError {
    /// The file cannot be read.
    #[error("cannot read {}: {source}", .path.display())]
    Read {
        /// The path of the file.
        path: PathBuf,
        /// The cause.
        source: io::Error,
    },
    /// The format is not supported.
    #[error("{what} {value} is not read: {remedy}")]
    Format {
        /// The "version of the format" or the "size of numbers \[byte\]".
        what: &'static str,
        /// Its value.
        value: f64,
        /// The remedy: the format to save.
        remedy: &'static str,
    },
    /// A section without which the others cannot be read as a mesh.
    #[error("{at}: the section ${section} is not read: {remedy}")]
    Section {
        /// Its name.
        section: &'static str,
        /// The remedy: the contents to save.
        remedy: &'static str,
        /// Its place.
        at: FilePlace,
    },
    /// Another item was expected, or the file ends too early.
    #[error(
        "{at}: {}",
        match found {
            Some(found) => format!("found \"{found}\" in place of {expected}"),
            None => format!("the file ends where {expected} was expected"),
        }
    )]
    Unexpected {
        /// The expected item.
        expected: Cow<'static, str>,
        /// The beginning of the found text, `None` at the end of the file.
        found: Option<String>,
        /// The place.
        at: FilePlace,
    },
    /// The number of items in a section differs from its declaration.
    #[error("${section} at {at} declares {declared} items and holds {found}")]
    Count {
        /// The section.
        section: &'static str,
        /// The declared number.
        declared: u64,
        /// The found number.
        found: u64,
        /// The place.
        at: FilePlace,
    },
    /// A part of the file is missing: a section, the elements of a group, or those of the mesh.
    #[error(
        "no {what}{}{}: {remedy}",
        if name.is_empty() { String::new() } else { format!(" {name:?}") },
        dimension.map_or_else(String::new, |dimension| format!(" of dimension {dimension}"))
    )]
    Empty {
        /// The missing part: "section", "elements in the group" or "elements".
        what: &'static str,
        /// The name of the section or group, empty for the mesh.
        name: String,
        /// The dimension of the group or mesh.
        dimension: Option<usize>,
        /// The remedy.
        remedy: &'static str,
    },
    /// Two items have the same number.
    #[error("{at}: a second {item}")]
    Repeated {
        /// The number.
        item: FileItem,
        /// The place of the second one.
        at: FilePlace,
    },
    /// An element refers to a missing node, or to a missing entity, whose groups are then unknown, as in partitioned
    /// meshes.
    #[error("{at}: element {element} names {item}, which is not there")]
    Unknown {
        /// The missing item.
        item: FileItem,
        /// The element, the first one on an entity.
        element: u64,
        /// Its place.
        at: FilePlace,
    },
    /// An entity belongs to more than 64 groups.
    #[error("{at}: {entity} belongs to {groups} groups, at most 64 are read")]
    TooManyGroups {
        /// The entity.
        entity: FileItem,
        /// The number of its groups.
        groups: u64,
        /// The place.
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
        /// The remedy: the export to use.
        remedy: &'static str,
        /// Its place.
        at: FilePlace,
    },
    /// An element has more dimensions than the requested mesh, or another dimension than its entity.
    #[error(
        "{at}: element {element} is a {kind}, which {whole} of {dimension} dimensions does not have"
    )]
    Dimension {
        /// The element, the first one on an entity.
        element: u64,
        /// Its kind.
        kind: &'static str,
        /// The whole that it belongs to: "a mesh" or "an entity".
        whole: &'static str,
        /// The dimension of the whole.
        dimension: usize,
        /// Its place.
        at: FilePlace,
    },
    /// A node without an element, or with a coordinate that is infinite or NaN.
    #[error("{at}: node {node} must have {requirement}")]
    Node {
        /// The node.
        node: u64,
        /// The requirement: "an element" or "finite coordinates".
        requirement: &'static str,
        /// Its place.
        at: FilePlace,
    },
    /// The third coordinates of a plane mesh differ.
    #[error(
        "{at}: node {node} lies at z = {z:e}, the first one at z = {first:e}; a plane mesh lies in a plane of constant z"
    )]
    NotPlane {
        /// The node.
        node: u64,
        /// Its third coordinate \[m\].
        z: f64,
        /// The third coordinate of the first node \[m\].
        first: f64,
        /// Its place.
        at: FilePlace,
    },
    /// An element is flat up to rounding.
    #[error("{at}: element {element} is flat, of volume {volume:e}")]
    Flat {
        /// The element.
        element: u64,
        /// Its volume [m^D].
        volume: f64,
        /// Its place.
        at: FilePlace,
    },
    /// Two elements have the same nodes, or two lines of a table the same point.
    #[error("{at}: {what} {} and {} have the same {share}", .numbers[0], .numbers[1])]
    Same {
        /// The items: "elements" or "lines".
        what: &'static str,
        /// Their numbers.
        numbers: [u64; 2],
        /// The shared data: "nodes" or "point".
        share: &'static str,
        /// The place of the second one.
        at: FilePlace,
    },
    /// Elements overlap: two are on one side of their common face.
    #[error("{at}: elements {elements:?} overlap, two lie on one side of the nodes {nodes:?}")]
    Overlap {
        /// The elements at the face.
        elements: Vec<u64>,
        /// The nodes of the face.
        nodes: Vec<u64>,
        /// The place of the last element.
        at: FilePlace,
    },
    /// An element of a group of faces is no face of a cell.
    #[error(
        "{at}: element {element} of the group {group:?} is no face of the mesh: {cells} cells have its nodes"
    )]
    NotOnBoundary {
        /// Name of the group.
        group: String,
        /// The element.
        element: u64,
        /// The number of cells that have its nodes.
        cells: usize,
        /// Its place.
        at: FilePlace,
    },
    /// More than two elements of a group of faces meet at one node (D = 2) or edge (D = 3): the group is no surface.
    #[error("{at}: {} elements of the group {group:?} meet at the nodes {nodes:?}: {elements:?}", .elements.len())]
    NotManifold {
        /// Name of the group.
        group: String,
        /// The elements.
        elements: Vec<u64>,
        /// The node, or the two of the edge.
        nodes: Vec<u64>,
        /// The place of the last element.
        at: FilePlace,
    },
    /// The mesh or the samples are refused for another reason, two groups of one name for instance.
    #[error(transparent)]
    Fem(#[from] FemError),
}

//! Meshes of Gmsh: files of version 4.1 and 2.2 of the format, as text and binary, in either order of bytes.
//!
//! ```
//! use stickslip_fem::{P1, gmsh};
//!
//! // `gmsh::read("body.msh")?` for a file.
//! let mesh = gmsh::parse::<2>(
//!     br#"$MeshFormat
//! 2.2 0 8
//! $EndMeshFormat
//! $PhysicalNames
//! 2
//! 1 1 "fault"
//! 2 2 "granite"
//! $EndPhysicalNames
//! $Nodes
//! 4
//! 1 0 0 0
//! 2 1 0 0
//! 3 1 1 0
//! 4 0 1 0
//! $EndNodes
//! $Elements
//! 3
//! 1 1 2 1 1 1 2
//! 2 2 2 2 1 1 2 3
//! 3 2 2 2 1 1 3 4
//! $EndElements
//! "#,
//! )?;
//! let space = P1::new(mesh).refined(2)?;
//! assert_eq!(space.part("fault")?.measure(), 1.0);
//! let density = space.by_material(&[("granite", 2700.0)])?;
//! # let _ = density;
//! # Ok::<(), stickslip_fem::ReadError>(())
//! ```
//!
//! | in Gmsh | in the mesh |
//! | --- | --- |
//! | triangles (D = 2), tetrahedra (D = 3) of first order | cells, turned to positive orientation |
//! | physical group of dimension D | [material](crate::Mesh::with_material) |
//! | physical group of dimension D - 1, on the boundary | [part of the boundary](crate::Mesh::with_part) |
//! | the same inside the body, a fault | [surface](crate::Mesh::with_surface) along which the mesh can be [split](crate::Mesh::split) |
//! | name of a group, or its number if it has none | its name |
//! | nodes of cells | vertices, numbered along the shorter extents of the bounding box first; [`NodeTags`] has their numbers in the file |
//! | points, lines and their nodes that no cell has, such as centres of arcs | left out |
//! | other elements, partitions | refused |
//! | groups of lower dimension, other sections | left out |
//!
//! Triangles in space, a fault without a body, are a [`Surface`].
//!
//! An element may belong to several groups. As soon as there is one group, Gmsh saves only elements in groups: the
//! cells need one, too. A plane mesh (D = 2) lies at constant z.
//!
//! A broken file is refused by a [`ReadError`] with the place: nodes without elements, elements without nodes, flat,
//! repeated or overlapping cells, groups of faces that are empty, or no surface. Memory is at most a
//! multiple of the file's size, whatever its contents. [`Mesh::nonconforming_nodes`](crate::Mesh::nonconforming_nodes)
//! finds duplicate and hanging nodes, which are legal but seldom intended.
//!
//! Source of the format: C. Geuzaine, J.-F. Remacle, *Gmsh reference manual*, "MSH file format" and "MSH file format
//! version 2 (Legacy)".

mod assemble;
mod contents;
mod cursor;
mod layer;
mod manifold;
mod node_tags;
mod nodes;
mod surface;
mod version_2;
mod version_4;

use std::fs;
use std::path::Path;

use crate::{Mesh, ReadError};
use contents::Contents;
use cursor::Cursor;
pub use node_tags::NodeTags;
pub use surface::{Surface, parse_surface, read_surface};

/// Reads the mesh in a file.
///
/// # Errors
///
/// [`ReadError`], see the [module](self).
pub fn read<const D: usize>(path: impl AsRef<Path>) -> Result<Mesh<D>, ReadError> {
    Ok(read_with_tags(path)?.0)
}

/// Reads the mesh in a file with the numbers of its nodes there: for data on the same nodes from other programs.
///
/// # Errors
///
/// [`ReadError`], see the [module](self).
pub fn read_with_tags<const D: usize>(
    path: impl AsRef<Path>,
) -> Result<(Mesh<D>, NodeTags), ReadError> {
    let path = path.as_ref();
    let bytes = fs::read(path).map_err(|source| ReadError::Read {
        path: path.to_owned(),
        source,
    })?;
    parse_with_tags(&bytes)
}

/// Reads the mesh in the bytes of a file.
///
/// # Errors
///
/// [`ReadError`], see the [module](self).
pub fn parse<const D: usize>(bytes: &[u8]) -> Result<Mesh<D>, ReadError> {
    Ok(parse_with_tags(bytes)?.0)
}

/// Reads the mesh in the bytes of a file with the numbers of its nodes there.
///
/// ```
/// use stickslip_fem::gmsh;
///
/// let (mesh, nodes) = gmsh::parse_with_tags::<2>(
///     b"$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n3\n7 0 0 0\n30 1 0 0\n8 0 1 0\n$EndNodes\n\
///       $Elements\n1\n1 2 2 0 1 7 30 8\n$EndElements\n",
/// )?;
/// let vertex = nodes.vertex(30).ok_or("no such node")?;
/// assert_eq!((mesh.vertices()[vertex][0], nodes.tags()[vertex]), (1.0, 30));
/// assert_eq!(nodes.vertex(9), None);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
///
/// [`ReadError`], see the [module](self).
pub fn parse_with_tags<const D: usize>(bytes: &[u8]) -> Result<(Mesh<D>, NodeTags), ReadError> {
    let mut cursor = Cursor::new(bytes);
    let mut contents = Contents::read(&mut cursor)?;
    contents.resolve(&cursor)?;
    assemble::assemble(&contents, &cursor)
}

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
//! | physical group of dimension D - 1 | [part of the boundary](crate::Mesh::with_part) |
//! | name of a group, or its number if it has none | its name |
//! | nodes of cells | vertices, numbered along the shorter extents of the bounding box first |
//! | points, lines and their nodes that no cell has, such as centres of arcs | left out |
//! | other elements | refused |
//! | groups of lower dimension, other sections | left out |
//!
//! An element may belong to several groups. As soon as there is one group, Gmsh saves only elements in groups: the cells
//! need one, too. A plane mesh (D = 2) lies at constant z.
//!
//! A broken file is refused by a [`ReadError`] that says where: nodes that no element has, elements without nodes, flat,
//! doubled or overlapping cells, groups of faces that are empty, inside of the body, or no surface. Whatever the file
//! says, memory is at most a multiple of its size. [`Mesh::nonconforming_nodes`](crate::Mesh::nonconforming_nodes) finds what is legal and seldom
//! meant: nodes that were not merged.
//!
//! Source of the format: C. Geuzaine, J.-F. Remacle, *Gmsh reference manual*, "MSH file format" and "MSH file format
//! version 2 (Legacy)".

mod assemble;
mod contents;
mod cursor;
mod layer;
mod manifold;
mod nodes;
mod version_2;
mod version_4;

use std::fs;
use std::path::Path;

use crate::{Mesh, ReadError};
use contents::Contents;
use cursor::Cursor;

/// Reads the mesh in a file.
///
/// # Errors
///
/// [`ReadError`], see the [module](self).
pub fn read<const D: usize>(path: impl AsRef<Path>) -> Result<Mesh<D>, ReadError> {
    let path = path.as_ref();
    let bytes = fs::read(path).map_err(|source| ReadError::Read {
        path: path.to_owned(),
        source,
    })?;
    parse(&bytes)
}

/// Reads the mesh in the bytes of a file.
///
/// # Errors
///
/// [`ReadError`], see the [module](self).
pub fn parse<const D: usize>(bytes: &[u8]) -> Result<Mesh<D>, ReadError> {
    let mut cursor = Cursor::new(bytes);
    let mut contents = Contents::read(&mut cursor)?;
    contents.resolve(&cursor)?;
    assemble::assemble(&contents, &cursor)
}

//! Surfaces of triangles in space, such as faults.

use std::fs;
use std::path::Path;

use super::contents::Contents;
use super::cursor::Cursor;
use super::layer::Layer;
use crate::{FemError, ReadError};

/// Triangles in space, with the physical groups of a file: a fault, or several.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Surface {
    /// The vertices \[m\], those of triangles alone, in the order of the file.
    pub points: Vec<[f64; 3]>,
    /// The vertices of each triangle, in the order of the file.
    pub triangles: Vec<[usize; 3]>,
    /// The triangles of each group by its name, or its number if it has none.
    pub groups: Vec<(String, Vec<usize>)>,
}

impl Surface {
    /// The triangles in some groups with their vertices, each once, in the order of the file.
    ///
    /// # Errors
    ///
    /// [`FemError::Unknown`] for a group that the surface does not have.
    pub fn of_groups(&self, names: &[&str]) -> Result<Self, FemError> {
        let mut chosen = vec![false; self.triangles.len()];
        for &name in names {
            let group = self.groups.iter().find(|(own, _)| own == name);
            let Some((_, members)) = group else {
                return Err(FemError::Unknown {
                    what: "group of triangles",
                    name: name.to_owned(),
                    known: self.groups.iter().map(|(own, _)| own.clone()).collect(),
                });
            };
            members.iter().for_each(|&member| chosen[member] = true);
        }
        Ok(self.only(&chosen))
    }

    /// The chosen triangles.
    fn only(&self, chosen: &[bool]) -> Self {
        let (mut vertex, mut place) = (vec![None; self.points.len()], vec![None; chosen.len()]);
        let mut chosen_ones = Self::default();
        let triangles = self.triangles.iter().enumerate();
        for (old, corners) in triangles.filter(|(old, _)| chosen[*old]) {
            place[old] = Some(chosen_ones.triangles.len());
            for &corner in corners {
                vertex[corner] = Some(0);
            }
            chosen_ones.triangles.push(*corners);
        }
        for (old, vertex) in vertex.iter_mut().enumerate() {
            if vertex.is_some() {
                *vertex = Some(chosen_ones.points.len());
                chosen_ones.points.push(self.points[old]);
            }
        }
        for corner in chosen_ones.triangles.iter_mut().flatten() {
            *corner = vertex[*corner].unwrap_or_default();
        }
        for (name, members) in &self.groups {
            let members: Vec<usize> = members.iter().filter_map(|&old| place[old]).collect();
            if !members.is_empty() {
                chosen_ones.groups.push((name.clone(), members));
            }
        }
        chosen_ones
    }
}

/// Reads the triangles in a file: all of them, or those in groups if there are tetrahedra, too.
///
/// # Errors
///
/// [`ReadError`] for a file that is broken, or has no triangles.
pub fn read_surface(path: impl AsRef<Path>) -> Result<Surface, ReadError> {
    let path = path.as_ref();
    let bytes = fs::read(path).map_err(|source| ReadError::Read {
        path: path.to_owned(),
        source,
    })?;
    parse_surface(&bytes)
}

/// Reads the triangles in the bytes of a file, as [`read_surface`] does.
///
/// ```
/// use stickslip_fem::gmsh;
///
/// // Two faults of one triangle each.
/// let surface = gmsh::parse_surface(
///     b"$MeshFormat\n2.2 0 8\n$EndMeshFormat\n\
///       $PhysicalNames\n2\n2 1 \"ramp\"\n2 2 \"flat\"\n$EndPhysicalNames\n\
///       $Nodes\n4\n1 0 0 0\n2 0 9 0\n3 5 4 -3\n7 20 4 -3\n$EndNodes\n\
///       $Elements\n2\n1 2 2 1 1 1 2 3\n2 2 2 2 2 2 7 3\n$EndElements\n",
/// )?;
/// assert_eq!(surface.triangles, [[0, 1, 2], [1, 3, 2]]);
/// let flat = surface.of_groups(&["flat"])?;
/// assert_eq!((flat.points.len(), flat.triangles[0]), (3, [0, 2, 1]));
/// assert!(surface.of_groups(&["decollement"]).is_err());
/// # Ok::<(), stickslip_fem::ReadError>(())
/// ```
///
/// # Errors
///
/// [`ReadError`] as of [`read_surface`].
pub fn parse_surface(bytes: &[u8]) -> Result<Surface, ReadError> {
    let mut cursor = Cursor::new(bytes);
    let mut contents = Contents::read(&mut cursor)?;
    contents.resolve(&cursor)?;
    let of_bodies = (contents.blocks.iter()).any(|block| block.kind.dimension() == 3);
    let layer = if of_bodies {
        Layer::faces(&contents, &cursor, 2)?
    } else {
        Layer::cells(&contents, &cursor, 2)?
    };
    if layer.elements.is_empty() {
        return Err(ReadError::Empty {
            what: "triangles in groups",
            name: String::new(),
            dimension: Some(2),
            remedy: "put the surface into a physical group",
        });
    }
    let all = Surface {
        points: contents.nodes.iter().map(|node| node.point).collect(),
        triangles: (layer.elements.iter())
            .map(|element| element.nodes.map(|place| place as usize))
            .map(|[a, b, c, _]| [a, b, c])
            .collect(),
        groups: (layer.groups.into_iter())
            .map(|(number, members)| (contents.name(2, number), members))
            .collect(),
    };
    Ok(all.only(&vec![true; all.triangles.len()]))
}

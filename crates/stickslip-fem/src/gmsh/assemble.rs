//! A mesh from nodes, elements and groups.

use nalgebra::SVector;

use super::contents::{Contents, Element};
use super::cursor::Cursor;
use super::layer::Layer;
use super::manifold::manifold;
use super::node_tags::NodeTags;
use crate::numbering::{bounding_box, ranks, sweep_order};
use crate::simplex::Simplex;
use crate::surfaces::sorted;
use crate::{FemError, Mesh, ReadError};

/// Largest relative difference of third coordinates, over the diameter of a plane body, that counts as zero.
const PLANE: f64 = 1e-10;

/// Vertex of a node without a cell.
const NOWHERE: u32 = u32::MAX;

pub(super) fn assemble<const D: usize>(
    contents: &Contents,
    cursor: &Cursor<'_>,
) -> Result<(Mesh<D>, NodeTags), ReadError> {
    let cells = Layer::cells(contents, cursor, D)?;
    let faces = Layer::faces(contents, cursor, D - 1)?;
    let (kept, vertices) = vertices::<D>(contents, cursor, &cells)?;
    let order = sweep_order(&vertices);
    let rank = ranks(&order);
    let mut vertex = vec![NOWHERE; contents.nodes.len()];
    for (&node, rank) in kept.iter().zip(rank) {
        vertex[node] = rank;
    }
    let vertices: Vec<SVector<f64, D>> = order.iter().map(|&old| vertices[old as usize]).collect();
    let node_of = |p: u32| contents.nodes[kept[order[p as usize] as usize]].tag;

    let mut corners = Vec::with_capacity(cells.elements.len() * (D + 1));
    for element in &cells.elements {
        let start = corners.len();
        corners.extend(element.places(D + 1).map(|node| vertex[node]));
        if Simplex::new(&vertices, &corners[start..]).volume < 0.0 {
            corners.swap(start + D - 1, start + D);
        }
    }
    let mut mesh = Mesh::new(vertices, corners)
        .map_err(|error| refused(error, &cells.elements, cursor, node_of))?;
    for (&number, members) in &cells.groups {
        mesh = mesh.with_material(contents.name(D, number), members)?;
    }
    let mut boundary: Vec<[u32; D]> = mesh.boundary.iter().map(|&face| sorted(face)).collect();
    boundary.sort_unstable();
    for (&number, members) in &faces.groups {
        let name = contents.name(D - 1, number);
        let members: Vec<&Element> = members.iter().map(|&k| faces.elements[k]).collect();
        let listed: Vec<[u32; D]> = (members.iter())
            .map(|element| {
                let mut corners = element.places(D).map(|node| vertex[node]);
                std::array::from_fn(|_| corners.next().unwrap_or(NOWHERE))
            })
            .collect();
        let outside = |face: &[u32; D]| boundary.binary_search(&sorted(*face)).is_ok();
        let (outer, inner): (Vec<usize>, Vec<usize>) =
            (0..listed.len()).partition(|&k| outside(&listed[k]));
        let chosen = |at: &[usize]| -> (Vec<&Element>, Vec<[u32; D]>) {
            at.iter().map(|&k| (members[k], listed[k])).unzip()
        };
        let (crossing, within) = chosen(&inner);
        let has_inside = inside(&mesh, &within);
        let (members, listed) = if has_inside {
            chosen(&outer)
        } else {
            (members, listed)
        };
        if !listed.is_empty() {
            mesh = mesh
                .with_part(name.as_str(), &listed)
                .map_err(|error| refused(error, &members, cursor, node_of))?;
        }
        if has_inside {
            let named = match listed.is_empty() {
                true => mesh.with_surface(name.as_str(), &within),
                false => mesh.with_surface_beside(name.clone(), &within),
            };
            mesh = named.map_err(|error| refused(error, &crossing, cursor, node_of))?;
        }
        manifold(&name, &members, &contents.nodes, cursor, D)?;
    }
    for (&(dimension, number), name) in &contents.names {
        let missing = dimension == D && !cells.groups.contains_key(&number)
            || dimension == D - 1 && !faces.groups.contains_key(&number);
        if missing {
            return Err(ReadError::Empty {
                what: "elements in the group",
                name: name.clone(),
                dimension: Some(dimension),
                remedy: "add some to it, or leave out its name",
            });
        }
    }
    let tags = (0..mesh.vertex_count() as u32).map(node_of).collect();
    Ok((mesh, NodeTags::new(tags)))
}

impl Contents {
    /// The name of a group, or its number.
    pub(super) fn name(&self, dimension: usize, number: u32) -> String {
        let name = self.names.get(&(dimension, number));
        name.map_or_else(|| number.to_string(), String::clone)
    }
}

/// Whether a face lies between two cells; then it is taken for a surface inside the body.
fn inside<const D: usize>(mesh: &Mesh<D>, faces: &[[u32; D]]) -> bool {
    let mut keys: Vec<[u32; D]> = faces.iter().map(|&face| sorted(face)).collect();
    keys.sort_unstable();
    mesh.sides(&keys).iter().any(|side| side.count == 2)
}

/// The nodes of cells: positions in the list, and coordinates.
type Kept<const D: usize> = (Vec<usize>, Vec<SVector<f64, D>>);

fn vertices<const D: usize>(
    contents: &Contents,
    cursor: &Cursor<'_>,
    cells: &Layer<'_>,
) -> Result<Kept<D>, ReadError> {
    let mut kept = vec![false; contents.nodes.len()];
    for element in &cells.elements {
        element.places(D + 1).for_each(|node| kept[node] = true);
    }
    let kept: Vec<usize> = (0..kept.len()).filter(|&node| kept[node]).collect();
    if kept.len() >= NOWHERE as usize {
        let vertices = kept.len() as u64;
        return Err(FemError::too_many("vertices", vertices).into());
    }
    let points: Vec<SVector<f64, D>> = (kept.iter())
        .map(|&node| SVector::from_fn(|axis, _| contents.nodes[node].point[axis]))
        .collect();
    if D == 2 {
        let (low, high) = bounding_box(&points);
        let near = PLANE * (high - low).norm();
        let first = contents.nodes[kept[0]].point[2];
        let off = |&&node: &&usize| (contents.nodes[node].point[2] - first).abs() > near;
        if let Some(&node) = kept.iter().find(off) {
            let node = &contents.nodes[node];
            return Err(ReadError::NotPlane {
                node: node.tag,
                z: node.point[2],
                first,
                at: cursor.place(node.offset),
            });
        }
    }
    Ok((kept, points))
}

/// The error for the elements of a list, in the numbers of the file.
fn refused(
    error: FemError,
    elements: &[&Element],
    cursor: &Cursor<'_>,
    node_of: impl Fn(u32) -> u64,
) -> ReadError {
    let tag = |k: usize| elements[k].tag;
    let at = |k: usize| cursor.place(elements[k].offset);
    match error {
        FemError::DegenerateCell { cell, volume, .. } => ReadError::Flat {
            element: tag(cell),
            volume,
            at: at(cell),
        },
        FemError::Repeated { places: same, .. } => ReadError::Same {
            what: "elements",
            numbers: same.map(tag),
            share: "nodes",
            at: at(same[1]),
        },
        FemError::FoldedCells { cells, face } => ReadError::Overlap {
            elements: cells.iter().map(|&cell| tag(cell)).collect(),
            nodes: face.iter().map(|&p| node_of(p)).collect(),
            at: at(cells[cells.len() - 1]),
        },
        FemError::NotOnBoundary {
            part, index, cells, ..
        } => ReadError::NotOnBoundary {
            group: part,
            element: tag(index),
            cells,
            at: at(index),
        },
        FemError::NotInside {
            surface,
            index,
            cells,
            ..
        } => ReadError::NotOnBoundary {
            group: surface,
            element: tag(index),
            cells,
            at: at(index),
        },
        other => other.into(),
    }
}

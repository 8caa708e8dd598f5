//! A mesh from nodes, elements and groups.

use std::collections::{BTreeMap, HashMap};

use nalgebra::SVector;

use super::GmshError;
use super::contents::{Block, Contents, Element};
use super::cursor::Cursor;
use crate::numbering::{bounding_box, ranks, sweep_order};
use crate::simplex::Simplex;
use crate::{FemError, Mesh};

/// Difference of third coordinates over the diameter of a plane body up to which they count as one.
const PLANE: f64 = 1e-10;

/// Vertex of a node that no cell has.
const NOWHERE: u32 = u32::MAX;

pub(super) fn assemble<const D: usize>(
    contents: &Contents,
    cursor: &Cursor<'_>,
) -> Result<Mesh<D>, GmshError> {
    let nodes = Nodes::new(contents, cursor)?;
    let cells = Layer::cells(contents, cursor, D)?;
    let faces = Layer::faces(contents, cursor, D - 1)?;
    let (kept, vertices) = vertices::<D>(contents, cursor, &nodes, &cells)?;
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
        corners.extend(nodes.of(element, D + 1).map(|node| vertex[node]));
        if Simplex::new(&vertices, &corners[start..]).volume < 0.0 {
            corners.swap(start + D - 1, start + D);
        }
    }
    let mut mesh = Mesh::new(vertices, corners)
        .map_err(|error| refused(error, &cells.elements, cursor, node_of))?;
    for (&number, members) in &cells.groups {
        mesh = mesh.with_material(contents.name(D, number), members)?;
    }
    for (&number, members) in &faces.groups {
        let name = contents.name(D - 1, number);
        let members: Vec<&Element> = members.iter().map(|&k| faces.elements[k]).collect();
        let listed: Vec<[u32; D]> = (members.iter())
            .map(|element| {
                let mut corners = nodes.of(element, D).map(|node| vertex[node]);
                std::array::from_fn(|_| corners.next().unwrap_or(NOWHERE))
            })
            .collect();
        mesh = mesh
            .with_part(name.as_str(), &listed)
            .map_err(|error| refused(error, &members, cursor, node_of))?;
        manifold(&name, &members, cursor, D)?;
    }
    for (&(dimension, number), name) in &contents.names {
        let missing = dimension == D && !cells.groups.contains_key(&number)
            || dimension + 1 == D && !faces.groups.contains_key(&number);
        if missing {
            let name = name.clone();
            return Err(GmshError::EmptyGroup { name, dimension });
        }
    }
    Ok(mesh)
}

impl Contents {
    fn name(&self, dimension: usize, number: u32) -> String {
        let name = self.names.get(&(dimension, number));
        name.map_or_else(|| number.to_string(), String::clone)
    }

    fn groups(&self, block: &Block, cursor: &Cursor<'_>) -> Result<&[u32], GmshError> {
        match self.entities.get(&block.entity) {
            Some(groups) => Ok(groups),
            // A file without entities is one without groups.
            None if self.entities.is_empty() => Ok(&[]),
            None => Err(GmshError::UnknownEntity {
                dimension: block.entity.0,
                entity: block.entity.1,
                at: cursor.place(block.offset),
            }),
        }
    }
}

/// Where nodes are in the list, by their numbers; those of all elements are there.
struct Nodes {
    places: HashMap<u64, usize>,
}

impl Nodes {
    fn new(contents: &Contents, cursor: &Cursor<'_>) -> Result<Self, GmshError> {
        let mut places = HashMap::with_capacity(contents.nodes.len());
        for (place, node) in contents.nodes.iter().enumerate() {
            let (tag, at) = (node.tag, || cursor.place(node.offset));
            if places.insert(tag, place).is_some() {
                return Err(GmshError::RepeatedNode {
                    node: tag,
                    at: at(),
                });
            }
            if !node.point.iter().all(|x| x.is_finite()) {
                return Err(GmshError::NotFinite {
                    node: tag,
                    at: at(),
                });
            }
        }
        let mut used = vec![false; contents.nodes.len()];
        for block in &contents.blocks {
            for element in &block.elements {
                for &node in &element.nodes[..block.kind.corners()] {
                    let Some(&place) = places.get(&node) else {
                        return Err(GmshError::UnknownNode {
                            element: element.tag,
                            node,
                            at: cursor.place(element.offset),
                        });
                    };
                    used[place] = true;
                }
            }
        }
        if let Some(place) = used.iter().position(|used| !used) {
            let node = &contents.nodes[place];
            return Err(GmshError::UnusedNode {
                node: node.tag,
                at: cursor.place(node.offset),
            });
        }
        Ok(Self { places })
    }

    fn of(&self, element: &Element, corners: usize) -> impl Iterator<Item = usize> {
        element.nodes[..corners]
            .iter()
            .map(|node| self.places[node])
    }
}

/// The elements of one dimension, and the groups they are in.
struct Layer<'a> {
    elements: Vec<&'a Element>,
    groups: BTreeMap<u32, Vec<usize>>,
}

impl<'a> Layer<'a> {
    /// Those of `blocks`. Version 2.2 lists an element of several groups several times, one right behind the other:
    /// that is one element.
    fn new(
        blocks: impl Iterator<Item = &'a Block>,
        contents: &Contents,
        cursor: &Cursor<'_>,
    ) -> Result<Self, GmshError> {
        let mut elements: Vec<&Element> = Vec::new();
        let mut groups = BTreeMap::<u32, Vec<usize>>::new();
        for block in blocks {
            for (k, element) in block.elements.iter().enumerate() {
                let again = k == 0
                    && elements
                        .last()
                        .is_some_and(|last| last.nodes == element.nodes);
                if !again {
                    elements.push(element);
                }
                for &group in contents.groups(block, cursor)? {
                    groups.entry(group).or_default().push(elements.len() - 1);
                }
            }
        }
        Ok(Self { elements, groups })
    }

    fn cells(
        contents: &'a Contents,
        cursor: &Cursor<'_>,
        dimension: usize,
    ) -> Result<Self, GmshError> {
        for block in &contents.blocks {
            if let Some(element) = block
                .elements
                .first()
                .filter(|_| block.kind.dimension() > dimension)
            {
                return Err(GmshError::Dimension {
                    element: element.tag,
                    kind: block.kind.name(),
                    dimension,
                    at: cursor.place(element.offset),
                });
            }
        }
        let blocks = contents
            .blocks
            .iter()
            .filter(|block| block.kind.dimension() == dimension);
        let cells = Self::new(blocks, contents, cursor)?;
        if cells.elements.is_empty() {
            return Err(GmshError::NoCells { dimension });
        }
        Ok(cells)
    }

    /// Lines of no group may lie anywhere: they were of use in making the mesh.
    fn faces(
        contents: &'a Contents,
        cursor: &Cursor<'_>,
        dimension: usize,
    ) -> Result<Self, GmshError> {
        let mut blocks = Vec::new();
        for block in contents
            .blocks
            .iter()
            .filter(|block| block.kind.dimension() == dimension)
        {
            if !contents.groups(block, cursor)?.is_empty() {
                blocks.push(block);
            }
        }
        Self::new(blocks.into_iter(), contents, cursor)
    }
}

/// The nodes of cells, by their places, and where they are.
type Kept<const D: usize> = (Vec<usize>, Vec<SVector<f64, D>>);

fn vertices<const D: usize>(
    contents: &Contents,
    cursor: &Cursor<'_>,
    nodes: &Nodes,
    cells: &Layer<'_>,
) -> Result<Kept<D>, GmshError> {
    let mut kept = vec![false; contents.nodes.len()];
    for element in &cells.elements {
        nodes.of(element, D + 1).for_each(|node| kept[node] = true);
    }
    let kept: Vec<usize> = (0..kept.len()).filter(|&node| kept[node]).collect();
    if kept.len() >= NOWHERE as usize {
        let vertices = kept.len() as u64;
        return Err(FemError::TooManyVertices { vertices }.into());
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
            return Err(GmshError::NotPlane {
                node: node.tag,
                z: node.point[2],
                first,
                at: cursor.place(node.offset),
            });
        }
    }
    Ok((kept, points))
}

/// Refuses more than two faces at one node (D = 2) or edge (D = 3).
fn manifold(
    group: &str,
    faces: &[&Element],
    cursor: &Cursor<'_>,
    dimension: usize,
) -> Result<(), GmshError> {
    let mut rims: Vec<([u64; 2], usize)> = Vec::with_capacity(faces.len() * dimension);
    for (k, face) in faces.iter().enumerate() {
        let corners = &face.nodes[..dimension];
        for (i, &node) in corners.iter().enumerate() {
            let next = corners[(i + 1) % dimension];
            let rim = if dimension == 2 {
                [node, node]
            } else {
                [node.min(next), node.max(next)]
            };
            rims.push((rim, k));
        }
    }
    rims.sort_unstable();
    for meeting in rims.chunk_by(|a, b| a.0 == b.0) {
        if meeting.len() > 2 {
            let last = faces[meeting[meeting.len() - 1].1];
            let mut nodes = meeting[0].0.to_vec();
            nodes.dedup();
            return Err(GmshError::NotManifold {
                group: group.to_owned(),
                elements: meeting.iter().map(|&(_, k)| faces[k].tag).collect(),
                nodes,
                at: cursor.place(last.offset),
            });
        }
    }
    Ok(())
}

/// What is wrong with the elements of a list, in the numbers of the file.
fn refused(
    error: FemError,
    elements: &[&Element],
    cursor: &Cursor<'_>,
    node_of: impl Fn(u32) -> u64,
) -> GmshError {
    let tag = |k: usize| elements[k].tag;
    let at = |k: usize| cursor.place(elements[k].offset);
    match error {
        FemError::DegenerateCell { cell, volume } => GmshError::Flat {
            element: tag(cell),
            volume,
            at: at(cell),
        },
        FemError::RepeatedCell { cells: same } | FemError::RepeatedFace { indices: same, .. } => {
            GmshError::Repeated {
                elements: same.map(tag),
                at: at(same[1]),
            }
        }
        FemError::FoldedCells { cells, face } => GmshError::Overlap {
            elements: cells.iter().map(|&cell| tag(cell)).collect(),
            nodes: face.iter().map(|&p| node_of(p)).collect(),
            at: at(cells[cells.len() - 1]),
        },
        FemError::FaceNotOnBoundary {
            part, index, cells, ..
        } => GmshError::NotOnBoundary {
            group: part,
            element: tag(index),
            cells,
            at: at(index),
        },
        other => other.into(),
    }
}

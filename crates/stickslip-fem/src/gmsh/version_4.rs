//! The sections of version 4.1.

use super::contents::{Block, Contents, DIMENSION, Element, Kind, Node, corners};
use super::cursor::Cursor;
use crate::{FileItem, ReadError};

/// Largest number of groups of an entity: the lists grow with the product of groups and elements.
const MOST_GROUPS: u64 = 64;

/// Points have coordinates; other entities have a bounding box and bounding entities.
pub(super) fn entities(cursor: &mut Cursor<'_>, contents: &mut Contents) -> Result<(), ReadError> {
    let mut counts = [0; 4];
    for count in &mut counts {
        *count = cursor.size("a number of entities")?;
    }
    for (dimension, count) in counts.into_iter().enumerate() {
        for _ in 0..count {
            let offset = cursor.start();
            let tag = cursor.int("the number of an entity")?;
            for _ in 0..if dimension == 0 { 3 } else { 6 } {
                cursor.real("a coordinate")?;
            }
            let groups = cursor.size("a number of groups")?;
            if groups > MOST_GROUPS {
                return Err(ReadError::TooManyGroups {
                    entity: FileItem::new("entity", tag, Some(dimension)),
                    groups,
                    at: cursor.place(offset),
                });
            }
            let mut listed = Vec::new();
            for _ in 0..groups {
                // The sign is an orientation.
                let group = cursor.int("the number of a group")?.unsigned_abs();
                if !listed.contains(&group) {
                    listed.push(group);
                }
            }
            if dimension > 0 {
                for _ in 0..cursor.size("a number of bounding entities")? {
                    cursor.int("the number of an entity")?;
                }
            }
            cursor.item_end()?;
            if contents.entities.insert((dimension, tag), listed).is_some() {
                return Err(ReadError::Repeated {
                    item: FileItem::new("entity", tag, Some(dimension)),
                    at: cursor.place(offset),
                });
            }
        }
    }
    Ok(())
}

pub(super) fn nodes(cursor: &mut Cursor<'_>, contents: &mut Contents) -> Result<(), ReadError> {
    let start = cursor.start();
    let blocks = cursor.size("a number of blocks")?;
    let total = cursor.size("a number of nodes")?;
    for _ in 0..2 {
        cursor.size("the number of a node")?;
    }
    for _ in 0..blocks {
        let offset = cursor.start();
        let dimension = dimension(cursor)?;
        cursor.int("the number of an entity")?;
        let parametric = cursor.int("0 or 1 for parameters")?;
        let parameters = match parametric {
            0 => 0,
            1 => dimension,
            _ => {
                let found = parametric.to_string();
                return Err(cursor.unexpected("0 or 1 for parameters", found.as_bytes(), offset));
            }
        };
        let first = contents.nodes.len();
        for _ in 0..cursor.size("a number of nodes")? {
            let offset = cursor.start();
            let tag = cursor.size("the number of a node")?;
            cursor.item_end()?;
            let point = [0.0; 3];
            contents.nodes.push(Node { tag, point, offset });
        }
        for node in &mut contents.nodes[first..] {
            for coordinate in &mut node.point {
                *coordinate = cursor.real("a coordinate")?;
            }
            for _ in 0..parameters {
                cursor.real("a parameter")?;
            }
            cursor.item_end()?;
        }
    }
    let found = contents.nodes.len() as u64;
    counted(cursor, "Nodes", total, found, start)
}

pub(super) fn elements(cursor: &mut Cursor<'_>, contents: &mut Contents) -> Result<(), ReadError> {
    let start = cursor.start();
    let blocks = cursor.size("a number of blocks")?;
    let total = cursor.size("a number of elements")?;
    for _ in 0..2 {
        cursor.size("the number of an element")?;
    }
    let mut found = 0;
    for _ in 0..blocks {
        let offset = cursor.start();
        let dimension = dimension(cursor)?;
        let entity = (dimension, cursor.int("the number of an entity")?);
        let kind = cursor.int("the kind of elements")?;
        let count = cursor.size("a number of elements")?;
        let peek = cursor.clone().size("the number of an element").unwrap_or(0);
        let kind = Kind::of(kind, peek, cursor, offset)?;
        if kind.dimension() != dimension {
            return Err(ReadError::Dimension {
                element: peek,
                kind: kind.name(),
                whole: "an entity",
                dimension,
                at: cursor.place(offset),
            });
        }
        let mut elements = Vec::new();
        for _ in 0..count {
            let offset = cursor.start();
            let tag = cursor.size("the number of an element")?;
            let nodes = corners(kind, || cursor.size("the number of a node"))?;
            cursor.item_end()?;
            elements.push(Element { tag, nodes, offset });
        }
        found += elements.len() as u64;
        contents.blocks.push(Block {
            kind,
            entity,
            offset,
            elements,
        });
    }
    counted(cursor, "Elements", total, found, start)
}

fn dimension(cursor: &mut Cursor<'_>) -> Result<usize, ReadError> {
    let offset = cursor.start();
    let dimension = cursor.int(DIMENSION)?;
    match dimension {
        0..=3 => Ok(dimension as usize),
        _ => Err(cursor.unexpected(DIMENSION, dimension.to_string().as_bytes(), offset)),
    }
}

fn counted(
    cursor: &Cursor<'_>,
    section: &'static str,
    declared: u64,
    found: u64,
    start: usize,
) -> Result<(), ReadError> {
    if found == declared {
        return Ok(());
    }
    Err(ReadError::Count {
        section,
        declared,
        found,
        at: cursor.place(start),
    })
}

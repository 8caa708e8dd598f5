//! The sections of version 2.2.

use super::contents::{Block, Contents, Element, Kind, Node, corners};
use super::cursor::{Cursor, Encoding};
use crate::ReadError;

/// The number of items: text in all files, on a line of its own.
fn count(cursor: &mut Cursor<'_>, expected: &'static str) -> Result<u64, ReadError> {
    let count = cursor.text(expected)?;
    cursor.line_end()?;
    Ok(count)
}

pub(super) fn nodes(cursor: &mut Cursor<'_>, contents: &mut Contents) -> Result<(), ReadError> {
    for _ in 0..count(cursor, "a number of nodes")? {
        let offset = cursor.start();
        let tag = cursor.natural("the number of a node")?;
        let mut point = [0.0; 3];
        for coordinate in &mut point {
            *coordinate = cursor.real("a coordinate")?;
        }
        cursor.item_end()?;
        contents.nodes.push(Node { tag, point, offset });
    }
    Ok(())
}

/// The elements. In a text each has a heading, in binary several share one.
pub(super) fn elements(cursor: &mut Cursor<'_>, contents: &mut Contents) -> Result<(), ReadError> {
    let total = count(cursor, "a number of elements")?;
    let mut read = 0;
    while read < total {
        if cursor.encoding == Encoding::Text {
            let offset = cursor.start();
            let tag = cursor.natural("the number of an element")?;
            let kind = cursor.int("the kind of an element")?;
            let kind = Kind::of(kind, tag, cursor, offset)?;
            let tags = cursor.natural("a number of tags")?;
            element(cursor, contents, kind, tags, tag, offset)?;
            read += 1;
            continue;
        }
        let offset = cursor.start();
        let kind = cursor.int("the kind of elements")?;
        let follow = cursor.natural("a number of elements")?;
        let tags = cursor.natural("a number of tags")?;
        let peek = cursor.clone().natural("the number of an element")?;
        let kind = Kind::of(kind, peek, cursor, offset)?;
        if follow == 0 || follow > total - read {
            return Err(ReadError::Count {
                section: "Elements",
                declared: total,
                found: read + follow,
                at: cursor.place(offset),
            });
        }
        for _ in 0..follow {
            let offset = cursor.start();
            let tag = cursor.natural("the number of an element")?;
            element(cursor, contents, kind, tags, tag, offset)?;
        }
        read += follow;
    }
    Ok(())
}

/// The rest of an element: its tags, the first of which is the group, and its nodes.
fn element(
    cursor: &mut Cursor<'_>,
    contents: &mut Contents,
    kind: Kind,
    tags: u64,
    tag: u64,
    offset: usize,
) -> Result<(), ReadError> {
    let mut group = 0;
    for k in 0..tags {
        let value = cursor.int("a tag")?;
        if k == 0 {
            group = value;
        }
    }
    let nodes = corners(kind, || cursor.natural("the number of a node"))?;
    let entity = (kind.dimension(), group);
    cursor.item_end()?;
    let element = Element { tag, nodes, offset };
    match contents.blocks.last_mut() {
        Some(block) if block.kind == kind && block.entity == entity => block.elements.push(element),
        _ => {
            // Zero is no group.
            let groups = (group != 0).then_some(group.unsigned_abs());
            contents
                .entities
                .insert(entity, groups.into_iter().collect());
            contents.blocks.push(Block {
                kind,
                entity,
                offset,
                elements: vec![element],
            });
        }
    }
    Ok(())
}

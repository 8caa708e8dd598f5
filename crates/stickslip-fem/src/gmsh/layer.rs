//! Elements of one dimension with their groups.

use std::collections::BTreeMap;

use super::contents::{Block, Contents, Element};
use super::cursor::Cursor;
use crate::{FileItem, ReadError};

/// The remedy for a file without cells, by its contents.
const NONE: &str =
    "generate and save the mesh; elements outside of groups are saved by Mesh.SaveAll = 1";
const LINES: &str = "the file has lines only: generate the mesh of surfaces or volumes (gmsh -2, gmsh -3), in groups or with Mesh.SaveAll = 1";
const SURFACES: &str = "the file has surfaces only, of triangles: generate the mesh of volumes (gmsh -3), in groups or with Mesh.SaveAll = 1, or read a plane mesh, of D = 2";

/// The elements of one dimension and their groups.
pub(super) struct Layer<'a> {
    pub(super) elements: Vec<&'a Element>,
    pub(super) groups: BTreeMap<u32, Vec<usize>>,
}

impl<'a> Layer<'a> {
    /// The layer of `blocks`. Version 2.2 lists an element of several groups several times in succession: that is one
    /// element.
    fn new(
        blocks: impl Iterator<Item = &'a Block>,
        contents: &Contents,
        cursor: &Cursor<'_>,
    ) -> Result<Self, ReadError> {
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

    pub(super) fn cells(
        contents: &'a Contents,
        cursor: &Cursor<'_>,
        dimension: usize,
    ) -> Result<Self, ReadError> {
        for block in &contents.blocks {
            if let Some(element) = block
                .elements
                .first()
                .filter(|_| block.kind.dimension() > dimension)
            {
                return Err(ReadError::Dimension {
                    element: element.tag,
                    kind: block.kind.name(),
                    whole: "a mesh",
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
            let kinds = contents.blocks.iter().map(|block| block.kind.dimension());
            return Err(ReadError::Empty {
                what: "elements",
                name: String::new(),
                dimension: Some(dimension),
                remedy: match kinds.max() {
                    Some(2) => SURFACES,
                    Some(1) => LINES,
                    _ => NONE,
                },
            });
        }
        Ok(cells)
    }

    /// The named faces. Lines without a group may lie anywhere: they only helped to make the mesh.
    pub(super) fn faces(
        contents: &'a Contents,
        cursor: &Cursor<'_>,
        dimension: usize,
    ) -> Result<Self, ReadError> {
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

impl Contents {
    fn groups(&self, block: &Block, cursor: &Cursor<'_>) -> Result<&[u32], ReadError> {
        let first = block.elements.first().map_or(0, |element| element.tag);
        match self.entities.get(&block.entity) {
            Some(groups) => Ok(groups),
            // A file without entities is one without groups.
            None if self.entities.is_empty() => Ok(&[]),
            None => Err(ReadError::Unknown {
                item: FileItem::new("entity", block.entity.1, Some(block.entity.0)),
                element: first,
                at: cursor.place(block.offset),
            }),
        }
    }
}

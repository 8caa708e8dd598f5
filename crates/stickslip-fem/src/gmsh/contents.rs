//! The contents of a file, in either version of the format.

use std::collections::{BTreeMap, HashMap};

use super::cursor::{Cursor, Encoding};
use super::{version_2, version_4};
use crate::{FileItem, ReadError};

/// Nodes, elements and groups, as yet unchecked against each other.
#[derive(Default)]
pub(super) struct Contents {
    pub(super) nodes: Vec<Node>,
    pub(super) blocks: Vec<Block>,
    /// The names of groups by dimension and number.
    pub(super) names: BTreeMap<(usize, u32), String>,
    /// The groups of each entity, by its dimension and number. In version 2.2 a group is its own entity.
    pub(super) entities: HashMap<Entity, Vec<u32>>,
}

/// Dimension and number.
pub(super) type Entity = (usize, i32);

/// Offsets are positions in the file.
pub(super) struct Node {
    pub(super) tag: u64,
    pub(super) point: [f64; 3],
    pub(super) offset: usize,
}

/// Elements of one kind on one entity.
pub(super) struct Block {
    pub(super) kind: Kind,
    pub(super) entity: Entity,
    pub(super) offset: usize,
    pub(super) elements: Vec<Element>,
}

pub(super) struct Element {
    pub(super) tag: u64,
    /// The corners of the kind, padded with zeros: their numbers, and after [`Contents::resolve`] their positions.
    pub(super) nodes: [u64; 4],
    pub(super) offset: usize,
}

impl Element {
    /// The positions of its nodes.
    pub(super) fn places(&self, corners: usize) -> impl Iterator<Item = usize> {
        self.nodes[..corners].iter().map(|&place| place as usize)
    }
}

/// The elements of a simplicial mesh.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    Point,
    Line,
    Triangle,
    Tetrahedron,
}

impl Kind {
    /// The kind by Gmsh's number of it; otherwise an error about the element at `offset`.
    pub(super) fn of(
        number: i32,
        element: u64,
        cursor: &Cursor<'_>,
        offset: usize,
    ) -> Result<Self, ReadError> {
        Ok(match number {
            15 => Self::Point,
            1 => Self::Line,
            2 => Self::Triangle,
            4 => Self::Tetrahedron,
            _ => {
                let (kind, remedy) = other_kind(number);
                return Err(ReadError::Kind {
                    element,
                    number,
                    kind,
                    remedy,
                    at: cursor.place(offset),
                });
            }
        })
    }

    pub(super) fn dimension(self) -> usize {
        self.corners() - 1
    }

    pub(super) fn corners(self) -> usize {
        match self {
            Self::Point => 1,
            Self::Line => 2,
            Self::Triangle => 3,
            Self::Tetrahedron => 4,
        }
    }

    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Point => "point",
            Self::Line => "line",
            Self::Triangle => "triangle",
            Self::Tetrahedron => "tetrahedron",
        }
    }
}

/// The name of an unsupported element, and the export to use instead.
fn other_kind(number: i32) -> (&'static str, &'static str) {
    const SIMPLICES: &str = "export triangles or tetrahedra: no \"Recombine\", Mesh.RecombineAll = 0, no layers of recombined extrusions";
    const FIRST_ORDER: &str = "save elements of first order: Mesh.ElementOrder = 1";
    const UNKNOWN: &str = "export lines, triangles and tetrahedra of first order";
    match number {
        3 => ("quadrangle", SIMPLICES),
        5 => ("hexahedron", SIMPLICES),
        6 => ("prism", SIMPLICES),
        7 => ("pyramid", SIMPLICES),
        8 | 26..=28 => ("line of higher order", FIRST_ORDER),
        9 | 20..=25 => ("triangle of higher order", FIRST_ORDER),
        11 | 29..=31 => ("tetrahedron of higher order", FIRST_ORDER),
        10 | 16 => ("quadrangle of higher order", SIMPLICES),
        12 | 17 => ("hexahedron of higher order", SIMPLICES),
        13 | 18 => ("prism of higher order", SIMPLICES),
        14 | 19 => ("pyramid of higher order", SIMPLICES),
        _ => ("element of another kind", UNKNOWN),
    }
}

impl Contents {
    /// Reads a whole file; the cursor then has its encoding.
    pub(super) fn read(cursor: &mut Cursor<'_>) -> Result<Self, ReadError> {
        let version = header(cursor)?;
        let mut contents = Self::default();
        let mut seen: Vec<&'static str> = Vec::new();
        while let Some((name, start)) = cursor.section()? {
            if name == PARTITIONED {
                return Err(ReadError::Section {
                    section: PARTITIONED,
                    remedy: "unpartition the mesh (Modules > Mesh > Unpartition in Gmsh), or save it without -part",
                    at: cursor.place(start),
                });
            }
            let Some(&section) = SECTIONS.iter().find(|&&section| section == name) else {
                cursor.skip(name)?;
                continue;
            };
            if seen.contains(&section) {
                return Err(ReadError::Unexpected {
                    expected: format!("no second ${section}").into(),
                    found: Some(format!("${section}")),
                    at: cursor.place(start),
                });
            }
            seen.push(section);
            if cursor.encoding != Encoding::Text && section != "PhysicalNames" {
                cursor.line_end()?;
            }
            match (section, version) {
                ("PhysicalNames", _) => contents.names(cursor)?,
                ("Entities", Version::Four) => version_4::entities(cursor, &mut contents)?,
                ("Entities", Version::Two) => {
                    cursor.skip(section)?;
                    continue;
                }
                ("Nodes", Version::Two) => version_2::nodes(cursor, &mut contents)?,
                ("Nodes", Version::Four) => version_4::nodes(cursor, &mut contents)?,
                (_, Version::Two) => version_2::elements(cursor, &mut contents)?,
                (_, Version::Four) => version_4::elements(cursor, &mut contents)?,
            }
            cursor.close(section)?;
        }
        for section in ["Nodes", "Elements"] {
            if !seen.contains(&section) {
                return Err(ReadError::Empty {
                    what: "section",
                    name: section.to_owned(),
                    dimension: None,
                    remedy: "save the whole mesh",
                });
            }
        }
        Ok(contents)
    }

    /// The names, text in all files.
    fn names(&mut self, cursor: &mut Cursor<'_>) -> Result<(), ReadError> {
        let count: u64 = cursor.text("a number of groups")?;
        for _ in 0..count {
            let offset = cursor.start();
            let dimension: usize = cursor.text(DIMENSION)?;
            if dimension > 3 {
                let found = dimension.to_string();
                return Err(cursor.unexpected(DIMENSION, found.as_bytes(), offset));
            }
            let number: u32 = cursor.text("the number of a group")?;
            let name = cursor.quoted()?;
            if self.names.insert((dimension, number), name).is_some() {
                return Err(ReadError::Repeated {
                    item: FileItem::new("name of group", number, Some(dimension)),
                    at: cursor.place(offset),
                });
            }
        }
        Ok(())
    }
}

/// A dimension, as expected in an error.
pub(super) const DIMENSION: &str = "a dimension from 0 to 3";

/// The sections that are read; others are skipped.
const SECTIONS: [&str; 4] = ["PhysicalNames", "Entities", "Nodes", "Elements"];

/// Elements are on its entities in place of those of `Entities`.
const PARTITIONED: &str = "PartitionedEntities";

const SAVE_AS: &str = "save as version 4.1 or 2.2, Mesh.MshFileVersion = 4.1";

#[derive(Clone, Copy)]
enum Version {
    Two,
    Four,
}

fn header(cursor: &mut Cursor<'_>) -> Result<Version, ReadError> {
    const SECTION: &str = "MeshFormat";
    let mut first = cursor.clone();
    let named = cursor.section().ok().flatten();
    // The first section of version 1, which does not name itself.
    if named.is_some_and(|(name, _)| name == "NOD") {
        return Err(ReadError::Format {
            what: "version of the format",
            value: 1.0,
            remedy: SAVE_AS,
        });
    }
    if named.is_none_or(|(name, _)| name != SECTION) {
        return Err(first.refused("$MeshFormat, with which meshes of Gmsh begin"));
    }
    let number: f64 = cursor.text("the version of the format")?;
    let version = match number {
        4.1 => Version::Four,
        2.2 => Version::Two,
        value => {
            return Err(ReadError::Format {
                what: "version of the format",
                value,
                remedy: SAVE_AS,
            });
        }
    };
    let binary: i32 = cursor.text("0 for text or 1 for binary")?;
    let size: i32 = cursor.text("a size in bytes")?;
    if size != 8 {
        return Err(ReadError::Format {
            what: "size of numbers [byte]",
            value: size.into(),
            remedy: "the file must come from a program of 64 bits",
        });
    }
    if binary != 0 {
        cursor.line_end()?;
        let start = cursor.start();
        let one: [u8; 4] = cursor.fixed("the number one")?;
        cursor.encoding = match (i32::from_le_bytes(one), i32::from_be_bytes(one)) {
            (1, _) => Encoding::LittleEndian,
            (_, 1) => Encoding::BigEndian,
            _ => {
                let expected = "the number one, which tells the order of bytes";
                return Err(cursor.unexpected(expected, &one, start));
            }
        };
    }
    cursor.close(SECTION)?;
    Ok(version)
}

/// The numbers of the nodes of an element.
pub(super) fn corners(
    kind: Kind,
    mut next: impl FnMut() -> Result<u64, ReadError>,
) -> Result<[u64; 4], ReadError> {
    let mut nodes = [0; 4];
    for node in &mut nodes[..kind.corners()] {
        *node = next()?;
    }
    Ok(nodes)
}

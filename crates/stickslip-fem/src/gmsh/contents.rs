//! What a file says, in either version of the format.

use std::collections::{BTreeMap, HashMap};

use super::cursor::{Cursor, Encoding};
use super::{GmshError, version_2, version_4};

/// Nodes, elements and groups, as yet unchecked against each other.
#[derive(Default)]
pub(super) struct Contents {
    pub(super) nodes: Vec<Node>,
    pub(super) blocks: Vec<Block>,
    /// By dimension and number.
    pub(super) names: BTreeMap<(usize, u32), String>,
    /// The groups of each entity, by its dimension and number. In version 2.2 a group is its own entity.
    pub(super) entities: HashMap<Entity, Vec<u32>>,
}

/// Dimension and number.
pub(super) type Entity = (usize, i32);

/// Offsets say where in the file something is.
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
    /// As many as the kind has corners, zero behind: their numbers, and after [`Contents::resolve`] their places.
    pub(super) nodes: [u64; 4],
    pub(super) offset: usize,
}

impl Element {
    /// The places of its nodes.
    pub(super) fn places(&self, corners: usize) -> impl Iterator<Item = usize> {
        self.nodes[..corners].iter().map(|&place| place as usize)
    }
}

/// The elements a simplicial mesh is made of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    Point,
    Line,
    Triangle,
    Tetrahedron,
}

impl Kind {
    /// By Gmsh's number of the kind; an error about the element at `offset` otherwise.
    pub(super) fn of(
        number: i32,
        element: u64,
        cursor: &Cursor<'_>,
        offset: usize,
    ) -> Result<Self, GmshError> {
        Ok(match number {
            15 => Self::Point,
            1 => Self::Line,
            2 => Self::Triangle,
            4 => Self::Tetrahedron,
            _ => {
                let (kind, remedy) = other_kind(number);
                return Err(GmshError::Kind {
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

/// What an element is that no mesh here is made of, and what to export in its place.
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
    /// Reads a whole file; the cursor then knows how it is encoded.
    pub(super) fn read(cursor: &mut Cursor<'_>) -> Result<Self, GmshError> {
        let version = header(cursor)?;
        let mut contents = Self::default();
        let mut seen: Vec<&'static str> = Vec::new();
        while let Some((name, start)) = cursor.section()? {
            let Some(&section) = SECTIONS.iter().find(|&&section| section == name) else {
                cursor.skip(name)?;
                continue;
            };
            if seen.contains(&section) {
                let at = cursor.place(start);
                return Err(GmshError::RepeatedSection { section, at });
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
                return Err(GmshError::MissingSection { section });
            }
        }
        Ok(contents)
    }

    /// Text in all files.
    fn names(&mut self, cursor: &mut Cursor<'_>) -> Result<(), GmshError> {
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
                return Err(GmshError::RepeatedGroup {
                    dimension,
                    number,
                    at: cursor.place(offset),
                });
            }
        }
        Ok(())
    }
}

/// What a dimension is, in an error.
pub(super) const DIMENSION: &str = "a dimension from 0 to 3";

/// What is read; other sections are passed over.
const SECTIONS: [&str; 4] = ["PhysicalNames", "Entities", "Nodes", "Elements"];

#[derive(Clone, Copy)]
enum Version {
    Two,
    Four,
}

fn header(cursor: &mut Cursor<'_>) -> Result<Version, GmshError> {
    const SECTION: &str = "MeshFormat";
    let first = cursor.section().ok().flatten();
    if first.is_none_or(|(name, _)| name != SECTION) {
        return Err(GmshError::NotGmsh);
    }
    let number: f64 = cursor.text("the version of the format")?;
    let version = match number {
        4.1 => Version::Four,
        2.2 => Version::Two,
        version => return Err(GmshError::Version { version }),
    };
    let binary: i32 = cursor.text("0 for text or 1 for binary")?;
    let size: i32 = cursor.text("a size in bytes")?;
    if size != 8 {
        return Err(GmshError::DataSize { size });
    }
    if binary != 0 {
        cursor.line_end()?;
        let one: [u8; 4] = cursor.fixed("the number one")?;
        cursor.encoding = match (i32::from_le_bytes(one), i32::from_be_bytes(one)) {
            (1, _) => Encoding::LittleEndian,
            (_, 1) => Encoding::BigEndian,
            _ => return Err(GmshError::Endianness { found: one }),
        };
    }
    cursor.close(SECTION)?;
    Ok(version)
}

/// The numbers of the nodes of an element.
pub(super) fn corners(
    kind: Kind,
    mut next: impl FnMut() -> Result<u64, GmshError>,
) -> Result<[u64; 4], GmshError> {
    let mut nodes = [0; 4];
    for node in &mut nodes[..kind.corners()] {
        *node = next()?;
    }
    Ok(nodes)
}

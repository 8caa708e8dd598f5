//! A reader of VTU files that knows nothing of how they are written here, but the format.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use crate::Outcome;

/// An array as its element announces it, with its bytes.
#[derive(Debug)]
pub(super) struct Array {
    pub(super) kind: String,
    pub(super) components: usize,
    bytes: Vec<u8>,
}

/// A grid by the places and names of its arrays, as `PointData` and `velocity`.
#[derive(Debug)]
pub(super) struct File {
    pub(super) points: usize,
    pub(super) cells: usize,
    pub(super) arrays: BTreeMap<(String, String), Array>,
    /// The fields that a viewer opens with: their place, their kind, their name.
    pub(super) active: Vec<(String, String, String)>,
}

/// The bytes of `N` that begin at a place.
fn bytes<const N: usize>(data: &[u8], at: usize) -> Outcome<[u8; N]> {
    let end = at.checked_add(N).ok_or("an offset of no file")?;
    Ok(data
        .get(at..end)
        .ok_or("it ends before an array")?
        .try_into()?)
}

/// The name of an element and its attributes, with what XML has escaped.
fn element(tag: &str) -> Outcome<(&str, BTreeMap<String, String>)> {
    let (name, mut rest) = tag.split_once(' ').unwrap_or((tag, ""));
    let mut attributes = BTreeMap::new();
    while let Some((key, after)) = rest.split_once("=\"") {
        let (value, after) = after.split_once('"').ok_or("a value without its end")?;
        attributes.insert(key.trim().to_string(), unescaped(value));
        rest = after;
    }
    Ok((name, attributes))
}

/// A value as it was before it was escaped.
pub(super) fn unescaped(value: &str) -> String {
    let pairs = [
        ("&lt;", "<"),
        ("&gt;", ">"),
        ("&quot;", "\""),
        ("&amp;", "&"),
    ];
    pairs
        .iter()
        .fold(value.to_string(), |text, (from, to)| text.replace(from, to))
}

impl File {
    /// Reads a file. Arrays have to follow each other without a gap, and nothing may follow the last.
    pub(super) fn read(path: impl AsRef<Path>) -> Outcome<Self> {
        let whole = fs::read(path)?;
        let begin = b"<AppendedData encoding=\"raw\">\n_";
        let at = whole
            .windows(begin.len())
            .position(|window| window == begin);
        let at = at.ok_or("no appended data")?;
        let (text, data) = (
            std::str::from_utf8(&whole[..at])?,
            &whole[at + begin.len()..],
        );
        let mut file = Self {
            points: 0,
            cells: 0,
            arrays: BTreeMap::new(),
            active: Vec::new(),
        };
        let (mut place, mut end) = (String::new(), 0);
        for part in text.split('<').skip(1) {
            let tag = part
                .trim_end()
                .strip_suffix('>')
                .ok_or("text between elements")?;
            let (name, attributes) = element(tag.trim_end_matches('/'))?;
            let of = |key: &str| attributes.get(key).ok_or(format!("no {key} in {tag}"));
            match name {
                "VTKFile" => {
                    assert_eq!(of("type")?, "UnstructuredGrid");
                    assert_eq!(of("byte_order")?, "LittleEndian");
                    assert_eq!(of("header_type")?, "UInt64");
                }
                "Piece" => {
                    file.points = of("NumberOfPoints")?.parse()?;
                    file.cells = of("NumberOfCells")?.parse()?;
                }
                "PointData" | "CellData" | "Points" | "Cells" => {
                    place = name.to_string();
                    let kinds = attributes.iter();
                    file.active.extend(
                        kinds.map(|(kind, field)| (place.clone(), kind.clone(), field.clone())),
                    );
                }
                "DataArray" => {
                    assert_eq!(of("format")?, "appended");
                    let offset: usize = of("offset")?.parse()?;
                    assert_eq!(offset, end, "{tag}");
                    let size = usize::try_from(u64::from_le_bytes(bytes(data, offset)?))?;
                    let start = offset + size_of::<u64>();
                    end = start + size;
                    let array = Array {
                        kind: of("type")?.clone(),
                        components: of("NumberOfComponents")?.parse()?,
                        bytes: data.get(start..end).ok_or("it ends in an array")?.to_vec(),
                    };
                    file.arrays
                        .insert((place.clone(), of("Name")?.clone()), array);
                }
                _ => {}
            }
        }
        assert_eq!(&data[end..], b"\n</AppendedData>\n</VTKFile>\n");
        Ok(file)
    }

    /// The values of an array of this type and so many components, one for each of so many points or cells.
    fn values(&self, place: &str, name: &str, kind: &str, components: usize) -> Outcome<&[u8]> {
        let array = self.arrays.get(&(place.into(), name.into()));
        let array =
            array.ok_or_else(|| format!("no {name} in {place}: {:?}", self.arrays.keys()))?;
        assert_eq!(
            (array.kind.as_str(), array.components),
            (kind, components),
            "{name}"
        );
        Ok(&array.bytes)
    }

    /// An array of numbers.
    pub(super) fn numbers(&self, place: &str, name: &str, components: usize) -> Outcome<Vec<f64>> {
        let bytes = self
            .values(place, name, "Float64", components)?
            .chunks(size_of::<f64>());
        let numbers: Result<Vec<_>, _> = bytes
            .map(|x| x.try_into().map(f64::from_le_bytes))
            .collect();
        let numbers = numbers?;
        let count = if place == "CellData" {
            self.cells
        } else {
            self.points
        };
        assert_eq!(numbers.len(), count * components, "{name}");
        Ok(numbers)
    }

    /// The points of each cell, and the numbers of their shapes.
    pub(super) fn topology(&self) -> Outcome<(Vec<Vec<i64>>, Vec<u8>)> {
        let indices = |name| -> Outcome<Vec<i64>> {
            let bytes = self
                .values("Cells", name, "Int64", 1)?
                .chunks(size_of::<i64>());
            let indices: Result<_, _> = bytes
                .map(|n| n.try_into().map(i64::from_le_bytes))
                .collect();
            Ok(indices?)
        };
        let (corners, ends) = (indices("connectivity")?, indices("offsets")?);
        let shapes = self.values("Cells", "types", "UInt8", 1)?.to_vec();
        assert_eq!((ends.len(), shapes.len()), (self.cells, self.cells));
        let mut cells = Vec::new();
        let mut begin = 0;
        for end in ends {
            let end = usize::try_from(end)?;
            cells.push(
                corners
                    .get(begin..end)
                    .ok_or("a cell without points")?
                    .to_vec(),
            );
            begin = end;
        }
        assert_eq!(begin, corners.len());
        Ok((cells, shapes))
    }
}

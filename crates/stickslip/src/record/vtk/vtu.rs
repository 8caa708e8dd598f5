//! Unstructured grids as VTU files: XML that describes each array, followed by the arrays as bytes.
//!
//! ```text
//! <VTKFile ..> .. <DataArray type="Float64" Name=".." NumberOfComponents="3" format="appended" offset="N"/> ..
//! <AppendedData encoding="raw">_ size, bytes, size, bytes, .. </AppendedData></VTKFile>
//! ```
//!
//! Numbers are little-endian; a size is that of the bytes that follow it, in 64 bits; offsets count from behind the
//! underscore (VTK File Formats, "XML file formats").

use std::io::{self, Write};

use super::xml::escaped;

/// The shape of all cells of a grid.
#[derive(Debug, Clone, Copy)]
pub(super) enum Shape {
    Line,
    Triangle,
    Tetrahedron,
}

impl Shape {
    fn corners(self) -> usize {
        match self {
            Self::Line => 2,
            Self::Triangle => 3,
            Self::Tetrahedron => 4,
        }
    }

    /// The VTK cell type (vtkCellType.h).
    fn code(self) -> u8 {
        match self {
            Self::Line => 3,
            Self::Triangle => 5,
            Self::Tetrahedron => 10,
        }
    }
}

/// The kind of a field's value at each point or cell.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Kind {
    Scalars,
    Vectors,
    Tensors,
}

impl Kind {
    fn name(self) -> &'static str {
        match self {
            Self::Scalars => "Scalars",
            Self::Vectors => "Vectors",
            Self::Tensors => "Tensors",
        }
    }

    fn components(self) -> usize {
        match self {
            Self::Scalars => 1,
            Self::Vectors => 3,
            Self::Tensors => 9,
        }
    }
}

/// A field at points or cells.
pub(super) struct Field {
    pub(super) name: &'static str,
    pub(super) kind: Kind,
    pub(super) values: Vec<f64>,
}

/// Cells of one shape on points in three dimensions, with fields.
pub(super) struct Grid {
    pub(super) points: Vec<f64>,
    /// The points of each cell, one cell after the other.
    pub(super) corners: Vec<i64>,
    pub(super) shape: Shape,
    pub(super) at_points: Vec<Field>,
    pub(super) at_cells: Vec<Field>,
}

/// The numbers of an array.
enum Values<'a> {
    Float64(&'a [f64]),
    Int64(&'a [i64]),
    UInt8(&'a [u8]),
}

impl Values<'_> {
    fn kind(&self) -> &'static str {
        match self {
            Self::Float64(_) => "Float64",
            Self::Int64(_) => "Int64",
            Self::UInt8(_) => "UInt8",
        }
    }

    fn size(&self) -> usize {
        match self {
            Self::Float64(values) => size_of_val(*values),
            Self::Int64(values) => size_of_val(*values),
            Self::UInt8(values) => values.len(),
        }
    }

    fn write(&self, to: &mut impl Write) -> io::Result<()> {
        to.write_all(&(self.size() as u64).to_le_bytes())?;
        match self {
            Self::Float64(values) => values
                .iter()
                .try_for_each(|x| to.write_all(&x.to_le_bytes())),
            Self::Int64(values) => values
                .iter()
                .try_for_each(|n| to.write_all(&n.to_le_bytes())),
            Self::UInt8(values) => to.write_all(values),
        }
    }
}

/// The arrays of a file in the order of its XML header.
struct Announced<'a, W> {
    to: &'a mut W,
    arrays: Vec<Values<'a>>,
    offset: usize,
}

impl<'a, W: Write> Announced<'a, W> {
    fn array(&mut self, name: &str, components: usize, values: Values<'a>) -> io::Result<()> {
        writeln!(
            self.to,
            "<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{components}\" format=\"appended\" \
             offset=\"{}\"/>",
            values.kind(),
            escaped(name),
            self.offset,
        )?;
        self.offset += size_of::<u64>() + values.size();
        self.arrays.push(values);
        Ok(())
    }

    /// Writes fields at points or cells; a viewer opens with the first of each kind.
    fn fields(&mut self, place: &str, fields: &'a [Field]) -> io::Result<()> {
        write!(self.to, "<{place}")?;
        for kind in [Kind::Scalars, Kind::Vectors, Kind::Tensors] {
            if let Some(first) = fields.iter().find(|field| field.kind == kind) {
                write!(self.to, " {}=\"{}\"", kind.name(), escaped(first.name))?;
            }
        }
        writeln!(self.to, ">")?;
        for field in fields {
            let values = Values::Float64(&field.values);
            self.array(field.name, field.kind.components(), values)?;
        }
        writeln!(self.to, "</{place}>")
    }
}

impl Grid {
    /// Writes the grid as a file.
    pub(super) fn write(&self, to: &mut impl Write) -> io::Result<()> {
        let (points, corners) = (self.points.len() / 3, self.shape.corners());
        let cells = self.corners.len() / corners;
        let ends: Vec<i64> = (1..=cells).map(|n| (n * corners) as i64).collect();
        let shapes = vec![self.shape.code(); cells];
        write!(
            to,
            "<?xml version=\"1.0\"?>\n\
             <VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n\
             <UnstructuredGrid>\n<Piece NumberOfPoints=\"{points}\" NumberOfCells=\"{cells}\">\n"
        )?;
        let mut file = Announced {
            to,
            arrays: Vec::new(),
            offset: 0,
        };
        file.fields("PointData", &self.at_points)?;
        file.fields("CellData", &self.at_cells)?;
        writeln!(file.to, "<Points>")?;
        file.array("Points", 3, Values::Float64(&self.points))?;
        writeln!(file.to, "</Points>\n<Cells>")?;
        file.array("connectivity", 1, Values::Int64(&self.corners))?;
        file.array("offsets", 1, Values::Int64(&ends))?;
        file.array("types", 1, Values::UInt8(&shapes))?;
        write!(
            file.to,
            "</Cells>\n</Piece>\n</UnstructuredGrid>\n<AppendedData encoding=\"raw\">\n_"
        )?;
        for values in &file.arrays {
            values.write(file.to)?;
        }
        writeln!(file.to, "\n</AppendedData>\n</VTKFile>")
    }
}

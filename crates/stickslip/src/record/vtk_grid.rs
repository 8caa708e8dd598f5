//! Cells and fields in the shape that VTK's files have.

use nalgebra::SVector;
use stickslip_fem::Trace;
use vtkio::model::{Attribute, Attributes, CellType, Cells, UnstructuredGridPiece, VertexNumbers};

use crate::Snapshot;

/// Cells of one shape on points.
pub(super) fn grid<const D: usize>(
    points: &[SVector<f64, D>],
    connectivity: Vec<u64>,
    shape: CellType,
    data: Attributes,
) -> UnstructuredGridPiece {
    let corners = match shape {
        CellType::Line => 2,
        CellType::Triangle => 3,
        _ => 4,
    };
    let count = connectivity.len() / corners;
    let offsets = (1..=count).map(|n| (n * corners) as u64).collect();
    let points: Vec<f64> = points.iter().flat_map(in_space::<D, D>).collect();
    UnstructuredGridPiece {
        points: points.into(),
        cells: Cells {
            cell_verts: VertexNumbers::XML {
                connectivity,
                offsets,
            },
            types: vec![shape; count],
        },
        data,
    }
}

/// A field of vectors.
pub(super) fn vectors<'v, const C: usize, const D: usize>(
    name: &str,
    field: impl Iterator<Item = &'v SVector<f64, C>>,
) -> Attribute {
    let values: Vec<f64> = field.flat_map(in_space::<C, D>).collect();
    Attribute::vectors(name).with_data(values)
}

/// A vector in three dimensions; one component of a body in the plane is along z.
pub(super) fn in_space<const C: usize, const D: usize>(vector: &SVector<f64, C>) -> [f64; 3] {
    let first = if C == 1 && D == 2 { 2 } else { 0 };
    std::array::from_fn(|c| match c.checked_sub(first) {
        Some(c) => vector.get(c).copied().unwrap_or(0.0),
        None => 0.0,
    })
}

/// A contact with its fields.
pub(super) fn surface<const C: usize, const D: usize>(
    at: &Snapshot<'_, C>,
    contact: usize,
    trace: &Trace<D>,
) -> UnstructuredGridPiece {
    let contact = at.contact(contact);
    let scalar = |name: &str, of: &dyn Fn(usize) -> f64| {
        let values: Vec<f64> = (0..contact.len()).map(of).collect();
        Attribute::scalars(name, 1).with_data(values)
    };
    let tractions: Vec<SVector<f64, C>> = (0..contact.len()).map(|k| contact.traction(k)).collect();
    let point = vec![
        scalar("slip", &|k| contact.slip(k)),
        scalar("slip_rate", &|k| contact.slip_rate(k)),
        scalar("state", &|k| contact.state(k)),
        vectors::<C, D>("traction", tractions.iter()),
    ];
    let faces = trace.faces().iter().flatten().map(|&k| k as u64).collect();
    let shape = if D == 2 {
        CellType::Line
    } else {
        CellType::Triangle
    };
    let cell = Vec::new();
    grid(trace.points(), faces, shape, Attributes { point, cell })
}

//! Bodies and contacts as grids with fields.

use nalgebra::SVector;
use stickslip_fem::Trace;

use super::vtu::{Field, Grid, Kind, Shape};
use crate::Snapshot;

/// Points in three dimensions.
pub(super) fn places<const D: usize>(points: &[SVector<f64, D>]) -> Vec<f64> {
    points.iter().flat_map(in_space::<D, D>).collect()
}

/// A field of vectors.
pub(super) fn vectors<'v, const C: usize, const D: usize>(
    name: &'static str,
    field: impl Iterator<Item = &'v SVector<f64, C>>,
) -> Field {
    Field {
        name,
        kind: Kind::Vectors,
        values: field.flat_map(in_space::<C, D>).collect(),
    }
}

/// A vector in three dimensions; one component of a body in the plane is along z.
fn in_space<const C: usize, const D: usize>(vector: &SVector<f64, C>) -> [f64; 3] {
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
) -> Grid {
    let contact = at.contact(contact);
    let scalars = |name, of: &dyn Fn(usize) -> f64| Field {
        name,
        kind: Kind::Scalars,
        values: (0..contact.len()).map(of).collect(),
    };
    let tractions: Vec<SVector<f64, C>> = (0..contact.len()).map(|k| contact.traction(k)).collect();
    let mut at_points = vec![
        scalars("slip", &|k| contact.slip(k)),
        scalars("slip_rate", &|k| contact.slip_rate(k)),
        scalars("state", &|k| contact.state(k)),
        vectors::<C, D>("traction", tractions.iter()),
    ];
    if contact.field(0).is_some() {
        at_points.push(scalars("normal_stress", &|k| contact.normal_stress(k)));
        at_points.push(scalars("pore_pressure", &|k| contact.pore_pressure(k)));
    }
    for reading in contact.readings() {
        if let Some(values) = contact.reading(reading.name) {
            at_points.push(scalars(reading.name, &|k| values[k]));
        }
    }
    Grid {
        points: places(trace.points()),
        corners: trace.faces().iter().flatten().map(|&k| k as i64).collect(),
        shape: if D == 2 { Shape::Line } else { Shape::Triangle },
        at_points,
        at_cells: Vec::new(),
    }
}

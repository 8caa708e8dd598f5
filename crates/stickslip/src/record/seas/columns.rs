//! The columns of station files.

use super::{Column, SeasPoint};

const LINE: [Column<'static>; 4] = [
    ("t", "Time (s)"),
    ("slip", "Slip (m)"),
    ("slip_rate", "Slip rate (log10 m/s)"),
    ("shear_stress", "Shear stress (MPa)"),
];

const PLANE: [Column<'static>; 7] = [
    ("t", "Time (s)"),
    ("slip_2", "Slip_2 (m)"),
    ("slip_3", "Slip_3 (m)"),
    ("slip_rate_2", "Slip_rate_2 (log10 m/s)"),
    ("slip_rate_3", "Slip_rate_3 (log10 m/s)"),
    ("shear_stress_2", "Shear_stress_2 (MPa)"),
    ("shear_stress_3", "Shear_stress_3 (MPa)"),
];

/// The columns of a station, with its normal stress if it has that one.
pub(super) fn columns(point: SeasPoint, normal_stress: bool) -> Vec<Column<'static>> {
    let mut columns = match point {
        SeasPoint::Line(_) => LINE.to_vec(),
        SeasPoint::Plane(_) => PLANE.to_vec(),
    };
    if normal_stress {
        columns.push(("normal_stress", "Normal stress (MPa)"));
    }
    columns.push(("state", "State (log10 s)"));
    columns
}

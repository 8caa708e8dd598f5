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

const LINE_FLUID: [Column<'static>; 2] = [
    ("pore_pressure", "Pore pressure (MPa)"),
    ("darcy_vel", "Darcy velocity (m/s)"),
];

const PLANE_FLUID: [Column<'static>; 3] = [
    ("pore_pressure", "Pore pressure (MPa)"),
    ("darcy_vel_2", "Darcy_velocity_2 (m/s)"),
    ("darcy_vel_3", "Darcy_velocity_3 (m/s)"),
];

/// Columns that a station may have or not.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Chosen {
    pub normal_stress: bool,
    pub pore_fluid: bool,
}

/// The columns of a station.
pub(super) fn columns(point: SeasPoint, chosen: Chosen) -> Vec<Column<'static>> {
    let (mut columns, fluid) = match point {
        SeasPoint::Line(_) => (LINE.to_vec(), &LINE_FLUID[..]),
        SeasPoint::Plane(_) => (PLANE.to_vec(), &PLANE_FLUID[..]),
    };
    if chosen.normal_stress {
        columns.push(("normal_stress", "Normal stress (MPa)"));
    }
    if chosen.pore_fluid {
        columns.extend(fluid);
    }
    columns.push(("state", "State (log10 s)"));
    columns
}

//! The displacement at the start.

use nalgebra::SVector;
use stickslip_tnnmg::{LinearSolver, Operator};

use super::{Loads, SceneError};
use crate::contact::ContactSet;

/// The displacement with `A u = l` at a time, without friction, zero where it is fixed. The shear stress
/// that contacts have from the start is held by friction and deforms nothing.
pub(crate) fn equilibrium<Op: Operator<C>, const C: usize>(
    stiffness: &Op,
    fixed: &[[bool; C]],
    (loads, contacts): (&Loads<C>, &ContactSet<C>),
    time: f64,
    solver: &mut dyn LinearSolver<Op, C>,
) -> Result<Vec<SVector<f64, C>>, SceneError> {
    let size = stiffness.vertex_count();
    let mut load = vec![SVector::zeros(); size];
    loads.fill(time, &mut load, &mut loads.scratch(size));
    contacts.add_tractions(false, &mut load);
    super::check_field("load", &load, size)?;
    let mut displacement = vec![SVector::zeros(); size];
    solver.prepare(stiffness, fixed)?;
    solver.solve(stiffness, &load, &mut displacement)?;
    Ok(displacement)
}

//! The displacement in static equilibrium.

use nalgebra::SVector;
use stickslip_solvers::SolveError;

use crate::SceneError;
use crate::body::Matrices;
use crate::contact::ContactSet;
use crate::scene::Loads;

/// The displacement with `A u = l` at a time, zero at fixed components: without friction, or with stuck contacts if a
/// rigid-body mode of the body is free without them. Friction balances the initial shear stress of contacts, which
/// causes no deformation.
pub(crate) fn equilibrium<const C: usize>(
    matrices: &mut dyn Matrices<C>,
    fixed: &[[bool; C]],
    (loads, contacts): (&Loads<C>, &ContactSet<C>),
    time: f64,
) -> Result<Vec<SVector<f64, C>>, SceneError> {
    let size = matrices.stiffness().vertex_count();
    let mut load = vec![SVector::zeros(); size];
    loads.fill(time, &mut load, &mut loads.scratch(size));
    for contact in &contacts.contacts {
        contact.add_tractions(|k| contact.total_normal_stress(k), false, &mut load);
    }
    crate::scene::check_field("load", &load, size)?;
    let mut solve = |fixed: &[[bool; C]]| {
        let mut displacement = vec![SVector::zeros(); size];
        matrices.solve_equilibrium(fixed, &load, &mut displacement)?;
        Ok(displacement)
    };
    let mut closed = fixed.to_vec();
    for (k, &vertex) in contacts.vertices.iter().enumerate() {
        contacts.mark_normal(k, &mut closed[vertex]);
    }
    solve(&closed).or_else(|error| {
        // Friction may hold what nothing else does.
        let mut stuck = closed.clone();
        for (k, &vertex) in contacts.vertices.iter().enumerate() {
            contacts.mark_slip(k, &mut stuck[vertex]);
        }
        solve(&stuck).map_err(|_: SolveError| error.into())
    })
}

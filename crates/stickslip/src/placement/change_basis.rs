//! The change of a scene to the basis of its surfaces.

use stickslip_solvers::Basis;

use crate::SceneError;
use crate::body::Matrices;
use crate::scene::{Conditions, Initial};

/// Changes matrices and initial conditions to the unknowns of a basis.
pub(super) fn change_basis<const C: usize>(
    matrices: &mut dyn Matrices<C>,
    scene: &mut Conditions<C>,
    basis: &Basis<C>,
) -> Result<(), SceneError> {
    // Of several processes all change the operators, or none.
    if !matrices.stiffness().ranks().any(!basis.is_empty()) {
        return Ok(());
    }
    matrices.change_basis(basis, scene.turned)?;
    let Initial {
        displacement,
        velocity,
        acceleration,
        ..
    } = &mut scene.initial;
    for field in [displacement, velocity, acceleration] {
        if !field.is_empty() {
            basis.field_to_basis(field);
        }
    }
    Ok(())
}

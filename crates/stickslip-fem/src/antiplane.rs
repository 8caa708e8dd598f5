use nalgebra::Matrix1;

use crate::assembly::assemble;
use crate::{BlockMatrix, FemError, P1};

/// The stiffness of antiplane shear, (mu grad u, grad v) for displacements u and v out of the plane \[m\].
///
/// The blocks are numbers, integral of mu g_p . g_q [Pa m^(D-2)], with g_p the gradient of the hat
/// function of p. With D = 3 it is the scalar diffusion operator.
///
/// # Errors
///
/// [`FemError::ShearModulus`] unless mu \[Pa\] is positive and finite, and [`FemError::TooManyEntries`].
///
/// ```
/// use stickslip_fem::{P1, antiplane};
///
/// let space = P1::grid([2.0, 2.0], [2, 2])?;
/// let stiffness = antiplane(&space, 1.0)?;
/// // The five-point stencil at the centre, whatever the width of the grid.
/// assert_eq!(stiffness.get(4, 4).map(|block| block[0]), Some(4.0));
/// assert_eq!(stiffness.get(4, 1).map(|block| block[0]), Some(-1.0));
/// # Ok::<(), stickslip_fem::FemError>(())
/// ```
pub fn antiplane<const D: usize>(
    space: &P1<D>,
    shear_modulus: f64,
) -> Result<BlockMatrix<1>, FemError> {
    let stiff = shear_modulus.is_finite() && shear_modulus > 0.0;
    if !stiff {
        return Err(FemError::ShearModulus {
            value: shear_modulus,
        });
    }
    assemble(space, |cell, i, j| {
        Matrix1::new(shear_modulus * cell.volume * cell.gradients[i].dot(&cell.gradients[j]))
    })
}

use nalgebra::{Matrix1, SVector};

use stickslip_core::compiled;

use crate::assembly::{assemble, by_cell};
use crate::simplex::Simplex;
use crate::{Assembled, FemError, P1};

/// The stiffness of antiplane shear, (mu grad u, grad v) for displacements u and v out of the plane \[m\].
///
/// The blocks are numbers, integral of mu g_p . g_q [Pa m^(D-2)], with g_p the gradient of the hat
/// function of p. With D = 3 it is the scalar diffusion operator. With a viscosity [Pa s] in place of the
/// modulus it is the Kelvin-Voigt viscosity operator.
///
/// # Errors
///
/// [`FemError::Value`] unless mu \[Pa\] is positive and finite, and [`FemError::TooMany`].
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
) -> Result<Assembled<1>, FemError> {
    let modulus = checked(shear_modulus)?;
    scalar_form(space, &|_| modulus)
}

/// [`antiplane`] with a shear modulus that depends on the cell: by a function of its midpoint \[m\] and index.
///
/// # Errors
///
/// [`FemError::Value`] for the first cell whose modulus is out of range, and [`FemError::TooMany`].
pub fn antiplane_by_cell<const D: usize>(
    space: &P1<D>,
    shear_modulus: impl Fn(&SVector<f64, D>, usize) -> f64,
) -> Result<Assembled<1>, FemError> {
    let moduli = by_cell(space, shear_modulus, checked)?;
    scalar_form(space, &moduli)
}

fn checked(value: f64) -> Result<f64, FemError> {
    FemError::positive("shear modulus [Pa]", value)
}

compiled! {
    fn scalar_form<D in 2, 3>(
        space: &P1<D>,
        moduli: &(dyn Fn(usize) -> f64 + Sync),
    ) -> Result<Assembled<1>, FemError> {
        assemble(space, moduli, form)
    }
}

#[inline]
fn form<const D: usize>(modulus: &f64, cell: &Simplex<D>, i: usize, j: usize) -> Matrix1<f64> {
    Matrix1::new(modulus * cell.volume * cell.gradients[i].dot(&cell.gradients[j]))
}

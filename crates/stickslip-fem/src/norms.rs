use nalgebra::{SMatrix, SVector};

use crate::quadrature::rule;
use crate::simplex::{MAX_CORNERS, Simplex};
use crate::{FemError, P1};

/// The distance of a field from an exact function in L2, (integral of |u_h - u|^2)^(1/2).
///
/// The quadrature has degree 4 (D = 2) or 5 (D = 3) on each cell.
///
/// # Errors
///
/// [`FemError::Length`] unless the field has one value per vertex.
///
/// ```
/// use nalgebra::Vector1;
/// use stickslip_fem::{P1, l2_error};
///
/// let space = P1::grid([2.0, 1.0], [4, 2])?;
/// let one = space.interpolate(|_| Vector1::new(1.0));
/// let distance = l2_error(&space, &one, |_| Vector1::new(0.0))?;
/// assert!((distance - 2f64.sqrt()).abs() < 1e-14);
/// # Ok::<(), stickslip_fem::FemError>(())
/// ```
pub fn l2_error<const D: usize, const C: usize>(
    space: &P1<D>,
    field: &[SVector<f64, C>],
    exact: impl Fn(&SVector<f64, D>) -> SVector<f64, C>,
) -> Result<f64, FemError> {
    integrate(space, field, |cell, values, at| {
        let value = values
            .iter()
            .zip(at)
            .fold(SVector::zeros(), |sum, (u, &hat)| sum + u * hat);
        (value - exact(&cell.at(at))).norm_squared()
    })
    .map(f64::sqrt)
}

/// The distance of a field from an exact function in the H1 seminorm, (integral of |grad u_h - grad u|^2)^(1/2).
///
/// `exact_gradient` returns the matrix of d u_i / d x_j. Quadrature and errors as in [`l2_error`].
///
/// ```
/// use nalgebra::{Matrix1x2, Vector1};
/// use stickslip_fem::{P1, h1_error};
///
/// let space = P1::grid([2.0, 1.0], [4, 2])?;
/// let linear = space.interpolate(|x| Vector1::new(x[0] - 3.0 * x[1]));
/// assert!(h1_error(&space, &linear, |_| Matrix1x2::new(1.0, -3.0))? < 1e-13);
/// # Ok::<(), stickslip_fem::FemError>(())
/// ```
pub fn h1_error<const D: usize, const C: usize>(
    space: &P1<D>,
    field: &[SVector<f64, C>],
    exact_gradient: impl Fn(&SVector<f64, D>) -> SMatrix<f64, C, D>,
) -> Result<f64, FemError> {
    integrate(space, field, |cell, values, at| {
        let gradient = values
            .iter()
            .zip(&cell.gradients)
            .fold(SMatrix::zeros(), |sum, (u, hat)| sum + u * hat.transpose());
        (gradient - exact_gradient(&cell.at(at))).norm_squared()
    })
    .map(f64::sqrt)
}

/// The integral of a density that depends on the cell, the field at its corners and a barycentric point.
fn integrate<const D: usize, const C: usize>(
    space: &P1<D>,
    field: &[SVector<f64, C>],
    density: impl Fn(&Simplex<D>, &[SVector<f64, C>], &[f64; MAX_CORNERS]) -> f64,
) -> Result<f64, FemError> {
    let mesh = space.mesh();
    if field.len() != mesh.vertex_count() {
        return Err(FemError::Length {
            what: "vectors of a field on the mesh",
            expected: mesh.vertex_count(),
            found: field.len(),
        });
    }
    let mut values = [SVector::zeros(); MAX_CORNERS];
    let mut integral = 0.0;
    for corners in mesh.cells() {
        let cell = mesh.simplex(corners);
        for (value, &p) in values.iter_mut().zip(corners) {
            *value = field[p as usize];
        }
        let mean: f64 = rule(D)
            .iter()
            .map(|node| node.weight * density(&cell, &values[..=D], &node.at))
            .sum();
        integral += cell.volume * mean;
    }
    Ok(integral)
}

use nalgebra::SMatrix;

use crate::assembly::assemble;
use crate::{BlockMatrix, FemError, P1};

/// The consistent mass, (rho u, v), for fields of C components.
///
/// A cell of volume |T| adds rho |T| / ((D + 1)(D + 2)) to its off-diagonal blocks and twice that to its
/// diagonal ones, times the unit matrix \[kg\]. Its row sums are the lumped mass.
///
/// # Errors
///
/// [`FemError::Density`] unless rho [kg/m^D] is positive and finite, and [`FemError::TooManyEntries`].
///
/// ```
/// use stickslip_fem::{P1, mass};
///
/// let space = P1::grid([5.0, 1.0], [5, 1])?;
/// let mass = mass::<2, 1>(&space, 3.0)?;
/// let total: f64 = mass.data().iter().map(|block| block[0]).sum();
/// assert!((total - 15.0).abs() < 1e-13);
/// # Ok::<(), stickslip_fem::FemError>(())
/// ```
pub fn mass<const D: usize, const C: usize>(
    space: &P1<D>,
    density: f64,
) -> Result<BlockMatrix<C>, FemError> {
    let heavy = density.is_finite() && density > 0.0;
    if !heavy {
        return Err(FemError::Density { value: density });
    }
    let pairs = ((D + 1) * (D + 2)) as f64;
    assemble(space, |cell, i, j| {
        let times = if i == j { 2.0 } else { 1.0 };
        SMatrix::from_diagonal_element(times * density * cell.volume / pairs)
    })
}

/// The lumped mass: the row sums of [`mass`], a diagonal matrix.
///
/// # Errors
///
/// Those of [`mass`].
///
/// ```
/// use stickslip_fem::{P1, lumped_mass};
///
/// let space = P1::grid([5.0, 1.0], [5, 1])?;
/// let mass = lumped_mass::<2, 1>(&space, 3.0)?;
/// assert_eq!(mass.data().len(), space.vertex_count());
/// let total: f64 = mass.data().iter().map(|block| block[0]).sum();
/// assert!((total - 15.0).abs() < 1e-13);
/// # Ok::<(), stickslip_fem::FemError>(())
/// ```
pub fn lumped_mass<const D: usize, const C: usize>(
    space: &P1<D>,
    density: f64,
) -> Result<BlockMatrix<C>, FemError> {
    let consistent = mass::<D, 1>(space, density)?;
    let size = space.vertex_count();
    let values = consistent
        .outer_iterator()
        .map(|row| SMatrix::from_diagonal_element(row.iter().map(|(_, block)| block[0]).sum()))
        .collect();
    let rows = (0..=size as u32).collect();
    let columns = (0..size as u32).collect();
    Ok(BlockMatrix::new((size, size), rows, columns, values))
}

use nalgebra::{Matrix1, SMatrix, SVector};
use stickslip_core::compiled;

use crate::assembly::{assemble, by_cell};
use crate::simplex::Simplex;
use crate::sparse::block_diagonal;
use crate::{Assembled, BlockMatrix, FemError, P1};

/// The consistent mass, (rho u, v), for fields of C components.
///
/// A cell of volume |T| adds rho |T| / ((D + 1)(D + 2)) to its off-diagonal blocks and twice that to its
/// diagonal ones, times the unit matrix \[kg\]. Its row sums are the lumped mass.
///
/// # Errors
///
/// [`FemError::Value`] unless rho [kg/m^D] is positive and finite, and [`FemError::TooMany`].
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
) -> Result<Assembled<C>, FemError> {
    let density = checked(density)?;
    of_numbers(&numbers(space, &|_| density)?)
}

/// [`mass`] with a density that depends on the cell: by a function of its midpoint \[m\] and index.
///
/// # Errors
///
/// [`FemError::Value`] for the first cell whose density is out of range, and [`FemError::TooMany`].
///
/// ```
/// use stickslip_fem::{P1, mass_by_cell};
///
/// let space = P1::grid([2.0, 1.0], [2, 1])?;
/// let mass = mass_by_cell::<2, 1>(&space, |x, _| if x[0] < 1.0 { 3.0 } else { 5.0 })?;
/// let total: f64 = mass.data().iter().map(|block| block[0]).sum();
/// assert!((total - 8.0).abs() < 1e-13);
/// # Ok::<(), stickslip_fem::FemError>(())
/// ```
pub fn mass_by_cell<const D: usize, const C: usize>(
    space: &P1<D>,
    density: impl Fn(&SVector<f64, D>, usize) -> f64,
) -> Result<Assembled<C>, FemError> {
    let densities = by_cell(space, density, checked)?;
    of_numbers(&numbers(space, &densities)?)
}

/// The lumped mass: the row sums of [`mass`], a diagonal matrix.
///
/// # Errors
///
/// The errors of [`mass`].
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
) -> Result<Assembled<C>, FemError> {
    Ok(lumped(&mass(space, density)?))
}

/// [`lumped_mass`] with a density that depends on the cell: the row sums of [`mass_by_cell`], with its errors.
pub fn lumped_mass_by_cell<const D: usize, const C: usize>(
    space: &P1<D>,
    density: impl Fn(&SVector<f64, D>, usize) -> f64,
) -> Result<Assembled<C>, FemError> {
    Ok(lumped(&mass_by_cell(space, density)?))
}

fn checked(value: f64) -> Result<f64, FemError> {
    FemError::positive("density [kg/m^D]", value)
}

compiled! {
    /// The mass of one component: one number per block.
    fn numbers<D in 2, 3>(
        space: &P1<D>,
        densities: &(dyn Fn(usize) -> f64 + Sync),
    ) -> Result<Assembled<1>, FemError> {
        assemble(space, densities, form)
    }

    /// The same for all components.
    fn of_numbers<C>(numbers: &Assembled<1>) -> Result<Assembled<C>, FemError> {
        let blocks = numbers.data().iter();
        let blocks = blocks.map(|number| SMatrix::from_diagonal_element(number[0]));
        let (starts, columns) = (numbers.indptr().into_raw_storage().to_vec(), numbers.indices());
        let shape = (numbers.rows(), numbers.cols());
        let matrix = BlockMatrix::new(shape, starts, columns.to_vec(), blocks.collect());
        Ok(numbers.with(matrix))
    }
}

#[inline]
fn form<const D: usize>(density: &f64, cell: &Simplex<D>, i: usize, j: usize) -> Matrix1<f64> {
    let pairs = ((D + 1) * (D + 2)) as f64;
    let times = if i == j { 2.0 } else { 1.0 };
    Matrix1::new(times * density * cell.volume / pairs)
}

fn lumped<const C: usize>(consistent: &Assembled<1>) -> Assembled<C> {
    let row_sums = consistent
        .outer_iterator()
        .map(|row| SMatrix::from_diagonal_element(row.iter().map(|(_, block)| block[0]).sum()));
    consistent.with(block_diagonal(row_sums.collect()))
}

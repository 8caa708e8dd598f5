use nalgebra::SVector;

use crate::assembly::by_cell;
use crate::elasticity::isotropic_form;
use crate::{Assembled, FemError, P1};

/// An isotropic viscous material, in parallel with the elastic one (Kelvin-Voigt); in 2D under plane strain.
///
/// The viscous stress is `2 eta_s dev eps' + eta_b (tr eps') I`, with the deviator in three dimensions.
#[derive(Clone, Copy, Debug, PartialEq)]
#[doc(alias = "Kelvin-Voigt")]
pub struct Viscous {
    /// Shear viscosity eta_s >= 0 [Pa s].
    pub shear_viscosity: f64,
    /// Bulk viscosity eta_b >= 0 [Pa s].
    pub bulk_viscosity: f64,
}

impl Viscous {
    /// The viscosities in place of Lame's parameters: eta_b - 2/3 eta_s and eta_s [Pa s].
    ///
    /// # Errors
    ///
    /// [`FemError::Value`] for viscosities out of range.
    pub fn lame(&self) -> Result<(f64, f64), FemError> {
        for value in [self.shear_viscosity, self.bulk_viscosity] {
            FemError::non_negative("viscosity [Pa s]", value)?;
        }
        let lambda = self.bulk_viscosity - 2.0 / 3.0 * self.shear_viscosity;
        Ok((lambda, self.shear_viscosity))
    }
}

/// The Kelvin-Voigt viscosity of a body, (D eps(u'), eps(v)) for velocities u' [m/s]; its blocks are those of
/// [`elasticity`](crate::elasticity) with viscosities in place of moduli [Pa s m^(D-2)].
///
/// # Errors
///
/// The errors of [`Viscous::lame`], and [`FemError::TooMany`].
///
/// ```
/// use stickslip_fem::{P1, Viscous, viscosity};
///
/// let space = P1::grid([5.0, 1.0], [5, 1])?;
/// let material = Viscous { shear_viscosity: 1e3, bulk_viscosity: 0.0 };
/// assert_eq!(viscosity(&space, &material)?.rows(), space.vertex_count());
/// # Ok::<(), stickslip_fem::FemError>(())
/// ```
#[doc(alias = "Kelvin-Voigt")]
pub fn viscosity<const D: usize>(
    space: &P1<D>,
    material: &Viscous,
) -> Result<Assembled<D>, FemError> {
    let material = material.lame()?;
    isotropic_form(space, &|_| material)
}

/// [`viscosity`] with a material that depends on the cell: by a function of its midpoint \[m\] and index.
///
/// # Errors
///
/// [`FemError::Value`] for the first cell whose material is out of range, and [`FemError::TooMany`].
pub fn viscosity_by_cell<const D: usize>(
    space: &P1<D>,
    material: impl Fn(&SVector<f64, D>, usize) -> Viscous,
) -> Result<Assembled<D>, FemError> {
    let materials = by_cell(space, material, |material| material.lame())?;
    isotropic_form(space, &materials)
}

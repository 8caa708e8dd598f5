use nalgebra::{SMatrix, SVector};

use stickslip_core::compiled;

use crate::assembly::{assemble, by_cell};
use crate::simplex::Simplex;
use crate::{Assembled, FemError, P1};

/// An isotropic linearly elastic material; in 2D under plane strain.
///
/// ```
/// use stickslip_fem::Elastic;
///
/// let (lambda, mu) = Elastic { young_modulus: 2.5, poisson_ratio: 0.25 }.lame()?;
/// assert_eq!((lambda, mu), (1.0, 1.0));
/// # Ok::<(), stickslip_fem::FemError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Elastic {
    /// Young's modulus E > 0 \[Pa\].
    pub young_modulus: f64,
    /// Poisson's ratio -1 < nu < 1/2 [-].
    pub poisson_ratio: f64,
}

impl Elastic {
    /// The material of this density [kg/m^D] with pressure and shear wave speeds `c_p` and `c_s` [m/s]:
    ///
    /// ```text
    /// mu = rho c_s^2,    lambda + 2 mu = rho c_p^2
    /// ```
    ///
    /// ```
    /// use stickslip_fem::Elastic;
    ///
    /// let rock = Elastic::of_waves(2670.0, 6000.0, 3464.0)?;
    /// assert!((rock.lame()?.1 / 32.038120320e9 - 1.0).abs() < 1e-12);
    /// # Ok::<(), stickslip_fem::FemError>(())
    /// ```
    ///
    /// # Errors
    ///
    /// [`FemError::Value`] for wave speeds that no material has.
    pub fn of_waves(density: f64, c_p: f64, c_s: f64) -> Result<Self, FemError> {
        let (shear, square) = (density * c_s * c_s, (c_s / c_p).powi(2));
        let poisson_ratio = (1.0 - 2.0 * square) / (2.0 - 2.0 * square);
        let material = Self {
            young_modulus: 2.0 * shear * (1.0 + poisson_ratio),
            poisson_ratio,
        };
        material.lame().map(|_| material)
    }

    /// Lame's parameters lambda = E nu / ((1 + nu)(1 - 2 nu)) and mu = E / (2 (1 + nu)) \[Pa\].
    ///
    /// # Errors
    ///
    /// [`FemError::Value`] for parameters out of range.
    pub fn lame(&self) -> Result<(f64, f64), FemError> {
        let Self {
            young_modulus: e,
            poisson_ratio: nu,
        } = *self;
        FemError::positive("Young's modulus [Pa]", e)?;
        let compressible = nu > -1.0 && nu < 0.5;
        FemError::check(
            "Poisson's ratio",
            "above -1 and below 1/2",
            nu,
            compressible,
        )?;
        Ok((
            e * nu / ((1.0 + nu) * (1.0 - 2.0 * nu)),
            e / (2.0 * (1.0 + nu)),
        ))
    }
}

/// The stiffness of an elastic body, (C eps(u), eps(v)) for displacements u and v \[m\].
///
/// With g_p the gradient of the hat function of p, its blocks are [Pa m^(D-2)]
///
/// ```text
/// A_pq = integral of lambda g_p g_q^T + mu g_q g_p^T + mu (g_p . g_q) I
/// ```
///
/// The Kelvin-Voigt [`viscosity`](crate::viscosity) operator is the same form.
///
/// # Errors
///
/// The errors of [`Elastic::lame`], and [`FemError::TooMany`].
///
/// ```
/// use nalgebra::Vector2;
/// use stickslip_fem::{Elastic, P1, elasticity};
///
/// let space = P1::grid([5.0, 1.0], [5, 1])?;
/// let stiffness = elasticity(&space, &Elastic { young_modulus: 5e7, poisson_ratio: 0.3 })?;
/// // A rigid shift costs nothing.
/// for row in stiffness.outer_iterator() {
///     let force: Vector2<f64> = row.iter().map(|(_, block)| block * Vector2::new(1.0, 2.0)).sum();
///     assert!(force.norm() < 1e-6);
/// }
/// # Ok::<(), stickslip_fem::FemError>(())
/// ```
pub fn elasticity<const D: usize>(
    space: &P1<D>,
    material: &Elastic,
) -> Result<Assembled<D>, FemError> {
    let material = material.lame()?;
    isotropic_form(space, &|_| material)
}

/// [`elasticity`] with a material that depends on the cell: by a function of its midpoint \[m\] and index.
///
/// # Errors
///
/// [`FemError::Value`] for the first cell whose material is out of range, and [`FemError::TooMany`].
///
/// ```
/// use stickslip_fem::{Elastic, P1, elasticity_by_cell};
///
/// // A soft layer under a hard one.
/// let space = P1::grid([5.0, 1.0], [10, 2])?;
/// let [soft, hard] = [1e7, 5e7].map(|young_modulus| Elastic { young_modulus, poisson_ratio: 0.3 });
/// let stiffness = elasticity_by_cell(&space, |x, _| if x[1] < 0.5 { soft } else { hard })?;
/// assert_eq!(stiffness.rows(), space.vertex_count());
/// # Ok::<(), stickslip_fem::FemError>(())
/// ```
pub fn elasticity_by_cell<const D: usize>(
    space: &P1<D>,
    material: impl Fn(&SVector<f64, D>, usize) -> Elastic,
) -> Result<Assembled<D>, FemError> {
    let materials = by_cell(space, material, |material| material.lame())?;
    isotropic_form(space, &materials)
}

compiled! {
    /// The form of Lame's parameters, which depend on the cell.
    pub(crate) fn isotropic_form<D in 2, 3>(
        space: &P1<D>,
        parameters: &(dyn Fn(usize) -> (f64, f64) + Sync),
    ) -> Result<Assembled<D>, FemError> {
        assemble(space, parameters, isotropic)
    }
}

/// The block of two corners by Lame's parameters.
#[inline]
fn isotropic<const D: usize>(
    &(lambda, mu): &(f64, f64),
    cell: &Simplex<D>,
    i: usize,
    j: usize,
) -> SMatrix<f64, D, D> {
    let (p, q) = (cell.gradients[i], cell.gradients[j]);
    let dot = p.dot(&q);
    SMatrix::from_fn(|k, l| {
        let shear = if k == l { mu * dot } else { 0.0 };
        cell.volume * (lambda * (p[k] * q[l]) + mu * (q[k] * p[l]) + shear)
    })
}

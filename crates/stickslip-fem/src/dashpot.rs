use nalgebra::{Matrix1, SMatrix, SVector};

use crate::fingerprint::{PART, same_mesh};
use crate::simplex::{combine, face_normal};
use crate::sparse::block_diagonal;
use crate::{Assembled, Elastic, FemError, P1, Trace};

/// Impedance of a boundary: stress over velocity [Pa s/m].
///
/// ```
/// use stickslip_fem::{Elastic, Impedance};
///
/// // lambda = mu = 1 Pa, so that rho c_p = (3 rho)^(1/2) and rho c_s = rho^(1/2).
/// let material = Elastic { young_modulus: 2.5, poisson_ratio: 0.25 };
/// let impedance = Impedance::of(&material, 3.0)?;
/// assert_eq!(impedance, Impedance { normal: 3.0, tangential: 3f64.sqrt() });
/// # Ok::<(), stickslip_fem::FemError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[doc(alias = "absorbing boundary")]
pub struct Impedance {
    /// Normal stress over normal velocity, >= 0 [Pa s/m].
    pub normal: f64,
    /// Shear stress over tangential velocity, >= 0 [Pa s/m].
    pub tangential: f64,
}

impl Impedance {
    /// The impedances rho c_p = (rho (lambda + 2 mu))^(1/2) and rho c_s = (rho mu)^(1/2) of an elastic material.
    ///
    /// # Errors
    ///
    /// The errors of [`Elastic::lame`], and [`FemError::Value`] unless rho [kg/m^D] is positive and finite.
    pub fn of(material: &Elastic, density: f64) -> Result<Self, FemError> {
        let (lambda, mu) = material.lame()?;
        FemError::positive("density [kg/m^D]", density)?;
        Ok(Self {
            normal: (density * (lambda + 2.0 * mu)).sqrt(),
            tangential: (density * mu).sqrt(),
        })
    }
}

/// The damping of an absorbing boundary (Lysmer's), a diagonal matrix [N s/m]: with impedances z_n and z_t
///
/// ```text
/// C_pp = sum over the faces F at p of  (area of F)/D [ z_n n n^T + z_t (I - n n^T) ]
/// ```
///
/// The impedance is a function of the midpoint of a face \[m\]. With that of the material, [`Impedance::of`], plane
/// waves at normal incidence leave the body; oblique ones are reflected in part. In a scene the matrix is a viscosity.
/// Source: J. Lysmer, R. Kuhlemeyer, "Finite dynamic model for infinite media", J. Eng. Mech. Div. ASCE 95 (1969).
///
/// # Errors
///
/// [`FemError::Mesh`] for a trace of another mesh, [`FemError::Value`] unless impedances are finite and
/// not negative.
///
/// ```
/// use stickslip_fem::{Elastic, Impedance, P1, dashpot};
///
/// let space = P1::grid([5.0, 1.0], [5, 1])?;
/// let side = space.trace(|x| x[0] == 5.0)?;
/// let impedance = Impedance::of(&Elastic { young_modulus: 5e7, poisson_ratio: 0.3 }, 5e3)?;
/// let damping = dashpot(&space, &side, |_| impedance)?;
/// let corner = damping.get(side.vertices()[0], side.vertices()[0]);
/// assert_eq!(corner.map(|block| block[(0, 0)]), Some(0.5 * impedance.normal));
/// # Ok::<(), stickslip_fem::FemError>(())
/// ```
#[doc(alias("absorbing boundary", "radiation damping", "Lysmer"))]
pub fn dashpot<const D: usize>(
    space: &P1<D>,
    trace: &Trace<D>,
    impedance: impl Fn(&SVector<f64, D>) -> Impedance,
) -> Result<Assembled<D>, FemError> {
    lumped(space, trace, |midpoint, normal| {
        let Impedance {
            normal: z_n,
            tangential: z_t,
        } = impedance(midpoint);
        let (z_n, z_t) = (checked(z_n)?, checked(z_t)?);
        let along = SMatrix::from_diagonal_element(z_t);
        Ok(along + normal * normal.transpose() * (z_n - z_t))
    })
}

/// [`dashpot`] for antiplane shear: the impedance rho c_s = (rho mu)^(1/2) [Pa s/m] as a function of the midpoint
/// of a face \[m\].
///
/// # Errors
///
/// The errors of [`dashpot`].
#[doc(alias("absorbing boundary", "radiation damping", "Lysmer"))]
pub fn antiplane_dashpot<const D: usize>(
    space: &P1<D>,
    trace: &Trace<D>,
    impedance: impl Fn(&SVector<f64, D>) -> f64,
) -> Result<Assembled<1>, FemError> {
    lumped(space, trace, |midpoint, _| {
        checked(impedance(midpoint)).map(Matrix1::new)
    })
}

/// Adds `density(midpoint, unit normal)` times its share of each face to the blocks of the face's vertices.
fn lumped<const D: usize, const C: usize>(
    space: &P1<D>,
    trace: &Trace<D>,
    density: impl Fn(&SVector<f64, D>, &SVector<f64, D>) -> Result<SMatrix<f64, C, C>, FemError>,
) -> Result<Assembled<C>, FemError> {
    same_mesh(PART, space.mesh().identity(), trace.mesh())?;
    let mut blocks = vec![SMatrix::zeros(); space.vertex_count()];
    for (face, &area) in trace.faces().iter().zip(trace.areas()) {
        let corners = face.map(|k| trace.points()[k]);
        let midpoint = combine(&corners, &[1.0 / D as f64; D]);
        let normal = face_normal(&corners) / area;
        let share = density(&midpoint, &normal)? * (area / D as f64);
        for &k in face {
            blocks[trace.vertices()[k]] += share;
        }
    }
    Ok(Assembled::on(space.mesh(), block_diagonal(blocks)))
}

fn checked(value: f64) -> Result<f64, FemError> {
    FemError::non_negative("impedance [Pa s/m]", value)
}

use nalgebra::SVector;

use crate::fingerprint::same_mesh;
use crate::sparse::block_diagonal;
use crate::{Assembled, FemError, P1};

/// A layer along the sides of a body that damps waves on their way out and back.
///
/// The damping rate grows with the square of the depth in the layer,
///
/// ```text
/// alpha(d) = alpha_0 (1 - d/w)^2,    alpha_0 = 3 c ln(1/R)/w
/// ```
///
/// with the distance `d` from the side: a wave of speed `c` at normal incidence returns with the share `R` of its amplitude,
/// whatever its frequency, and with `R^(1/cos theta)` at an angle. Slower waves return with less. Waves much longer than the
/// layer are reflected by its gradient. [`dashpot`](crate::dashpot)s at the side absorb most of what arrives there near
/// normal incidence: use both.
///
/// ```
/// use stickslip_fem::{P1, Sponge, lumped_mass, sponge};
///
/// // Along three sides of a half space below y = 2.
/// let space = P1::grid([6.0, 2.0], [12, 4])?;
/// let layer = Sponge::new(1.0, 3.0, 0.2)?;
/// let mass = lumped_mass::<2, 2>(&space, 1.0)?;
/// let damping = sponge(&space, &mass, |x| layer.rate(x[0].min(6.0 - x[0]).min(x[1])))?;
/// let centre = space.vertex_at([3.0, 1.5]).unwrap_or_default();
/// assert_eq!(damping.data()[centre][(0, 0)], 0.0);
/// # Ok::<(), stickslip_fem::FemError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
#[doc(alias("absorbing boundary", "damping layer"))]
pub struct Sponge {
    width: f64,
    /// `alpha_0` [1/s].
    rate: f64,
}

impl Sponge {
    /// A layer of the thickness `w > 0` \[m\], one wavelength and more, for waves of the speed `c > 0` [m/s], that of the
    /// fastest ones, of whose amplitude the share `R` returns, above 0 and below 1 [-].
    ///
    /// # Errors
    ///
    /// [`FemError::Value`] for numbers out of range.
    pub fn new(width: f64, speed: f64, returned: f64) -> Result<Self, FemError> {
        FemError::positive("width of a sponge [m]", width)?;
        FemError::positive("wave speed [m/s]", speed)?;
        let legal = returned > 0.0 && returned < 1.0;
        FemError::check(
            "amplitude that returns",
            "above 0 and below 1",
            returned,
            legal,
        )?;
        Ok(Self {
            width,
            rate: -3.0 * speed * returned.ln() / width,
        })
    }

    /// The damping rate `alpha` [1/s] at a distance from the nearest side \[m\]; 0 beyond the layer.
    pub fn rate(&self, distance: f64) -> f64 {
        self.rate * (1.0 - distance / self.width).clamp(0.0, 1.0).powi(2)
    }
}

/// Rayleigh damping by mass, `C = alpha M`, with a damping rate `alpha >= 0` [1/s] at each vertex by a function of its
/// position \[m\], such as [`Sponge::rate`], and a lumped mass: a viscosity for
/// `Scene::with_viscosity`. It is diagonal: explicit steps have it in their matrix, and their limit stays as it is.
///
/// # Errors
///
/// [`FemError::Mesh`] for a mass of another mesh, [`FemError::Value`] for a rate that is negative or not finite.
#[doc(alias("Rayleigh damping", "absorbing boundary"))]
pub fn sponge<const D: usize, const C: usize>(
    space: &P1<D>,
    mass: &Assembled<C>,
    rate: impl Fn(&SVector<f64, D>) -> f64,
) -> Result<Assembled<C>, FemError> {
    same_mesh("mass", space.mesh().identity(), mass.mesh())?;
    let vertices = space.mesh().vertices().iter().enumerate();
    let blocks = vertices.map(|(i, x)| {
        let rate = FemError::non_negative("damping rate [1/s]", rate(x))?;
        Ok(mass
            .get(i, i)
            .map_or_else(nalgebra::SMatrix::zeros, |own| own * rate))
    });
    let blocks = blocks.collect::<Result<Vec<_>, FemError>>()?;
    Ok(mass.with(block_diagonal(blocks)))
}

//! The slider of Pipping, Sander and Kornhuber: an elastic body on a rigid surface with a driven top.
//!
//! Source: E. Pipping, O. Sander, R. Kornhuber, "Variational formulation of rate- and state-dependent friction problems",
//! Z. Angew. Math. Mech. 95 (2015), Section 6.

use nalgebra::SVector;
use stickslip_fem::{Elastic, P1, Trace, body_force, elasticity, lumped_mass, mass};
use stickslip_friction::DieterichRuina;
use stickslip_solvers::BlockMatrix;
use stickslip_state::Dieterich;

use crate::{Components, Scene, SceneError};

/// The friction law.
pub const FRICTION: DieterichRuina = DieterichRuina {
    a: 0.010,
    b: 0.015,
    reference_friction: 0.6,
    reference_velocity: 1e-6,
    slip_distance: 1e-5,
};

/// The aging law.
pub const AGING: Dieterich = Dieterich {
    slip_distance: 1e-5,
};

/// The initial value of `ln(theta / 1 s)`.
pub const INITIAL_LOG_THETA: f64 = -10.0;

/// The normal stress at its own weight [N/m].
pub const NORMAL_STRESS: f64 = 49_050.0;

/// The end of the experiment \[s\].
pub const END: f64 = 15.0;

/// The velocity of the driven side [m/s]: it grows linearly until `END / 4` and stays at `2e-4`.
pub fn load_velocity(time: f64) -> f64 {
    2e-4 * (4.0 * time / END).min(1.0)
}

/// A body of 5 m x 1 m in plane strain with a frictional bottom, a driven top and free sides.
///
/// The default is the paper's. The caller adds the contact:
///
/// ```
/// use stickslip::problems::pipping_slider::{
///     AGING, FRICTION, INITIAL_LOG_THETA, NORMAL_STRESS, PippingSlider,
/// };
/// use stickslip::state::LogTheta;
/// use stickslip::{Components, Contact, Newmark, Simulation, Tnnmg};
///
/// let slider = PippingSlider { refinements: 2, ..PippingSlider::default() };
/// let space = slider.space()?;
/// let seam = Contact::new(&PippingSlider::bottom(&space)?, FRICTION, NORMAL_STRESS)
///     .with_state(AGING, LogTheta(INITIAL_LOG_THETA));
/// let scene = slider.scene(&space)?.with_contact(seam);
/// let solver = Tnnmg::new(space.transfers());
/// let mut simulation = Simulation::new(scene, Newmark::default(), solver)?;
/// assert!(simulation.step(1.5e-3).is_ok());
/// # Ok::<(), stickslip::SceneError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PippingSlider {
    /// The number of uniform refinements of five unit squares of two triangles each.
    pub refinements: usize,
    /// Diagonals from upper left to lower right instead of lower left to upper right.
    pub mirrored: bool,
    /// Gravitational acceleration, downwards [m/s^2].
    pub gravity: f64,
    /// Density [kg/m^2 in 2D].
    pub density: f64,
    /// Young's modulus and Poisson's ratio.
    pub elastic: Elastic,
    /// Whether the mass is lumped, for explicit schemes, or consistent.
    pub lumped: bool,
    /// Whether the initial acceleration is zero, as in the paper ([`Scene::with_zero_acceleration`]), or consistent.
    pub recurrent: bool,
}

impl Default for PippingSlider {
    fn default() -> Self {
        Self {
            refinements: 4,
            mirrored: false,
            gravity: 9.81,
            density: 5e3,
            elastic: Elastic {
                young_modulus: 5e7,
                poisson_ratio: 0.3,
            },
            lumped: false,
            recurrent: true,
        }
    }
}

impl PippingSlider {
    /// The refined mesh.
    ///
    /// # Errors
    /// [`SceneError::Fem`] for more refinements than indices can represent.
    pub fn space(&self) -> Result<P1<2>, SceneError> {
        let coarse = if self.mirrored {
            P1::mirrored_grid([5.0, 1.0], [5, 1])?
        } else {
            P1::grid([5.0, 1.0], [5, 1])?
        };
        Ok(coarse.refined(self.refinements)?)
    }

    /// The frictional boundary: the side `y = 0`.
    ///
    /// # Errors
    /// [`SceneError::Fem`] for a mesh of another body.
    pub fn bottom(space: &P1<2>) -> Result<Trace<2>, SceneError> {
        Ok(space.trace(|x| x[1] == 0.0)?)
    }

    /// The body with its loads and driven top, in equilibrium, without its contact.
    ///
    /// Multigrid computes the equilibrium; a factorisation without the feature `tnnmg`, and conjugate gradients without
    /// `condensed` as well.
    ///
    /// # Errors
    /// [`SceneError::Fem`] for material data out of range.
    pub fn scene(&self, space: &P1<2>) -> Result<Scene<BlockMatrix<2>, 2>, SceneError> {
        let weight = SVector::from([0.0, -self.density * self.gravity]);
        let mass = if self.lumped {
            lumped_mass(space, self.density)?
        } else {
            mass(space, self.density)?
        };
        #[cfg(feature = "tnnmg")]
        let equilibrium = stickslip_solvers::MultigridSolver::new(space.transfers());
        #[cfg(all(feature = "condensed", not(feature = "tnnmg")))]
        let equilibrium = stickslip_solvers::Cholesky::new();
        #[cfg(not(any(feature = "tnnmg", feature = "condensed")))]
        let equilibrium = stickslip_solvers::ConjugateGradients::default();
        let scene = Scene::new(elasticity(space, &self.elastic)?)
            .on(space)
            .with_mass(mass)
            .with_load(body_force(space, |_| weight))
            .prescribe_velocity(&Self::top(space)?, Components::ALL, |time| {
                [load_velocity(time), 0.0]
            })
            .in_equilibrium(equilibrium);
        Ok(if self.recurrent {
            scene.with_zero_acceleration()
        } else {
            scene
        })
    }

    /// The driven side, `y = 1 m`.
    ///
    /// # Errors
    /// [`SceneError::Fem`] for a mesh of another body.
    pub fn top(space: &P1<2>) -> Result<Trace<2>, SceneError> {
        Ok(space.trace(|x| x[1] == 1.0)?)
    }

    /// The vertex `x0` at the middle of the bottom, where histories are recorded.
    pub fn centre(space: &P1<2>) -> Option<usize> {
        space.vertex_at([2.5, 0.0])
    }
}

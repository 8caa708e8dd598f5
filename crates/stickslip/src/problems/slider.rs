//! The paper's slider: an elastic body on a rigid surface, pulled at its top.

use nalgebra::SVector;
use stickslip_fem::{Elastic, P1, Trace, body_force, elasticity, mass};
use stickslip_friction::Tresca;
use stickslip_tnnmg::BlockMatrix;

use super::load_velocity;
use crate::{Scene, SceneError};

/// A body of 5 m x 1 m in plane strain; the bottom slides, the top is moved, the sides are free.
///
/// The default is the paper's. Friction and state are left to the caller:
///
/// ```
/// use stickslip::problems::{AGING, FRICTION, INITIAL_LOG_THETA, NORMAL_STRESS, Slider};
/// use stickslip::state::LogTheta;
/// use stickslip::{Newmark, Simulation, Stepper, Tnnmg};
///
/// # fn main() -> Result<(), stickslip::SceneError> {
/// let slider = Slider { refinements: 2, ..Slider::default() };
/// let space = slider.space()?;
/// let scene = slider
///     .scene(&space)?
///     .with_friction(&Slider::bottom(&space)?, FRICTION, NORMAL_STRESS)
///     .with_state(AGING, LogTheta(INITIAL_LOG_THETA));
/// let solver = Tnnmg::new(space.hierarchy().prolongations());
/// let mut simulation = Simulation::new(scene, Newmark::default(), solver)?;
/// assert!(simulation.step(1.5e-3).is_ok());
/// # Ok(())
/// # }
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Slider {
    /// Uniform refinements of five unit squares of two triangles each.
    pub refinements: usize,
    /// Diagonals from upper left to lower right instead of lower left to upper right.
    pub mirrored: bool,
    /// Gravitational acceleration, downwards [m/s^2].
    pub gravity: f64,
    /// Density [kg/m^2 in 2D].
    pub density: f64,
    /// Young's modulus and Poisson's ratio.
    pub elastic: Elastic,
}

impl Default for Slider {
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
        }
    }
}

impl Slider {
    /// The refined mesh.
    ///
    /// # Errors
    /// [`SceneError::Fem`] for more refinements than indices can count.
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

    /// The body with its supports and loads, in equilibrium; friction and state are still missing.
    ///
    /// # Errors
    /// [`SceneError::Fem`] for material data out of range.
    pub fn scene(&self, space: &P1<2>) -> Result<Scene<BlockMatrix<2>, Tresca, (), 2>, SceneError> {
        let weight = SVector::from([0.0, -self.density * self.gravity]);
        let top = space.trace(|x| x[1] == 1.0)?;
        Ok(Scene::new(elasticity(space, &self.elastic)?)
            .with_mass(mass(space, self.density)?)
            .with_load(body_force(space, |_| weight))
            .hold(&Self::bottom(space)?, [false, true])
            .move_at(&top, [true, true], |time| [load_velocity(time), 0.0])
            .in_equilibrium())
    }

    /// The vertex `x0` at the middle of the bottom, where histories are recorded.
    pub fn centre(space: &P1<2>) -> Option<usize> {
        space.vertex_at([2.5, 0.0])
    }
}

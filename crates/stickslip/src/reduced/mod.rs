//! Craig-Bampton reduction of a body to its contacts: static responses, and the lowest modes.

mod body;
mod build;
mod left_out;
mod marks;
mod projector;
#[cfg(feature = "checkpoint")]
mod saved;
mod start;
mod support;
mod whole;

pub use body::ReducedBody;

use stickslip_solvers::BlockMatrix;

use crate::{Scene, SceneError};

/// Reduces a body to the vertices of its contacts.
///
/// Friction sees of a body how its surface answers. With `y` the displacement of the vertices of contacts, `h` that of
/// driven parts and `q` the amplitudes of the lowest modes with all these at rest,
///
/// ```text
/// u = E y + H h + Phi q,   Phi^T A Phi = omega^2 Phi^T M Phi,   A (E, H) in equilibrium
/// ```
///
/// (R. Craig, M. Bampton, AIAA J. 6 (1968)). Stiffness, mass, viscosity, loads and start are those of the body on these
/// fields; contacts, fixed and driven parts stay what they are. A step then costs what dense products with the contact's
/// size do. What higher modes do beyond following at once is left out ([`ReducedBody::left_out`]). A scene without inertia needs none, and is exact.
///
/// Do not reduce where waves shorter than the time step resolves matter, as in a rupture on a surface that is large
/// against its process zone; where absorbing sides do most of the damping; or where a contact has so many vertices that
/// its dense matrices do not fit.
///
/// ```
/// use stickslip::problems::{AGING, FRICTION, INITIAL_LOG_THETA, NORMAL_STRESS, Slider};
/// use stickslip::state::LogTheta;
/// use stickslip::reduced::Reduced;
/// use stickslip::{Contact, DenseNewton, GeneralizedAlpha, Simulation, Steps};
///
/// let slider = Slider { refinements: 2, ..Slider::default() };
/// let space = slider.space()?;
/// let seam = Contact::new(&Slider::bottom(&space)?, FRICTION, NORMAL_STRESS)
///     .with_state(AGING, LogTheta(INITIAL_LOG_THETA));
/// let scene = slider.scene(&space)?.with_contact(seam);
/// let body = Reduced::new(&scene).up_to_frequency(75.0)?;
/// let mut simulation = Simulation::new(body.reduce(scene)?, GeneralizedAlpha::default(), DenseNewton::new())?;
/// simulation.run(&Steps::constant(1.5e-3).count(100), |_| ())?;
/// // The whole body as it is now.
/// let displacement = body.displacement(&simulation.snapshot())?;
/// assert_eq!(displacement.len(), space.vertex_count());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone)]
#[doc(alias("Craig-Bampton", "model reduction", "substructuring"))]
pub struct Reduced<'a, const C: usize> {
    scene: &'a Scene<BlockMatrix<C>, C>,
    kept: Vec<usize>,
    memory_limit: usize,
}

impl<'a, const C: usize> Reduced<'a, C> {
    /// The body of a scene with contacts, fixed and driven parts.
    pub fn new(scene: &'a Scene<BlockMatrix<C>, C>) -> Self {
        Self {
            scene,
            kept: Vec::new(),
            memory_limit: 4 << 30,
        }
    }

    /// Keeps these vertices, too: to see them in every step, or to load them.
    #[must_use]
    pub fn retaining(mut self, vertices: impl IntoIterator<Item = usize>) -> Self {
        self.kept.extend(vertices);
        self
    }

    /// Sets the memory that the factor of the interior may take \[byte\]. The default is 4 GiB.
    #[must_use]
    pub fn with_memory_limit(mut self, bytes: usize) -> Self {
        self.memory_limit = bytes;
        self
    }

    /// With the modes up to a frequency \[Hz\]; infinity for all of them. Without inertia there is none.
    ///
    /// # Errors
    /// [`SceneError`]: a scene that no simulation would take, one that cannot be reduced
    /// ([`SceneError::Unreducible`]), a frequency below the first mode ([`SceneError::BelowModes`]), no memory.
    pub fn up_to_frequency(self, frequency: f64) -> Result<ReducedBody<C>, SceneError> {
        build::build(&self, build::Modes::UpTo(frequency))
    }

    /// With the modes that steps of `dt` \[s\] follow, and that a surface which slips as a whole excites: up to
    ///
    /// ```text
    /// min(sqrt(12 * 0.2)/(2 pi dt), 5.5 f_1)
    /// ```
    ///
    /// Newmark's scheme makes the period of a vibration longer by `(omega dt)^2/12`: modes for which that is more than
    /// 0.2 are the step's rather than the body's. 5.5 times the frequency `f_1` of the first mode is a measured bound:
    /// with it the slider of the paper slips first within 5e-7 s of the whole body.
    ///
    /// # Errors
    /// Those of [`up_to_frequency`](Reduced::up_to_frequency), but for a frequency below the first mode: there are none then.
    pub fn for_time_step(self, dt: f64) -> Result<ReducedBody<C>, SceneError> {
        build::build(&self, build::Modes::Resolved(dt))
    }
}

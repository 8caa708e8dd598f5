//! Craig-Bampton reduction of a body to its contacts: static responses and the lowest modes.

mod body;
mod build;
mod follow;
mod left_out;
mod loads;
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

/// Craig-Bampton reduction of a body to the vertices of its contacts: the cost per step depends on the number of fault
/// nodes.
///
/// Friction sees the body only through its boundary compliance. With `y` the displacement of the vertices of contacts,
/// `h` that of driven parts and `q` the amplitudes of the lowest modes with all these at rest,
///
/// ```text
/// u = E y + H h + Phi q,   Phi^T A Phi = omega^2 Phi^T M Phi,   A (E, H) in equilibrium
/// ```
///
/// (R. Craig, M. Bampton, AIAA J. 6 (1968)). Stiffness, mass, viscosity, loads and initial conditions are those of the
/// body on these fields; contacts, fixed and driven parts are unchanged. A step then costs dense products of the
/// contact's size. The inertia of higher modes is neglected; they respond statically ([`ReducedBody::left_out`]). A
/// scene without inertia needs no modes, and is exact. Where a normal stress comes from the body, the fixed normal
/// displacements belong to `y`, and their reactions are those of the body; they start in equilibrium, and with inertia may
/// not open.
///
/// Do not reduce where waves at the resolution limit of the time step matter, as in a rupture on a surface much larger
/// than its cohesive zone; where absorbing boundaries provide most of the damping; or where the dense matrices of a
/// large contact do not fit in memory.
///
/// ```
/// use stickslip::problems::pipping_slider::{AGING, FRICTION, INITIAL_LOG_THETA, NORMAL_STRESS, PippingSlider};
/// use stickslip::state::LogTheta;
/// use stickslip::reduced::Reduced;
/// use stickslip::{Contact, DenseNewton, GeneralizedAlpha, Simulation, Steps};
///
/// let slider = PippingSlider { refinements: 2, ..PippingSlider::default() };
/// let space = slider.space()?;
/// let seam = Contact::new(&PippingSlider::bottom(&space)?, FRICTION, NORMAL_STRESS)
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
    /// Prepares the reduction of a scene with contacts, fixed and driven parts.
    pub fn new(scene: &'a Scene<BlockMatrix<C>, C>) -> Self {
        Self {
            scene,
            kept: Vec::new(),
            memory_limit: 4 << 30,
        }
    }

    /// Retains the degrees of freedom of further vertices, for observation in every step or for loads; of a periodic
    /// boundary those of its first side.
    #[must_use]
    pub fn with_vertices(mut self, vertices: impl IntoIterator<Item = usize>) -> Self {
        self.kept.extend(vertices);
        self
    }

    /// Limits the memory of the factor of the interior \[byte\]. The default is 4 GiB.
    #[must_use]
    pub fn with_memory_limit(mut self, bytes: usize) -> Self {
        self.memory_limit = bytes;
        self
    }

    /// Retains the modes up to a frequency \[Hz\]; infinity for all of them. A body without inertia has no modes.
    ///
    /// # Errors
    /// [`SceneError`]: a scene that is invalid, one that cannot be reduced ([`SceneError::Unsupported`]), a frequency
    /// below the first mode ([`SceneError::BelowModes`]), insufficient memory.
    pub fn up_to_frequency(self, frequency: f64) -> Result<ReducedBody<C>, SceneError> {
        build::build(&self, build::Modes::UpTo(frequency))
    }

    /// Retains the modes that steps of `dt` \[s\] resolve and that uniform slip of the surface excites: up to
    ///
    /// ```text
    /// min(sqrt(12 * 0.2)/(2 pi dt), 5.5 f_1)
    /// ```
    ///
    /// Newmark's scheme makes the period of a vibration longer by `(omega dt)^2/12`: modes for which this exceeds 0.2
    /// reflect the step rather than the body. 5.5 times the frequency `f_1` of the first mode is a measured bound: with
    /// it the slider of the paper slips first within 5e-7 s of the whole body.
    ///
    /// # Errors
    /// Those of [`up_to_frequency`](Reduced::up_to_frequency), except for a frequency below the first mode: no mode is
    /// then retained.
    pub fn for_time_step(self, dt: f64) -> Result<ReducedBody<C>, SceneError> {
        build::build(&self, build::Modes::Resolved(dt))
    }
}

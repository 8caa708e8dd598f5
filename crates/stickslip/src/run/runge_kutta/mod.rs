//! Rate and state as an ordinary differential equation: an explicit Runge-Kutta method of order 5.

mod step;
mod stepper;
mod tableau;

use nalgebra::{SMatrix, SVector};

use crate::contact::ContactSet;
use crate::scene::Loads;
use crate::{
    Failure, Point, Run, RunReport, Scene, SceneError, Simulation, Snapshot, StepState, Steps,
    Verdict,
};
use tableau::STAGES;

/// A scene of one vertex without inertia, integrated as the differential equation
///
/// ```text
/// u' = v(u, alpha, t),   alpha' = g(alpha, abs(v)),   where  C v + friction(v, alpha) = l(t) - A u
/// ```
///
/// by the method of Dormand and Prince of order 5 with its error estimate of order 4 (J. Dormand,
/// P. Prince, J. Comput. Appl. Math. 6 (1980)). A state that follows the normal stress is integrated in the variable
/// that does not. The slip rate is the closed form of the local
/// problem; nothing is iterated. With [adaptive steps](Steps::adaptive) this was measured to be the
/// fastest way through the earthquake cycles of a spring slider at any accuracy; an implicit
/// [`Simulation`] is the choice for fixed steps, inertia and stiff states.
///
/// ```
/// use stickslip::problems::{AGING, FRICTION, LoadPath, SpringSlider};
/// use stickslip::{RungeKutta, Steps};
///
/// let slider = SpringSlider {
///     stiffness: 2.5e8,
///     normal_stress: 1e6,
///     mass: 0.0,
///     damping: 5e6,
///     load: LoadPath::steady(1e-6),
/// };
/// let mut cycle = RungeKutta::new(slider.steady(FRICTION, AGING, 1.1e-6)?)?;
/// let mut peak: f64 = 0.0;
/// let report = cycle.run(&Steps::adaptive(1e-5).until(600.0), |at| {
///     peak = peak.max(at.max_slip_rate());
/// })?;
/// assert!(peak > 1e-3 && report.accepted < 500);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub struct RungeKutta<const C: usize> {
    stiffness: SMatrix<f64, C, C>,
    viscosity: SMatrix<f64, C, C>,
    loads: Loads<C>,
    contacts: ContactSet<C>,
    now: StepState<C>,
    last: StepState<C>,
    /// `(u', alpha')` at the stages of the last step. The last of them is the first of the next.
    slopes: [(SVector<f64, C>, f64); STAGES],
    accepted: bool,
}

impl<const C: usize> RungeKutta<C> {
    /// Checks the scene and computes its first slip rate.
    ///
    /// # Errors
    /// [`SceneError`]; [`SceneError::Explicit`] for a scene with mass, without a contact or with several, with
    /// held or moved components, or whose contact has no slip rate at the first time.
    pub fn new(scene: Scene<SMatrix<f64, C, C>, C>) -> Result<Self, SceneError> {
        for (holds, requirement) in [
            (scene.mass.is_none(), "a scene without mass"),
            (scene.contacts.len() == 1, "one contact"),
            (scene.prescribed.is_empty(), "all components free"),
            (
                scene.initial.equilibrium.is_none(),
                "an initial displacement that is given",
            ),
        ] {
            if !holds {
                return Err(SceneError::Explicit { requirement });
            }
        }
        // Checked, and put in order, as for implicit steps.
        let Simulation {
            scene,
            loads,
            contacts,
            state: now,
            ..
        } = Simulation::new(scene, stickslip_time::BackwardEuler, Point)?;
        let mut integrator = Self {
            stiffness: scene.stiffness,
            viscosity: scene
                .viscosity
                .first()
                .copied()
                .unwrap_or_else(SMatrix::zeros),
            loads,
            contacts,
            last: now.clone(),
            now,
            slopes: [(SVector::zeros(), 0.0); STAGES],
            accepted: false,
        };
        integrator.begin()?;
        Ok(integrator)
    }

    /// The slopes of the present state, from which the next step starts.
    fn begin(&mut self) -> Result<(), SceneError> {
        let (time, u, state) = (
            self.now.clock.time(),
            self.now.displacement[0],
            self.state(),
        );
        let start = self.slope(time, u, state);
        self.slopes[0] = start.map_err(|_| SceneError::Explicit {
            requirement: "a finite slip rate at the first time",
        })?;
        self.now.velocity[0] = self.slopes[0].0;
        self.accepted = false;
        Ok(())
    }

    /// Takes the steps of a plan and shows each accepted one to `observe`, see [`Run::run`].
    ///
    /// # Errors
    /// Those of [`Run::run`].
    pub fn run<V: Verdict>(
        &mut self,
        steps: &Steps,
        observe: impl FnMut(Snapshot<'_, C>) -> V,
    ) -> Result<RunReport, Failure> {
        Run::run(self, steps, observe)
    }

    /// The last accepted step, as seen.
    pub fn snapshot(&self) -> Snapshot<'_, C> {
        Snapshot::new(&self.now, self)
    }
}

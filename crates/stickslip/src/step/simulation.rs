//! A scene in motion, its last accepted step, and the way back to it.

use nalgebra::SVector;
use stickslip_tnnmg::{NonsmoothSolver, Operator};

use super::operators::Operators;
use super::{Accelerations, Following, Method, Seen, Snapshot, StepState, Trial};
use crate::SceneError;
use crate::contact::ContactSet;
use crate::run::Comparison;
use crate::scene::{Constraints, Loads, Scene};

/// A scene in motion: scene, scheme, solver and coupling, and the last accepted step.
///
/// ```text
/// (u, v, a, alpha) -> (u^, a^) -> r = l - M a^ - A u^ -> { alpha from v, v from alpha } -> (u, v, a, alpha)
/// ```
///
/// Laws, scheme and solver are not in its type: a `Simulation<BlockMatrix<2>, 2>` is any scene in the plane.
/// It is [`Send`]. The operator `c_a M + C + c_u A` is formed anew only when the step size changes; steps
/// allocate nothing.
///
/// Stored in a struct, passed to a function, moved into a thread:
///
/// ```
/// use nalgebra::SMatrix;
/// use stickslip::friction::Tresca;
/// use stickslip::{Contact, Failure, Newmark, Part, Point, Scene, SceneError, Simulation, Steps};
///
/// struct Fault {
///     simulation: Simulation<SMatrix<f64, 1, 1>, 1>,
/// }
///
/// fn fault(stiffness: f64) -> Result<Fault, SceneError> {
///     let scene = Scene::new(SMatrix::<f64, 1, 1>::new(stiffness))
///         .with_contact(Contact::new(Part::point(1.0), Tresca { coefficient: 0.6 }, 1e5))
///         .with_load_history(move |time, load| load[0][0] = stiffness * 1e-3 * time);
///     Ok(Fault { simulation: Simulation::new(scene, Newmark::default(), Point)? })
/// }
///
/// fn slip(fault: &mut Fault) -> Result<f64, Failure> {
///     fault.simulation.run(&Steps::constant(1.0).until(100.0), |_| ())?;
///     Ok(fault.simulation.snapshot().contact(0).slip(0))
/// }
///
/// let mut fault = fault(1e6)?;
/// let slipped = std::thread::spawn(move || slip(&mut fault)).join().expect("no panic")?;
/// assert!((slipped - 0.04).abs() < 1e-3);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// Scheme and solver chosen at run time:
///
/// ```
/// use stickslip::fem::{P1, antiplane, mass};
/// use stickslip::friction::Tresca;
/// use stickslip::{BackwardEuler, BlockMatrix, Condensed, Contact, Newmark, NonsmoothSolver};
/// use stickslip::{RateScheme, Scene, Simulation, Tnnmg};
///
/// # let (damped, direct) = (true, false);
/// let space = P1::grid([1.0, 1.0], [2, 2])?;
/// let bottom = space.trace(|x| x[1] == 0.0)?;
/// let scene = Scene::new(antiplane(&space, 1e9)?)
///     .with_mass(mass(&space, 2e3)?)
///     .with_contact(Contact::new(&bottom, Tresca { coefficient: 0.6 }, 1e6));
/// let scheme: Box<dyn RateScheme> =
///     if damped { Box::new(BackwardEuler) } else { Box::new(Newmark::default()) };
/// let solver: Box<dyn NonsmoothSolver<BlockMatrix<1>, 1>> = if direct {
///     Box::new(Condensed::new())
/// } else {
///     Box::new(Tnnmg::new(space.transfers()))
/// };
/// let mut simulation = Simulation::new(scene, scheme, solver)?;
/// simulation.step(1e-3)?;
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub struct Simulation<Op: Operator<C>, const C: usize> {
    pub(crate) scene: Scene<Op, C>,
    pub(crate) loads: Loads<C>,
    pub(crate) constraints: Constraints<C>,
    pub(crate) contacts: ContactSet<C>,
    pub(crate) method: Method,
    pub(crate) solver: Box<dyn NonsmoothSolver<Op, C>>,
    pub(crate) operators: Operators<Op>,
    pub(crate) state: StepState<C>,
    /// The displacement from which the motion is measured: that of an initial equilibrium; empty for zero.
    pub(crate) equilibrium: Vec<SVector<f64, C>>,
    pub(crate) trial: Trial<C>,
    /// None without inertia, and where accelerations are left to the scheme.
    pub(crate) accelerations: Option<Accelerations<C>>,
    /// The last accepted step, while a step of several stages is under way.
    pub(crate) old: Option<Box<StepState<C>>>,
    /// Whether a solution may be followed through a step; else a step with several is refused.
    pub(crate) follows: bool,
    /// None where friction weakens nowhere.
    pub(crate) following: Option<Box<Following<C>>>,
    pub(crate) comparison: Option<Box<Comparison<C>>>,
    pub(crate) seen: Seen<C>,
}

impl<Op: Operator<C>, const C: usize> Simulation<Op, C> {
    /// The last accepted step, as seen.
    pub fn snapshot(&self) -> Snapshot<'_, C> {
        Snapshot::new(&self.state, self)
    }

    /// All that the next step depends on.
    pub fn state(&self) -> &StepState<C> {
        &self.state
    }

    /// Goes back, or ahead, to a state of this simulation or of another one of the same scene. With the same
    /// scheme, coupling and solver the steps from there on are the same bits.
    ///
    /// # Errors
    /// [`SceneError::Foreign`] for a state whose fields do not fit this scene.
    pub fn restore(&mut self, state: &StepState<C>) -> Result<(), SceneError> {
        state.check_fits(&self.state)?;
        self.set_state(state);
        self.seen.show(&self.state);
        if let Some(comparison) = &mut self.comparison {
            comparison.half_size = None;
            comparison.onset = (state.control.onset, 0);
        }
        Ok(())
    }

    /// [`restore`](Self::restore) of a state that is known to fit, and that nobody sees before it is shown.
    pub(crate) fn set_state(&mut self, state: &StepState<C>) {
        self.state.copy_from(state);
        self.contacts.set_normal_stress(&state.contacts);
        self.trial.balanced = None;
    }
}

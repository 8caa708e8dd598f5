//! A scene in time, with its last accepted step and the means to restore an earlier one.

mod compiled;

use std::cell::OnceCell;

use nalgebra::SVector;

use crate::integrate::Comparison;
use crate::step::{Problem, Span, Workspace};
use crate::view::GlobalFields;
use crate::{
    Convexity, Residuals, SceneError, Snapshot, StepError, StepFailure, StepReport, StepState,
};
use compiled::{convexity, copy, residuals, restore, take_step, view_of};

/// A scene in time: scene, scheme, solver, coupling and the last accepted state.
///
/// A step predicts, solves for rate and state, certifies that the solution is unique between the old and the new slip
/// rates ([`StepError::NotUnique`] otherwise), and corrects:
///
/// ```text
/// (u, v, a, alpha) -> (u^, a^) -> r = l - M a^ - A u^ -> { alpha = S(v), v = argmin J } -> certified -> (u, v, a, alpha)
/// ```
///
/// The default scheme is [`GeneralizedAlpha`](crate::GeneralizedAlpha). A scene without mass uses the first-order
/// counterpart of the given scheme, [`FirstOrderAlpha`](crate::FirstOrderAlpha) for the default.
///
/// Matrices, laws, scheme and solver are not part of its type: a `Simulation<2>` holds any scene in the plane, and a
/// `Vec<Simulation<2>>` whole and reduced bodies. It is [`Send`]. The operator `c_a M + C + c_u A` is assembled again only when the step size changes; steps allocate
/// nothing.
///
/// A simulation in a struct, passed to a function and moved into a thread:
///
/// ```
/// use nalgebra::SMatrix;
/// use stickslip::friction::Tresca;
/// use stickslip::{Contact, StepFailure, GeneralizedAlpha, BoundaryPart, Point, Scene, SceneError, Simulation, Steps};
///
/// struct Fault {
///     simulation: Simulation<1>,
/// }
///
/// fn fault(stiffness: f64) -> Result<Fault, SceneError> {
///     let scene = Scene::new(SMatrix::<f64, 1, 1>::new(stiffness))
///         .with_contact(Contact::new(BoundaryPart::point(1.0), Tresca { coefficient: 0.6 }, 1e5))
///         .with_load_history(move |time, load| load[0][0] = stiffness * 1e-3 * time);
///     Ok(Fault { simulation: Simulation::new(scene, GeneralizedAlpha::default(), Point)? })
/// }
///
/// fn slip(fault: &mut Fault) -> Result<f64, StepFailure> {
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
/// use stickslip::{BackwardEuler, BlockMatrix, Condensed, Contact, GeneralizedAlpha, NonsmoothSolver};
/// use stickslip::{RateScheme, Scene, Simulation, Tnnmg};
///
/// # let (damped, direct) = (true, false);
/// let space = P1::grid([1.0, 1.0], [2, 2])?;
/// let bottom = space.trace(|x| x[1] == 0.0)?;
/// let scene = Scene::new(antiplane(&space, 1e9)?)
///     .with_mass(mass(&space, 2e3)?)
///     .with_contact(Contact::new(&bottom, Tresca { coefficient: 0.6 }, 1e6));
/// let scheme: Box<dyn RateScheme> =
///     if damped { Box::new(BackwardEuler) } else { Box::new(GeneralizedAlpha::default()) };
/// let solver: Box<dyn NonsmoothSolver<BlockMatrix<1>, 1>> = if direct {
///     Box::new(Condensed::new())
/// } else {
///     Box::new(Tnnmg::new(space.transfers()))
/// };
/// let mut simulation = Simulation::new(scene, scheme, solver)?;
/// simulation.step(1e-3)?;
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub struct Simulation<const C: usize> {
    pub(crate) problem: Problem<C>,
    pub(crate) work: Workspace<C>,
    /// The last accepted step.
    pub(crate) state: StepState<C>,
    pub(crate) comparison: Option<Box<Comparison<C>>>,
    /// The last accepted step in coordinates.
    pub(crate) fields: GlobalFields<C>,
    /// Loads and tractions at its time, evaluated on demand.
    applied: OnceCell<Vec<SVector<f64, C>>>,
}

/// Laws and functions of time are shared, everything else is copied. Original and clone continue independently, with
/// the same steps bit for bit. The first step factorises the solver's operators again. A solver of a type that cannot
/// be cloned is missing in the clone: its steps fail until [`set_solver`](Simulation::set_solver) provides one.
///
/// ```
/// use stickslip::problems::spring_slider::{AGING, FRICTION, LoadPath, SpringSlider};
/// use stickslip::{GeneralizedAlpha, Point, Simulation};
///
/// # let load = LoadPath::steady(1e-5);
/// # let slider = SpringSlider { stiffness: 1e9, normal_stress: 1e6, mass: 0.0, damping: 0.0, load };
/// # let scene = slider.steady(FRICTION, AGING, 1e-6)?;
/// let mut block = Simulation::new(scene, GeneralizedAlpha::default(), Point)?;
/// block.step(0.1)?;
/// let mut branch = block.clone();
/// branch.step(0.2)?;
/// assert_eq!((block.state().clock.step(), branch.state().clock.step()), (1, 2));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
impl<const C: usize> Clone for Simulation<C> {
    fn clone(&self) -> Self {
        copy(self)
    }
}

impl<const C: usize> Simulation<C> {
    pub(crate) fn at(problem: Problem<C>, work: Workspace<C>, state: StepState<C>) -> Self {
        let mut fields = GlobalFields::new(problem.basis.clone());
        fields.show(&state);
        Self {
            problem,
            work,
            state,
            comparison: None,
            fields,
            applied: OnceCell::new(),
        }
    }

    /// Takes one step of `dt` \[s\]. A failed step is not split into substeps; [`run`](Self::run) does that.
    ///
    /// # Errors
    /// [`StepFailure`]; the last accepted step stays in place and another `dt` can be tried.
    pub fn step(&mut self, dt: f64) -> Result<StepReport, StepFailure> {
        take_step(self, dt)
    }

    /// Updates the fields in coordinates.
    pub(crate) fn show(&mut self) {
        self.applied.take();
        self.fields.show(&self.state);
    }

    /// A view of the last accepted step.
    pub fn snapshot(&self) -> Snapshot<'_, C> {
        Snapshot::new(&self.state, view_of(self))
    }

    /// The state that the next step depends on.
    pub fn state(&self) -> &StepState<C> {
        &self.state
    }

    /// Restores a state of this simulation or of another one of the same scene. With the same scheme, coupling and
    /// solver the steps from there on are the same bits.
    ///
    /// # Errors
    /// [`SceneError::Length`] for a state whose fields do not fit this scene, [`SceneError::Value`] for a time or a motion
    /// that is not finite.
    #[doc(alias = "restart")]
    pub fn restore(&mut self, state: &StepState<C>) -> Result<(), SceneError> {
        restore(self, state)
    }

    /// Whether a step of `dt` \[s\] from here is one convex problem for all slip rates up to `max_slip_rate` [m/s].
    /// Takes no step. The certificate of each step requires less: slip rates between the old and the new ones.
    ///
    /// Let `m_k` be the steepest weakening of the frictional force at vertex `k` over these slip rates, with its state
    /// advanced by the step's own [`StateUpdate`](crate::StateUpdate). The problem is convex, and has at most one
    /// solution with such slip rates, if
    ///
    /// ```text
    /// B - diag(m_k),   B = c_a M + C + c_u A,   m_k = -min over V of w_k abs(sigma_n) dmu(V, S(V))/dV
    /// ```
    ///
    /// is positive definite, tested by conjugate gradients. The condition is sufficient and not necessary: friction
    /// weakens as steeply at some slip rate only, and not at all nodes at once. `weakening > resistance` at one vertex
    /// violates it. The slope is sampled at slip rates 5 % apart, down to 1e-24 of the largest, and its minimum is
    /// refined. It depends on the states at the start of the step: evaluate it again when they have changed, after an
    /// event for instance. For a multi-stage scheme it is that of the first stage.
    ///
    /// For Dieterich's law `m_k` is below `b c w abs(sigma_n)/L` from any state, with `c = dt` for backward Euler and
    /// `c = dt/2` at the midpoint rate.
    ///
    /// ```
    /// use stickslip::problems::spring_slider::{AGING, FRICTION, LoadPath, SpringSlider};
    /// use stickslip::{Newmark, Point, Simulation};
    ///
    /// // Softer than b sigma_n/L = 1.5e9 Pa/m, so that only inertia makes a step convex.
    /// let load = LoadPath::steady(1e-6);
    /// let slider = SpringSlider { stiffness: 1e8, normal_stress: 1e6, mass: 1e5, damping: 0.0, load };
    /// let scene = slider.steady(FRICTION, AGING, 1e-6)?;
    /// let mut block = Simulation::new(scene, Newmark::default(), Point)?;
    /// let mut dt = 1.0;
    /// while !block.convexity(dt, 1.0)?.convex {
    ///     dt /= 2.0;
    /// }
    /// // 2 m/dt + K dt/2 > b sigma_n/L dt/2
    /// let limit = (4.0 * 1e5 / (1.5e9 - 1e8_f64)).sqrt();
    /// assert!(dt > 0.5 * limit && dt < 1.1 * limit);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`StepError::StepSize`] for a step that is not positive and finite, [`StepError::Control`] for such a slip rate,
    /// and the errors of the normal stress at the new time.
    pub fn convexity(&mut self, dt: f64, max_slip_rate: f64) -> Result<Convexity, StepError> {
        convexity(self, dt, max_slip_rate)
    }

    /// Evaluates the equations of the last step, which began at `from`: the balance of forces, the update formula of
    /// the scheme and the step of the state laws. For a multi-stage scheme, and for a [damped](StepReport::damped)
    /// step, only forces are evaluated; the others are NaN, since no state between the stages is stored.
    ///
    /// ```
    /// # use stickslip::problems::spring_slider::{AGING, FRICTION, LoadPath, SpringSlider};
    /// # use stickslip::{GeneralizedAlpha, Point, Simulation, Steps};
    /// # let slider = SpringSlider {
    /// #     stiffness: 1e9, normal_stress: 1e6, mass: 1e3, damping: 0.0, load: LoadPath::steady(1e-5),
    /// # };
    /// # let scene = slider.steady(FRICTION, AGING, 1e-6)?;
    /// let mut simulation = Simulation::new(scene, GeneralizedAlpha::default(), Point)?;
    /// let from = simulation.state().clone();
    /// simulation.step(0.1)?;
    /// let left = simulation.residuals(&from);
    /// assert!(left.force < 1e-12 * left.force_terms && left.state < 1e-12);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn residuals(&self, from: &StepState<C>) -> Residuals {
        residuals(self, from)
    }

    /// Loads and tractions at the time of the last step \[N\].
    pub(crate) fn applied_load(&self) -> &[SVector<f64, C>] {
        self.applied.get_or_init(|| {
            let (loads, size) = (&self.problem.loads, self.state.velocity.len());
            let mut load = vec![SVector::zeros(); size];
            let time = Span::seen(&self.state.clock, &self.problem.stops);
            loads.fill(time, &mut load, &mut loads.scratch(size));
            (self.work.contacts).add_tractions_of(&self.state.contacts, &mut load);
            load
        })
    }
}

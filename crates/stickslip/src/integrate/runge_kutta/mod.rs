//! An explicit Runge-Kutta method of order 5 for rate and state as an ordinary differential equation.

mod balance;
mod damping;
mod dense;
mod elastic;
mod error;
mod many_cells;
mod soft;
mod source;
mod stability;
mod step;
mod stepper;
mod stiffness;
mod tableau;
mod threads;

use nalgebra::{SMatrix, SVector};
use stickslip_core::compiled;
use stickslip_solvers::{MeshId, Operator};

use crate::body::Matrices;
use crate::contact::ContactSet;
use crate::placement::{self, Constraints, Placement};
use crate::scene::{Conditions, Loads};
use crate::view::{GlobalFields, StepView};
use crate::{
    Clock, IntoControlFlow, Run, RunReport, Scene, SceneError, Snapshot, StepError, StepFailure,
    StepState, Steps,
};
use dense::Dense;
use elastic::Elastic;
use many_cells::ManyCells;
use soft::SoftCells;
use stability::Resistances;
use tableau::STAGES;
use threads::Threads;

/// A scene without inertia in which every vertex has its own resistance to motion, integrated as the differential
/// equation
/// ```text
/// u' = v(u, alpha, t),   alpha' = g(alpha, abs(v)),   where  C v + friction(v, alpha) = l(t) - A u
/// ```
///
/// with a block diagonal `C`: a spring slider, or a quasi-dynamic fault. The method is that of Dormand and Prince of
/// order 5 with its error estimate of order 4 (J. Dormand, P. Prince, J. Comput. Appl. Math. 6 (1980)). A state that
/// depends on the normal stress is integrated in a variable that does not. The slip rate of a vertex is the closed form
/// of its local problem. There is no iteration, and the stiffness enters by products alone, six per step; it need not be
/// symmetric. The normal stress may follow the displacement
/// ([`Scene::with_normal_stress_change`](crate::Scene::with_normal_stress_change)). With [adaptive
/// steps](Steps::adaptive) this was measured to be the fastest method for earthquake cycles of a spring slider and of a
/// fault at any accuracy. Cells that lose their strength are implicit where they relax within the step: their slip rate is
/// then the mean one of the step. A step of constant size beyond the stability limit is refused
/// ([`StepError::Unstable`](crate::StepError::Unstable)). Use an implicit [`Simulation`](crate::Simulation) for fixed
/// steps, inertia, bodies with an interior and stiff states, with the stiffness of a fault as a dense matrix. With the
/// feature `rayon` products and friction of large planes share the threads of the pool, with the same bits on any number of
/// them; worker threads spin during a step.
///
/// ```
/// use stickslip::problems::spring_slider::{AGING, FRICTION, LoadPath, SpringSlider};
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
#[doc(alias("quasi-dynamic", "ODE"))]
pub struct RungeKutta<const C: usize> {
    matrices: Box<dyn Matrices<C>>,
    /// The body's mesh, if it is known.
    mesh: Option<MeshId>,
    loads: Loads<C>,
    constraints: Constraints<C>,
    contacts: ContactSet<C>,
    seen: GlobalFields<C>,
    /// `C` at each frictional vertex, with Dirichlet components removed.
    damping: Vec<SMatrix<f64, C, C>>,
    /// The vertices without friction, and the inverse of `C` on their free components.
    smooth: Vec<(usize, SMatrix<f64, C, C>)>,
    /// Whether the state of any contact depends on its normal stress.
    follows: bool,
    now: StepState<C>,
    last: StepState<C>,
    /// `(u', alpha')` at the stages of the last step. The last stage is the first of the next step.
    slopes: [Motion<C>; STAGES],
    /// `(u, alpha)` of a stage, and the difference of a step from the embedded method.
    stage: Motion<C>,
    error: Motion<C>,
    /// The contacts, if they are regularised friction of many cells.
    many_cells: Option<ManyCells<C>>,
    /// The cells that relax far faster than the rest.
    soft: SoftCells<C>,
    /// The resistance to an error of the displacement; none before the first step of a constant size.
    resistances: Option<Box<Resistances<C>>>,
    /// The elastic forces of the stages.
    elastic: Elastic<C>,
    /// The change of normal stresses in the error estimate; empty where none follows the displacement.
    clamped: Vec<f64>,
    /// The tractions of contacts beside friction \[N\], if none changes in time; else empty.
    tractions: Vec<SVector<f64, C>>,
    /// `l - A u` of the last stage.
    drive: Vec<SVector<f64, C>>,
    scratch: Vec<SVector<f64, C>>,
    /// The accepted step of `drive`.
    balanced: Option<Clock>,
    accepted: bool,
    /// Copies while times inside of a step are shown.
    dense: Option<Box<Dense<C>>>,
    threads: Threads,
    /// Times at which data can jump \[s\], increasing.
    stops: Vec<f64>,
}

/// The unknowns of the equation, or a change of them.
#[derive(Clone)]
struct Motion<const C: usize> {
    displacement: Vec<SVector<f64, C>>,
    /// The states of all contacts, one after the other.
    states: Vec<f64>,
}

impl<const C: usize> RungeKutta<C> {
    /// Checks the scene and computes its first slip rates.
    ///
    /// # Errors
    /// [`SceneError`]; [`SceneError::Unsupported`] for a scene with mass, or without slip rates at the first time;
    /// [`SceneError::Vertex`] for a viscosity that is not block diagonal, and for a vertex
    /// without viscosity where friction does not depend on the slip rate, or is absent.
    pub fn new<Op: Operator<C>>(scene: Scene<Op, C>) -> Result<Self, SceneError> {
        let (matrices, conditions) = scene.split();
        build(matrices, conditions)
    }

    /// The slopes of the present state, from which the next step starts.
    fn begin(&mut self) -> Result<(), SceneError> {
        self.stage.copy_from(&self.now);
        self.contacts.hold_fields(&self.now);
        let stiffness = self.matrices.stiffness();
        (self.elastic).at(0, stiffness, &self.stage.displacement);
        let start = self.evaluate(0, self.now.clock.time());
        start.map_err(|cause| match cause {
            StepError::Stage { .. } => SceneError::unsupported(
                SceneError::EXPLICIT,
                "a finite slip rate at the first time",
            ),
            cause => SceneError::Start(cause),
        })?;
        self.find_field_sources(0, self.now.clock.time());
        self.find_rates();
        self.remember_soft_cells();
        (self.elastic).of_first_rates(self.matrices.stiffness(), &self.slopes[0].displacement);
        (self.now.velocity).copy_from_slice(&self.slopes[0].displacement);
        self.balanced = Some(self.now.clock);
        self.accepted = false;
        self.seen.show(&self.now);
        Ok(())
    }

    /// Takes the steps of a plan and shows each accepted one to `observe`, see [`Run::run`].
    ///
    /// # Errors
    /// Those of [`Run::run`].
    pub fn run<V: IntoControlFlow>(
        &mut self,
        steps: &Steps,
        observe: impl FnMut(Snapshot<'_, C>) -> V,
    ) -> Result<RunReport, StepFailure> {
        Run::run(self, steps, observe)
    }

    /// A view of the last accepted step.
    pub fn snapshot(&self) -> Snapshot<'_, C> {
        Snapshot::new(&self.now, view_of(self))
    }
}

compiled! {
    /// An integrator whose matrices are not known by their type.
    fn build<C>(
        matrices: Box<dyn Matrices<C>>,
        scene: Conditions<C>,
    ) -> Result<RungeKutta<C>, SceneError> {
        let (mut matrices, mut scene) = (matrices, scene);
        if matrices.has_mass() {
            return Err(SceneError::unsupported(
                SceneError::EXPLICIT,
                "a scene without mass",
            ));
        }
        if !scene.periodic.is_empty() {
            return Err(SceneError::unsupported(
                SceneError::EXPLICIT,
                "a body without periodic boundaries",
            ));
        }
        // Checked, and put in order, as for implicit steps.
        placement::check(&mut *matrices, &mut scene)?;
        let mesh = scene.mesh;
        let Placement {
            loads,
            constraints,
            contacts,
            basis,
            state: now,
        } = Placement::new(&mut *matrices, scene)?;
        if contacts.follow_body() {
            return Err(SceneError::unsupported(
                SceneError::EXPLICIT,
                "a normal stress that is prescribed, or Scene::with_normal_stress_change",
            ));
        }
        let (damping, smooth) = damping::of_vertices(&*matrices, &constraints, &contacts)?;
        let size = now.velocity.len();
        let motion = Motion {
            displacement: vec![SVector::zeros(); size],
            states: vec![
                0.0;
                now.contacts
                    .iter()
                    .map(|contact| contact.states.len())
                    .sum()
            ],
        };
        let follows =
            (contacts.contacts.iter()).any(|contact| contact.trial.follows_normal_stress());
        let is_free = constraints.held.is_empty() && !follows;
        let mut integrator = RungeKutta {
            resistances: None,
            soft: SoftCells::new(matrices.stiffness(), &contacts, is_free),
            scratch: loads.scratch(size),
            many_cells: if constraints.held.is_empty() {
                ManyCells::new(&contacts, &damping, size)
            } else {
                None
            },
            elastic: Elastic::new(size),
            clamped: vec![
                0.0;
                if contacts.clamping().is_some() || contacts.have_fields() {
                    size
                } else {
                    0
                }
            ],
            tractions: contacts.constant_tractions(size),
            drive: vec![SVector::zeros(); size],
            slopes: std::array::from_fn(|_| motion.clone()),
            error: motion.clone(),
            stage: motion,
            seen: GlobalFields::new(basis),
            matrices,
            mesh,
            loads,
            constraints,
            follows,
            contacts,
            damping,
            smooth,
            last: now.clone(),
            now,
            balanced: None,
            accepted: false,
            dense: None,
            threads: Threads::new(),
            stops: Vec::new(),
        };
        integrator.begin()?;
        Ok(integrator)
    }

    fn view_of<C>(own: &RungeKutta<C>) -> &dyn StepView<C> {
        own
    }
}

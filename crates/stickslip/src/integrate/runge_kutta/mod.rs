//! An explicit Runge-Kutta method of order 5 for rate and state as an ordinary differential equation.

mod balance;
mod contacts;
mod damping;
mod dense;
mod drive;
mod elastic;
mod error;
mod motion;
mod scalar;
mod slopes;
mod soft;
mod source;
mod stability;
mod step;
mod stepper;
mod stiffness;
mod tableau;
mod threads;

use stickslip_core::compiled;
use stickslip_solvers::{MeshId, Operator};

use crate::body::Matrices;
use crate::contact::ContactSet;
use crate::placement::{self, Constraints, Placement};
use crate::scene::{Conditions, Loads};
use crate::view::{GlobalFields, StepView};
use crate::{
    IntoControlFlow, Run, RunReport, Scene, SceneError, Snapshot, StepError, StepFailure,
    StepState, Steps,
};
use balance::LocalProblems;
use drive::Drive;
use elastic::Elastic;
use motion::Stages;
use soft::SoftCells;
use stability::Resistances;
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
    scene: Placed<C>,
    now: StepState<C>,
    last: StepState<C>,
    stages: Stages<C>,
    elastic: Elastic<C>,
    drive: Drive<C>,
    local: LocalProblems<C>,
    /// The cells that relax far faster than the rest.
    soft: SoftCells<C>,
    /// The resistance to an error of the displacement; none before the first step of a constant size.
    resistances: Option<Box<Resistances<C>>>,
    /// Whether the last stage is the first of the next step.
    accepted: bool,
    threads: Threads,
}

/// A scene on its vertices, and what is seen of its body.
struct Placed<const C: usize> {
    /// The body's mesh, if it is known.
    mesh: Option<MeshId>,
    loads: Loads<C>,
    constraints: Constraints<C>,
    contacts: ContactSet<C>,
    seen: GlobalFields<C>,
    /// Times at which data can jump \[s\], increasing.
    stops: Vec<f64>,
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
        let stiffness = self.matrices.stiffness();
        self.elastic.at(0, stiffness, &self.now.displacement);
        let start = self.find_first_slopes(self.now.clock.time());
        start.map_err(|cause| match cause {
            StepError::Stage { .. } => SceneError::unsupported(
                SceneError::EXPLICIT,
                "a finite slip rate at the first time",
            ),
            cause => SceneError::Start(cause),
        })?;
        (self.now.velocity).copy_from_slice(&self.stages.slopes[0].displacement);
        self.drive.balanced = Some(self.now.clock);
        self.accepted = false;
        self.scene.seen.show(&self.now);
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
        let local = LocalProblems::new(&*matrices, &constraints, &contacts)?;
        let follows =
            (contacts.contacts.iter()).any(|contact| contact.trial.follows_normal_stress());
        let is_free = constraints.held.is_empty() && !follows;
        let size = now.velocity.len();
        let clamps = contacts.clamping().is_some() || contacts.have_fields();
        let mut integrator = RungeKutta {
            resistances: None,
            soft: SoftCells::new(matrices.stiffness(), &contacts, is_free),
            elastic: Elastic::new(size),
            drive: Drive::new(size, &loads, &contacts),
            stages: Stages::new(&now, clamps),
            local,
            matrices,
            scene: Placed {
                seen: GlobalFields::new(basis),
                mesh,
                loads,
                constraints,
                contacts,
                stops: Vec::new(),
            },
            last: now.clone(),
            now,
            accepted: false,
            threads: Threads::new(),
        };
        integrator.begin()?;
        Ok(integrator)
    }

    fn view_of<C>(own: &RungeKutta<C>) -> &dyn StepView<C> {
        own
    }
}

//! Construction of a simulation from a scene, and replacement of its methods during a run.

use std::sync::Arc;

use nalgebra::SVector;
use stickslip_core::compiled;
use stickslip_solvers::{Basis, Counters, Matrix, MeshId, NonsmoothSolver, Operator};
use stickslip_time::RateScheme;

use crate::body::{AnySolver, Matrices};
use crate::checks::require;
use crate::numerics::NUMERICS;
use crate::placement::{self, Placement};
use crate::scene::Conditions;
use crate::step::{
    Certificate, InitialAcceleration, Method, Operators, Problem, Reactions, Tolerance, Traits,
    Workspace,
};
use crate::{Coupling, MeshMismatch, Scene, SceneError, Simulation, StateUpdate};

impl<const C: usize> Simulation<C> {
    /// Checks the scene, allocates all memory, and solves for the initial equilibrium if the scene starts from it.
    ///
    /// By default the state is advanced at the midpoint rate and condensed statically ([`StateUpdate::Midpoint`],
    /// [`Monolithic`](crate::Monolithic)). The paper's pairing, of first order, is [`StateUpdate::BackwardEuler`] with
    /// [`FixedPoint::paper`](crate::FixedPoint::paper).
    ///
    /// A solver for matrices of another format does not compile, and the compiler names those that fit:
    ///
    /// ```compile_fail
    /// # use stickslip::nalgebra::Matrix1;
    /// # use stickslip::{Condensed, GeneralizedAlpha, Scene, Simulation};
    /// let spring = Scene::new(Matrix1::new(1e6));
    /// let simulation = Simulation::new(spring, GeneralizedAlpha::default(), Condensed::new());
    /// ```
    ///
    /// # Errors
    /// [`SceneError`] with the invalid part of the scene.
    pub fn new<Op: Operator<C>>(
        scene: Scene<Op, C>,
        scheme: impl RateScheme + 'static,
        solver: impl NonsmoothSolver<Op, C> + 'static,
    ) -> Result<Self, SceneError> {
        let mesh = solver.mesh();
        let (matrices, conditions) = scene.split();
        let solver = (AnySolver::new(solver), mesh);
        build(conditions, matrices, Arc::new(scheme), solver)
    }

    /// Solves for the accelerations that balance the forces of the present state, if the scheme uses them.
    fn find_acceleration(&mut self) -> Result<(), SceneError> {
        find_acceleration(self)
    }

    /// Replaces the coupling, [`Monolithic`](crate::Monolithic) by default.
    #[must_use]
    pub fn with_coupling(mut self, coupling: impl Coupling + 'static) -> Self {
        self.set_coupling(coupling);
        self
    }

    /// Replaces the state update, [`StateUpdate::Midpoint`] by default. Each stage of a multi-stage scheme uses
    /// backward Euler regardless. Without inertia, [`StateUpdate::BackwardEuler`] also uses backward Euler for the
    /// displacement, instead of generalised-alpha and Newmark.
    #[must_use]
    pub fn with_state_update(mut self, state_update: StateUpdate) -> Self {
        self.problem.method.set_state_update(state_update);
        self.renew_algorithmic();
        self
    }

    /// Replaces the tolerance of solver and coupling, `1e-10` by default, relative to the scene. With the operator `B`
    /// of the step and the forces `F_k = w_k (abs(sigma_n) + c)`, one per frictional vertex, the error `d` of a
    /// velocity satisfies
    ///
    /// ```text
    /// sqrt(d . B d) <= tolerance sqrt(mean of F_k^2 / B_kk)
    /// ```
    ///
    /// The coefficient of friction is then accurate to about `tolerance`, and `ln V` to that over `a`, in any units.
    /// Without forces `sqrt(v . B v)` takes their place.
    ///
    /// # Errors
    /// [`SceneError::Value`] for a tolerance that is not positive and finite.
    pub fn with_tolerance(mut self, tolerance: f64) -> Result<Self, SceneError> {
        check_tolerance(tolerance)?;
        self.set_tolerance(Tolerance::Relative(tolerance));
        Ok(self)
    }

    /// Replaces the tolerance by an absolute one, in the norm `sqrt((C eps, eps) + (rho v, v))` of velocities in SI
    /// units; the paper uses `1e-10`.
    ///
    /// # Errors
    /// [`SceneError::Value`] for a tolerance that is not positive and finite.
    pub fn with_absolute_tolerance(mut self, tolerance: f64) -> Result<Self, SceneError> {
        check_tolerance(tolerance)?;
        self.set_tolerance(Tolerance::Absolute(tolerance));
        Ok(self)
    }

    fn set_tolerance(&mut self, tolerance: Tolerance) {
        self.problem.method.tolerance = tolerance;
        self.renew_operators();
    }

    /// Builds the operators and the norm for scheme and tolerance.
    fn renew_operators(&mut self) {
        renew_operators(self);
    }

    /// Continues with another coupling. The history stays; the memory of the last coupling is cleared.
    pub fn set_coupling(&mut self, coupling: impl Coupling + 'static) {
        self.problem.method.coupling = Arc::new(coupling);
        self.state.coupling = [0.0; 4];
    }

    /// Continues with another solver. The history stays; the next step refuses a solver for another mesh. One for several
    /// formats takes that of the scene by name: `set_solver::<DMatrix<f64>>(DenseNewton::new())`.
    ///
    /// # Errors
    /// [`SceneError::Format`] for a solver of matrices in another format than those of the scene: the simulation goes on
    /// with the one that it has.
    pub fn set_solver<Op: Operator<C>>(
        &mut self,
        solver: impl NonsmoothSolver<Op, C> + 'static,
    ) -> Result<(), SceneError> {
        replace_solver(self, AnySolver::new(solver))
    }

    /// Continues with another scheme. The history stays, accelerations are computed from the forces, and the
    /// algorithmic acceleration of the last scheme is cleared.
    ///
    /// # Errors
    /// [`SceneError::Time`] for parameters out of their range, [`SceneError::Unsupported`] for an explicit scheme
    /// and a scene without mass.
    pub fn set_scheme(&mut self, scheme: impl RateScheme + 'static) -> Result<(), SceneError> {
        scheme.validate()?;
        if !self.problem.matrices.has_mass() && !scheme.properties().implicit {
            return Err(SceneError::unsupported(SceneError::EXPLICIT, "a mass"));
        }
        self.problem.method.set_scheme(Arc::new(scheme));
        self.renew_operators();
        self.renew_algorithmic();
        self.find_acceleration()
    }

    /// Allocates the algorithmic acceleration of the scheme.
    fn renew_algorithmic(&mut self) {
        let has_algorithmic = self.problem.method.scheme.properties().has_algorithmic;
        let size = if has_algorithmic {
            self.state.velocity.len()
        } else {
            0
        };
        self.state.algorithmic = vec![SVector::zeros(); size];
        self.work
            .end
            .algorithmic
            .clone_from(&self.state.algorithmic);
        (self.work.start, self.comparison) = (None, None);
    }

    /// The stiffness matrix `A` [N/m]; [`snapshot`](Self::snapshot) shows contacts and boundary data.
    pub fn stiffness(&self) -> &dyn Matrix<C> {
        self.problem.matrices.stiffness()
    }

    /// The mass matrix `M` \[kg\], if there is inertia.
    pub fn mass(&self) -> Option<&dyn Matrix<C>> {
        self.problem.matrices.mass()
    }

    /// The viscosity matrix `C` [N s/m], the sum of all viscosities of the scene, if there is any.
    pub fn viscosity(&self) -> Option<&dyn Matrix<C>> {
        self.problem.matrices.viscosity()
    }

    /// The scheme in use. In a scene without mass it is [`FirstOrderAlpha`](stickslip_time::FirstOrderAlpha) for
    /// [`GeneralizedAlpha`](stickslip_time::GeneralizedAlpha), and for [`Newmark`](stickslip_time::Newmark) where
    /// friction does not depend on the slip rate; backward Euler with [`StateUpdate::BackwardEuler`]; else
    /// [`QuasiStatic`](stickslip_time::QuasiStatic) of the one given.
    pub fn scheme(&self) -> &dyn RateScheme {
        &*self.problem.method.scheme
    }

    /// The operator `c_a M + C + c_u A` of the last step.
    pub fn operator(&self) -> &dyn Matrix<C> {
        self.work.operators.step()
    }

    /// The Dirichlet components, one mask per vertex.
    pub fn fixed(&self) -> &[[bool; C]] {
        &self.problem.constraints.fixed
    }

    /// The largest stable step of an explicit scheme \[s\]; known after the first attempted step.
    #[doc(alias = "CFL")]
    pub fn step_limit(&self) -> Option<f64> {
        self.work.operators.limit
    }

    /// The work counters of the solver so far.
    pub fn counters(&self) -> Counters {
        self.work.operators.body.counters()
    }
}

fn check_tolerance(tolerance: f64) -> Result<(), SceneError> {
    let legal = tolerance > 0.0 && tolerance.is_finite();
    require("tolerance", "positive and finite", 0, tolerance, legal)
}

/// Whether a rigid-body mode of the body is constrained by friction alone.
fn moves_freely<const C: usize>(
    stiffness: &dyn Matrix<C>,
    fixed: &[[bool; C]],
    basis: &Basis<C>,
) -> bool {
    if stiffness.ranks().are_several() {
        return false;
    }
    let (directions, count) = basis.free_translations(fixed);
    let mut shift = vec![SVector::zeros(); fixed.len()];
    let mut free = directions[..count].iter();
    free.any(|direction| basis.moves_freely(stiffness, direction, &mut shift))
}

compiled! {
    /// A simulation whose matrices, scheme and solver are not known by their types.
    fn build<C>(
        scene: Conditions<C>,
        matrices: Box<dyn Matrices<C>>,
        scheme: Arc<dyn RateScheme>,
        solver: (AnySolver, Option<MeshId>),
    ) -> Result<Simulation<C>, SceneError> {
        let (mut scene, mut matrices, (solver, mesh)) = (scene, matrices, solver);
        scheme.validate()?;
        matrices.find_energy(scene.asymmetric.as_ref())?;
        placement::check(&mut *matrices, &mut scene)?;
        MeshMismatch::check("solver", scene.mesh, mesh)?;
        let in_equilibrium = matrices.starts_in_equilibrium();
        let given = !scene.initial.acceleration.is_empty();
        let mesh = scene.mesh;
        let Placement {
            loads,
            constraints,
            mut contacts,
            basis,
            mut state,
        } = Placement::new(&mut *matrices, scene)?;
        contacts.follow_displacement()?;
        let (ranks, size) = (matrices.stiffness().ranks(), state.velocity.len());
        let traits = Traits {
            inertia: matrices.has_mass(),
            has_state: ranks.any(contacts.have_state()),
            resists: ranks.all(contacts.resist_rates()) || matrices.viscosity().is_some(),
            lags: matrices.any_lags(),
        };
        let method = Method::new(scheme, traits);
        let properties = method.scheme.properties();
        let implicit = properties.implicit;
        if !implicit && !matrices.has_mass() {
            return Err(SceneError::unsupported(SceneError::EXPLICIT, "a mass"));
        }
        let (matrices, mut body) = matrices.into_body(solver, implicit)?;
        if ranks.any(!basis.is_empty()) {
            body.change_basis(&basis);
        }
        let mut operators = Operators::new(body, implicit, properties.stability_limit);
        operators.measure_sliding(&*matrices, &constraints.fixed, &contacts.vertices, &basis);
        let zeros = |present: bool| vec![SVector::zeros(); if present { size } else { 0 }];
        state.algorithmic = zeros(properties.has_algorithmic);
        let kept = |kept: bool, field: &[_]| if kept { field.to_vec() } else { Vec::new() };
        let problem = Problem {
            equilibrium: kept(in_equilibrium, &state.displacement),
            initial_velocity: kept(matrices.has_mass(), &state.velocity),
            method,
            ranks,
            moves_freely: moves_freely(matrices.stiffness(), &constraints.fixed, &basis),
            stops: Vec::new(),
            loads,
            constraints,
            basis,
            matrices,
            mesh,
        };
        let matrices = &*problem.matrices;
        let work = Workspace {
            certificate: Certificate::new(matrices, &contacts),
            reactions: Reactions::new(matrices, &contacts),
            again: false,
            impact: false,
            acceleration: InitialAcceleration::new(&problem, &contacts),
            contacts,
            operators,
            end: state.clone(),
            start: None,
            load: zeros(true),
            change: zeros(true),
            scratch: problem.loads.scratch(size),
            mean_velocity: zeros(matrices.any_lags()),
            solver_iterations: 0,
            balanced: None,
            compared: false,
        };
        let mut simulation = Simulation::at(problem, work, state);
        if !given {
            simulation.find_acceleration()?;
            if !simulation.state.acceleration.is_empty() {
                let (work, state) = (&simulation.work, &mut simulation.state);
                work.contacts.start_open(&mut state.contacts);
            }
        }
        Ok(simulation)
    }

    fn find_acceleration<C>(own: &mut Simulation<C>) -> Result<(), SceneError> {
        let (p, state) = (&own.problem, &mut own.state);
        let time = state.clock.time();
        let dt = NUMERICS.difference * time.abs().max(1.0);
        own.work.find_acceleration(p, state, (time, dt))?;
        own.work.balanced = None;
        own.show();
        Ok(())
    }

    fn renew_operators<C>(own: &mut Simulation<C>) {
        let (p, w) = (&own.problem, &mut own.work);
        let properties = p.method.scheme.properties();
        w.operators.renew(properties.implicit, properties.stability_limit);
        let (fixed, vertices) = (&p.constraints.fixed, &w.contacts.vertices);
        (w.operators).measure_sliding(&*p.matrices, fixed, vertices, &p.basis);
        if let Tolerance::Absolute(_) = p.method.tolerance {
            w.operators.measure_absolutely();
        }
        w.balanced = None;
    }

    fn replace_solver<C>(own: &mut Simulation<C>, solver: AnySolver) -> Result<(), SceneError> {
        let operators = &mut own.work.operators;
        operators.body.set_solver(solver)?;
        if own.problem.ranks.any(!own.problem.basis.is_empty()) {
            operators.body.change_basis(&own.problem.basis);
        }
        operators.prepared = None;
        Ok(())
    }
}

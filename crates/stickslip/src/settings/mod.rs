//! Construction of a simulation from a scene, and replacement of its methods during a run.

mod build;

use std::sync::Arc;

use nalgebra::SVector;
use stickslip_solvers::{Counters, Matrix, NonsmoothSolver, Operator};
use stickslip_time::RateScheme;

use crate::body::AnySolver;
use crate::checks::require;
use crate::step::Tolerance;
use crate::{Coupling, Scene, SceneError, Simulation, StateUpdate};
use build::{build, check_scheme, find_acceleration, renew_operators, replace_solver};

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
    /// and a scene without mass, and for one of several stages and local steps.
    pub fn set_scheme(&mut self, scheme: impl RateScheme + 'static) -> Result<(), SceneError> {
        scheme.validate()?;
        check_scheme(&*self.problem.matrices, &scheme.properties())?;
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

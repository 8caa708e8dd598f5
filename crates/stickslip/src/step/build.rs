//! From a scene to a simulation, and what may be exchanged on the way.

use nalgebra::SVector;
use stickslip_time::{Facts, RateScheme};
use stickslip_tnnmg::{Counters, NonsmoothSolver, Operator};

use super::method::{Method, Tolerance, with_or_without};
use super::operators::Operators;
use super::placement::{self, Placement};
use super::{Accelerations, Coupling, Following, Seen, Simulation, Trial};
use crate::contact::check::require;
use crate::scene::Scene;
use crate::{MeshMismatch, SceneError, StateUpdate};

impl<Op: Operator<C>, const C: usize> Simulation<Op, C> {
    /// Checks the scene, takes all memory, and solves for the initial equilibrium if asked to.
    ///
    /// Until told otherwise, the state is advanced at the midpoint rate and eliminated
    /// ([`StateUpdate::Midpoint`], [`Monolithic`](crate::Monolithic)). The paper's pairing, of first order, is
    /// [`StateUpdate::BackwardEuler`] with [`FixedPoint::paper`](crate::FixedPoint::paper).
    ///
    /// # Errors
    /// [`SceneError`] that says which part of the scene is wrong.
    pub fn new(
        scene: Scene<Op, C>,
        scheme: impl RateScheme + 'static,
        solver: impl NonsmoothSolver<Op, C> + 'static,
    ) -> Result<Self, SceneError> {
        Self::build(scene, Box::new(scheme), Box::new(solver))
    }

    /// The same, compiled once for all schemes and solvers.
    fn build(
        mut scene: Scene<Op, C>,
        scheme: Box<dyn RateScheme>,
        mut solver: Box<dyn NonsmoothSolver<Op, C>>,
    ) -> Result<Self, SceneError> {
        scheme.validate()?;
        placement::check(&mut scene)?;
        MeshMismatch::check("solver", scene.mesh, solver.mesh())?;
        let method = Method::new(scheme, scene.mass.is_some());
        let in_equilibrium = scene.initial.equilibrium.is_some();
        let facts = method.scheme.facts();
        let Placement {
            scene,
            loads,
            constraints,
            contacts,
            frames,
            mut state,
        } = Placement::new(scene)?;
        let (size, inertia) = (state.velocity.len(), scene.mass.is_some());
        let mut operators = Operators::new(&scene, facts.implicit, facts.stability_limit)?;
        operators.measure_sliding(&scene, &constraints.fixed, &contacts.vertices, &frames);
        if !frames.is_empty() {
            solver.turn(&frames);
        }
        let zeros = |present: bool| vec![SVector::zeros(); if present { size } else { 0 }];
        state.carried = zeros(facts.carries);
        let accelerations = if scene.initial.recurrent {
            None
        } else {
            let given = !scene.initial.acceleration.is_empty();
            Accelerations::new(&scene, &constraints, &loads, contacts.vertices.len(), given)
        };
        let frictional = contacts.vertices.len();
        let equilibrium = if in_equilibrium {
            state.displacement.clone()
        } else {
            Vec::new()
        };
        let following = (scene.stiffness.any(contacts.may_weaken()))
            .then(|| Box::new(Following::new(&scene, &contacts, &constraints.fixed)));
        let mut simulation = Self {
            trial: Trial {
                displacement: zeros(true),
                acceleration: zeros(inertia),
                load: zeros(true),
                velocity: zeros(true),
                change: zeros(true),
                scratch: loads.scratch(size),
                products: vec![SVector::zeros(); frictional],
                memory: [0.0; 4],
                solver_iterations: 0,
                balanced: None,
            },
            scene,
            loads,
            constraints,
            contacts,
            method,
            solver,
            operators,
            state,
            equilibrium,
            accelerations,
            old: None,
            follows: true,
            following,
            comparison: None,
            seen: Seen::new(frames),
        };
        simulation.start_acceleration()?;
        simulation.seen.show(&simulation.state);
        Ok(simulation)
    }

    /// Replaces the coupling, [`Monolithic`](crate::Monolithic) by default.
    #[must_use]
    pub fn with_coupling(mut self, coupling: impl Coupling + 'static) -> Self {
        self.set_coupling(coupling);
        self
    }

    /// Replaces the state update, [`StateUpdate::Midpoint`] by default. A scheme of several stages takes
    /// backward Euler in each of them, whatever is chosen.
    #[must_use]
    pub fn with_state_update(mut self, state_update: StateUpdate) -> Self {
        self.method.state_update = state_update;
        self
    }

    /// Replaces the tolerance of solver and coupling, `1e-13` by default, relative to the scene: with the operator
    /// `B` of the step and the forces `F_k = w_k (abs(sigma_n) + c)`, one a frictional vertex, a velocity may be off
    /// by
    ///
    /// ```text
    /// sqrt(d . B d) <= tolerance sqrt(mean of F_k^2 / B_kk)
    /// ```
    ///
    /// so that the coefficient of friction is right to about `tolerance`, and `ln V` to that over `a`, in any
    /// units. Without forces `sqrt(v . B v)` takes their place.
    ///
    /// # Errors
    /// [`SceneError::Value`] for a tolerance that is not positive and finite.
    pub fn with_tolerance(mut self, tolerance: f64) -> Result<Self, SceneError> {
        check_tolerance(tolerance)?;
        self.set_tolerance(Tolerance::Relative(tolerance))?;
        Ok(self)
    }

    /// The same as an absolute number, in the norm `sqrt((C eps, eps) + (rho v, v))` of velocities in SI units:
    /// the paper's, who take `1e-10`.
    ///
    /// # Errors
    /// [`SceneError::Value`] for a tolerance that is not positive and finite.
    pub fn with_absolute_tolerance(mut self, tolerance: f64) -> Result<Self, SceneError> {
        check_tolerance(tolerance)?;
        self.set_tolerance(Tolerance::Absolute(tolerance))?;
        Ok(self)
    }

    fn set_tolerance(&mut self, tolerance: Tolerance) -> Result<(), SceneError> {
        self.method.tolerance = tolerance;
        let facts = self.method.scheme.facts();
        self.renew_operators(&facts)
    }

    /// The operators and the norm of scheme and tolerance.
    fn renew_operators(&mut self, facts: &Facts) -> Result<(), SceneError> {
        self.operators = Operators::new(&self.scene, facts.implicit, facts.stability_limit)?;
        let (fixed, vertices) = (&self.constraints.fixed, &self.contacts.vertices);
        let frames = self.seen.frames();
        self.operators
            .measure_sliding(&self.scene, fixed, vertices, frames);
        if let Tolerance::Absolute(_) = self.method.tolerance {
            self.operators.measure_absolutely(&self.scene);
        }
        self.trial.balanced = None;
        Ok(())
    }

    /// Goes on with another coupling: the history stays, what the last coupling remembers is forgotten.
    pub fn set_coupling(&mut self, coupling: impl Coupling + 'static) {
        self.method.coupling = Box::new(coupling);
        self.state.coupling = [0.0; 4];
    }

    /// Goes on with another solver: the history stays. One for another mesh is refused by the next step.
    pub fn set_solver(&mut self, solver: impl NonsmoothSolver<Op, C> + 'static) {
        self.solver = Box::new(solver);
        if !self.seen.frames().is_empty() {
            self.solver.turn(self.seen.frames());
        }
        self.operators.prepared = None;
    }

    /// Goes on with another scheme: the history stays, what the last scheme carried beside it is forgotten.
    ///
    /// # Errors
    /// [`SceneError::Time`] for parameters out of their range, [`SceneError::Explicit`] for an explicit scheme
    /// and a scene without mass.
    pub fn set_scheme(&mut self, scheme: impl RateScheme + 'static) -> Result<(), SceneError> {
        scheme.validate()?;
        let scheme = with_or_without(Box::new(scheme), self.scene.mass.is_some());
        let facts = scheme.facts();
        self.renew_operators(&facts)?;
        self.method.scheme = scheme;
        let size = if facts.carries {
            self.state.velocity.len()
        } else {
            0
        };
        self.state.carried = vec![SVector::zeros(); size];
        (self.old, self.comparison) = (None, None);
        Ok(())
    }

    /// The scene; its contacts and boundary data are at work and seen through
    /// [`snapshot`](Self::snapshot).
    pub fn scene(&self) -> &Scene<Op, C> {
        &self.scene
    }

    /// The scheme; [`QuasiStatic`](stickslip_time::QuasiStatic) of the one given for a scene without mass.
    pub fn scheme(&self) -> &dyn RateScheme {
        &*self.method.scheme
    }

    /// The operator `c_a M + C + c_u A` of the last step.
    pub fn operator(&self) -> &Op {
        &self.operators.step
    }

    /// The components that are no unknowns, one mask a vertex.
    pub fn fixed(&self) -> &[[bool; C]] {
        &self.constraints.fixed
    }

    /// The largest stable step of an explicit scheme \[s\], once a step has been tried.
    pub fn step_limit(&self) -> Option<f64> {
        self.operators.limit
    }

    /// What the solver has done so far.
    pub fn counters(&self) -> Counters {
        self.solver.counters()
    }
}

fn check_tolerance(tolerance: f64) -> Result<(), SceneError> {
    let legal = tolerance > 0.0 && tolerance.is_finite();
    require("tolerance", "positive and finite", 0, tolerance, legal)
}

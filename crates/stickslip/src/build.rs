//! From a scene to a simulation.

use nalgebra::SVector;
use stickslip_friction::FrictionLaw;
use stickslip_state::StateLaw;
use stickslip_time::{Motion, RateScheme};
use stickslip_tnnmg::{Energy, NonsmoothSolver, Operator, Stopping};

use crate::accepted::Accepted;
use crate::checks::check;
use crate::clock::Clock;
use crate::maps::MAX_ITERATIONS;
use crate::prediction::fill_load;
use crate::scene::Scene;
use crate::simulation::{Simulation, Trial};
use crate::{
    Coupling, InterfaceLaw, InterfacePotential, Monolithic, SceneError, StateUpdate, StepReport,
};

impl<Op, L, S, R, const C: usize> Simulation<Op, L, S, R, C>
where
    Op: Operator<C>,
    L: FrictionLaw + Clone,
    S: StateLaw + Clone,
    L::State: From<S::State>,
    R: RateScheme,
{
    /// Checks the scene, takes all memory, and solves for the initial equilibrium if asked to.
    ///
    /// Until told otherwise, the state is advanced at the midpoint rate and eliminated
    /// ([`StateUpdate::Midpoint`], [`Monolithic`]). The paper's pairing, of first order, is
    /// [`StateUpdate::BackwardEuler`] with [`FixedPoint::paper`](crate::FixedPoint::paper).
    ///
    /// # Errors
    /// [`SceneError`] that says which part of the scene is wrong.
    pub fn new(
        scene: Scene<Op, L, S, C>,
        scheme: R,
        solver: impl NonsmoothSolver<Op, InterfacePotential<L, S>, C> + 'static,
    ) -> Result<Self, SceneError> {
        scheme.validate()?;
        let fixed = check(&scene)?;
        let size = scene.stiffness.vertex_count();
        // An explicit scheme leaves the stiffness out of the operator, and out of the norm.
        let explicit = scheme.coefficients(1.0).displacement == 0.0;
        let mut terms = Vec::new();
        if !explicit {
            terms.push((1.0, &scene.stiffness));
        }
        terms.extend(scene.mass.as_ref().map(|mass| (1.0, mass)));
        if terms.is_empty() {
            return Err(SceneError::Explicit {
                requirement: "a mass",
            });
        }
        let norm = Op::combination(&terms);
        terms.extend(scene.viscosity.as_ref().map(|viscosity| (1.0, viscosity)));
        let operator = Op::combination(&terms);
        let (vertices, weights) = match &scene.friction.patch {
            Some(patch) => (patch.vertices.clone(), patch.weights.clone()),
            None => (Vec::new(), Vec::new()),
        };
        let states: Vec<S::State> = (0..vertices.len())
            .map(|k| *scene.state.initial.at(k))
            .collect();
        let potentials = (0..vertices.len())
            .map(|k| InterfaceLaw::potential_of(&scene, k, weights[k], states[k]))
            .collect();
        let zeros = || vec![SVector::zeros(); size];
        let or_zeros = |field: &Vec<SVector<f64, C>>| {
            if field.is_empty() {
                zeros()
            } else {
                field.clone()
            }
        };
        let inertia = scene.mass.is_some();
        let carries = inertia && scheme.carry(1.0, Motion::default(), 0.0).is_some();
        let mut simulation = Self {
            now: Accepted {
                clock: Clock::default(),
                displacement: or_zeros(&scene.initial.displacement),
                velocity: or_zeros(&scene.initial.velocity),
                acceleration: if inertia {
                    or_zeros(&scene.initial.acceleration)
                } else {
                    Vec::new()
                },
                carried: if carries { zeros() } else { Vec::new() },
                earlier: if size_of::<S::State>() > 0 {
                    vec![SVector::zeros(); vertices.len()]
                } else {
                    Vec::new()
                },
                last_step: 0.0,
                states: states.clone(),
                report: StepReport::default(),
            },
            predicted_displacement: zeros(),
            predicted_acceleration: if inertia { zeros() } else { Vec::new() },
            trial: Trial {
                load: zeros(),
                velocity: zeros(),
                change: zeros(),
                solves: 0,
                state_changes: [0.0; 2],
                normal_stress: if scene.friction.stress_history.is_some() {
                    vec![0.0; vertices.len()]
                } else {
                    Vec::new()
                },
                differences: if size_of::<S::State>() > 0 {
                    vec![[0.0; 2]; vertices.len()]
                } else {
                    Vec::new()
                },
                proposed: states,
                potentials,
                solver_iterations: 0,
            },
            scene,
            scheme,
            solver: Box::new(solver),
            coupling: Box::new(Monolithic::default()),
            state_update: StateUpdate::default(),
            tolerance: 1e-10,
            operator,
            norm,
            prepared: None,
            explicit,
            step_limit: None,
            equivalence: f64::INFINITY,
            vertices,
            weights,
            held: (0..size)
                .filter(|&i| fixed[i].iter().any(|&fixed| fixed))
                .collect(),
            fixed,
            old: None,
            comparison: None,
        };
        if simulation.scene.initial.in_equilibrium {
            let (scene, fixed) = (&simulation.scene, &simulation.fixed);
            simulation.now.displacement = balance(scene, fixed, &mut *simulation.solver)?;
        }
        Ok(simulation)
    }

    /// Replaces the coupling, [`Monolithic`] by default.
    #[must_use]
    pub fn with_coupling(mut self, coupling: impl Coupling + 'static) -> Self {
        self.coupling = Box::new(coupling);
        self
    }

    /// Goes on with another solver: the history stays.
    #[must_use]
    pub fn with_solver(
        mut self,
        solver: impl NonsmoothSolver<Op, InterfacePotential<L, S>, C> + 'static,
    ) -> Self {
        self.solver = Box::new(solver);
        self.prepared = None;
        self
    }

    /// Replaces the state update, [`StateUpdate::Midpoint`] by default. A scheme of two stages takes
    /// backward Euler in each of them, whatever is chosen.
    #[must_use]
    pub fn with_state_update(mut self, state_update: StateUpdate) -> Self {
        self.state_update = state_update;
        self
    }

    /// Replaces the tolerance of the coupling, `1e-10` by default, in the norm
    /// `sqrt((C eps, eps) + (rho v, v))`.
    ///
    /// # Errors
    /// [`SceneError::Value`] for a tolerance that is not positive and finite.
    pub fn with_tolerance(mut self, tolerance: f64) -> Result<Self, SceneError> {
        if !(tolerance > 0.0 && tolerance.is_finite()) {
            return Err(SceneError::Value {
                what: "tolerance",
                requirement: "positive and finite",
                position: 0,
                value: tolerance,
            });
        }
        self.tolerance = tolerance;
        Ok(self)
    }
}

impl<Op, L, S, const C: usize> Scene<Op, L, S, C>
where
    Op: Operator<C>,
    L: FrictionLaw,
    S: StateLaw,
    L::State: From<S::State>,
{
    /// Like [`in_equilibrium`](Scene::in_equilibrium), computed at once and by another solver than
    /// that of the velocity problems: for solvers that cannot invert the stiffness.
    ///
    /// # Errors
    /// What is wrong with the scene, or why the solver gave up.
    pub fn balanced_by(
        self,
        solver: &mut dyn NonsmoothSolver<Op, InterfacePotential<L, S>, C>,
    ) -> Result<Self, SceneError> {
        let fixed = check(&self)?;
        let displacement = balance(&self, &fixed, solver)?;
        let mut scene = self.with_displacement(displacement);
        scene.initial.in_equilibrium = false;
        Ok(scene)
    }
}

/// The displacement with `A u = l` at time zero, without friction, zero where it is fixed.
fn balance<Op, L, S, const C: usize>(
    scene: &Scene<Op, L, S, C>,
    fixed: &[[bool; C]],
    solver: &mut dyn NonsmoothSolver<Op, InterfacePotential<L, S>, C>,
) -> Result<Vec<SVector<f64, C>>, SceneError>
where
    Op: Operator<C>,
    L: FrictionLaw,
    S: StateLaw,
    L::State: From<S::State>,
{
    let size = scene.stiffness.vertex_count();
    let mut load = vec![SVector::zeros(); size];
    fill_load(&scene.load, 0.0, &mut load);
    let energy = Energy {
        operator: &scene.stiffness,
        load: &load,
        potentials: &[],
        vertices: &[],
        fixed,
    };
    solver.prepare(&energy)?;
    let mut displacement = if scene.initial.displacement.is_empty() {
        vec![SVector::zeros(); size]
    } else {
        scene.initial.displacement.clone()
    };
    for (displacement, fixed) in displacement.iter_mut().zip(fixed) {
        for c in (0..C).filter(|&c| fixed[c]) {
            displacement[c] = 0.0;
        }
    }
    // With the mass, in which a body that floats shows.
    let mut terms = vec![(1.0, &scene.stiffness)];
    terms.extend(scene.mass.as_ref().map(|mass| (1.0, mass)));
    let norm = Op::combination(&terms);
    let stopping = Stopping {
        norm: &norm,
        tolerance: f64::MIN_POSITIVE,
        relative: 1e-13,
        equivalence: f64::INFINITY,
        max_iterations: MAX_ITERATIONS,
    };
    solver.minimize(&energy, &stopping, &mut displacement)?;
    Ok(displacement)
}

//! The time loop.

use nalgebra::SVector;
use stickslip_friction::{FrictionLaw, Radial};
use stickslip_state::StateLaw;
use stickslip_time::{Coefficients, Motion, Predicted, RateScheme};
use stickslip_tnnmg::{Energy, NonsmoothSolver, Operator, Stopping};

use crate::checks::check;
use crate::clock::Clock;
use crate::maps::{MAX_ITERATIONS, Maps};
use crate::scene::{Load, Scene};
use crate::{Coupling, Failure, FixedPoint, SceneError, Snapshot, StepError, StepReport, Stepper};

/// A scene in motion: scene, scheme, solver and coupling, and the last accepted step.
///
/// ```text
/// (u, v, a, alpha) -> (u^, a^) -> r = l - M a^ - A u^ -> { alpha from v, v from alpha } -> (u, v, a, alpha)
/// ```
///
/// All memory is taken in [`new`](Simulation::new). The operator `c_a M + c_u A` is formed anew only
/// when the step size changes.
pub struct Simulation<Op, L, S, R, const C: usize>
where
    L: FrictionLaw,
    S: StateLaw,
{
    scene: Scene<Op, L, S, C>,
    scheme: R,
    solver: Box<dyn NonsmoothSolver<Op, Radial<L>, C>>,
    coupling: Box<dyn Coupling>,
    tolerance: f64,
    /// `c_a M + c_u A` for the step size `prepared`.
    operator: Op,
    /// `A + M`.
    norm: Op,
    prepared: Option<f64>,
    equivalence: f64,
    vertices: Vec<usize>,
    weights: Vec<f64>,
    fixed: Vec<[bool; C]>,
    clock: Clock,
    displacement: Vec<SVector<f64, C>>,
    velocity: Vec<SVector<f64, C>>,
    acceleration: Vec<SVector<f64, C>>,
    states: Vec<S::State>,
    report: StepReport,
    predicted_displacement: Vec<SVector<f64, C>>,
    predicted_acceleration: Vec<SVector<f64, C>>,
    trial: Trial<L, S, C>,
}

/// The step being taken.
pub(crate) struct Trial<L: FrictionLaw, S: StateLaw, const C: usize> {
    /// `r`.
    pub(crate) load: Vec<SVector<f64, C>>,
    pub(crate) velocity: Vec<SVector<f64, C>>,
    /// By how much the last velocity problem moved the velocity.
    pub(crate) change: Vec<SVector<f64, C>>,
    /// Velocity problems solved, and the changes of the state before the last two of them.
    pub(crate) solves: usize,
    pub(crate) state_changes: [f64; 2],
    /// The state in use, and the last one proposed.
    pub(crate) states: Vec<S::State>,
    pub(crate) proposed: Vec<S::State>,
    pub(crate) potentials: Vec<Radial<L>>,
    pub(crate) solver_iterations: usize,
}

impl<Op, L, S, R, const C: usize> Simulation<Op, L, S, R, C>
where
    Op: Operator<C>,
    L: FrictionLaw + Clone,
    S: StateLaw,
    L::State: From<S::State>,
    R: RateScheme,
{
    /// Checks the scene, takes all memory, and solves for the initial equilibrium if asked to.
    ///
    /// # Errors
    /// [`SceneError`] that says which part of the scene is wrong.
    pub fn new(
        scene: Scene<Op, L, S, C>,
        scheme: R,
        solver: impl NonsmoothSolver<Op, Radial<L>, C> + 'static,
    ) -> Result<Self, SceneError> {
        scheme.validate()?;
        let fixed = check(&scene)?;
        let size = scene.stiffness.vertex_count();
        let mut terms = vec![(1.0, &scene.stiffness)];
        terms.extend(scene.mass.as_ref().map(|mass| (1.0, mass)));
        let norm = Op::combination(&terms);
        let operator = Op::combination(&terms);
        let (vertices, weights) = match &scene.friction.patch {
            Some(patch) => (patch.vertices.clone(), patch.weights.clone()),
            None => (Vec::new(), Vec::new()),
        };
        let states: Vec<S::State> = (0..vertices.len())
            .map(|k| *scene.state.initial.at(k))
            .collect();
        let potentials = (0..vertices.len())
            .map(|k| Radial {
                law: scene.friction.law.at(k).clone(),
                force: weights[k] * scene.friction.normal_stress.at(k).abs(),
                state: states[k].into(),
            })
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
        let mut simulation = Self {
            displacement: or_zeros(&scene.initial.displacement),
            velocity: or_zeros(&scene.initial.velocity),
            acceleration: if inertia {
                or_zeros(&scene.initial.acceleration)
            } else {
                Vec::new()
            },
            predicted_displacement: zeros(),
            predicted_acceleration: if inertia { zeros() } else { Vec::new() },
            trial: Trial {
                load: zeros(),
                velocity: zeros(),
                change: zeros(),
                solves: 0,
                state_changes: [0.0; 2],
                proposed: states.clone(),
                states: states.clone(),
                potentials,
                solver_iterations: 0,
            },
            states,
            scene,
            scheme,
            solver: Box::new(solver),
            coupling: Box::new(FixedPoint::default()),
            tolerance: 1e-10,
            operator,
            norm,
            prepared: None,
            equivalence: f64::INFINITY,
            vertices,
            weights,
            fixed,
            clock: Clock::default(),
            report: StepReport::default(),
        };
        if simulation.scene.initial.in_equilibrium {
            simulation.balance()?;
        }
        Ok(simulation)
    }

    /// Replaces the coupling, [`FixedPoint`] by default.
    #[must_use]
    pub fn with_coupling(mut self, coupling: impl Coupling + 'static) -> Self {
        self.coupling = Box::new(coupling);
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

    /// The initial displacement: `A u = l` without friction, by the velocity solver itself.
    fn balance(&mut self) -> Result<(), SceneError> {
        fill_load(&self.scene.load, 0.0, &mut self.trial.load);
        let energy = Energy {
            operator: &self.scene.stiffness,
            load: &self.trial.load,
            potentials: &[],
            vertices: &[],
            fixed: &self.fixed,
        };
        self.solver.prepare(&energy)?;
        for (displacement, fixed) in self.displacement.iter_mut().zip(&self.fixed) {
            for c in (0..C).filter(|&c| fixed[c]) {
                displacement[c] = 0.0;
            }
        }
        let stopping = Stopping {
            norm: &self.norm,
            tolerance: f64::MIN_POSITIVE,
            relative: 1e-13,
            equivalence: f64::INFINITY,
            max_iterations: MAX_ITERATIONS,
        };
        self.solver
            .minimize(&energy, &stopping, &mut self.displacement)?;
        Ok(())
    }

    fn try_step(&mut self, dt: f64, next: &Clock) -> Result<(), StepError> {
        let coefficients = self.prepare(dt)?;
        self.predict(dt, next.time())?;
        let coupled = self.couple(dt)?;
        self.accept(&coefficients);
        self.report = StepReport {
            coupling_iterations: coupled,
            solver_iterations: self.trial.solver_iterations,
        };
        Ok(())
    }

    /// The operator of this step size, and whatever the solver makes of it.
    fn prepare(&mut self, dt: f64) -> Result<Coefficients, StepError> {
        if !(dt > 0.0 && dt.is_finite()) {
            return Err(StepError::StepSize { dt });
        }
        let coefficients = self.scheme.coefficients(dt);
        if self.prepared == Some(dt) {
            return Ok(coefficients);
        }
        self.prepared = None;
        match &self.scene.mass {
            Some(mass) => self.operator.set_combination(&[
                (coefficients.displacement, &self.scene.stiffness),
                (coefficients.acceleration, mass),
            ]),
            None => self
                .operator
                .set_combination(&[(coefficients.displacement, &self.scene.stiffness)]),
        }
        self.solver.prepare(&Energy {
            operator: &self.operator,
            load: &self.trial.load,
            potentials: &self.trial.potentials,
            vertices: &self.vertices,
            fixed: &self.fixed,
        })?;
        // The norm is A + M, the operator c_u A + c_a M.
        self.equivalence = match &self.scene.mass {
            Some(_) => coefficients
                .displacement
                .min(coefficients.acceleration)
                .recip(),
            None => coefficients.displacement.recip(),
        };
        self.prepared = Some(dt);
        Ok(coefficients)
    }

    /// `r = l - M a^ - A u^`, the prescribed velocities of the new time, the start of the coupling.
    fn predict(&mut self, dt: f64, time: f64) -> Result<(), StepError> {
        for i in 0..self.displacement.len() {
            for c in 0..C {
                let predicted = self.scheme.predict(
                    dt,
                    Motion {
                        displacement: self.displacement[i][c],
                        velocity: self.velocity[i][c],
                        acceleration: self.acceleration.get(i).map_or(0.0, |a| a[c]),
                    },
                );
                self.predicted_displacement[i][c] = predicted.displacement;
                if let Some(a) = self.predicted_acceleration.get_mut(i) {
                    a[c] = predicted.acceleration;
                }
            }
        }
        let trial = &mut self.trial;
        fill_load(&self.scene.load, time, &mut trial.load);
        self.scene
            .stiffness
            .multiply_add(-1.0, &self.predicted_displacement, &mut trial.load);
        if let Some(mass) = &self.scene.mass {
            mass.multiply_add(-1.0, &self.predicted_acceleration, &mut trial.load);
        }
        trial.velocity.copy_from_slice(&self.velocity);
        for (value, fixed) in trial.velocity.iter_mut().zip(&self.fixed) {
            for c in (0..C).filter(|&c| fixed[c]) {
                value[c] = 0.0;
            }
        }
        for moved in &self.scene.moved {
            let velocity = (moved.velocity)(time);
            for &vertex in &moved.patch.vertices {
                for c in (0..C).filter(|&c| moved.components[c]) {
                    trial.velocity[vertex][c] = velocity[c];
                }
            }
        }
        finite("prescribed velocity", &trial.velocity)?;
        finite("load", &trial.load)
    }

    /// Rate and state of the new time; returns the number of velocity problems.
    fn couple(&mut self, dt: f64) -> Result<usize, StepError> {
        self.trial.states.copy_from_slice(&self.states);
        self.trial.solver_iterations = 0;
        self.trial.solves = 0;
        let mut maps = Maps {
            operator: &self.operator,
            norm: &self.norm,
            solver: &mut *self.solver,
            state_law: &self.scene.state.law,
            vertices: &self.vertices,
            weights: &self.weights,
            fixed: &self.fixed,
            from: &self.states,
            dt,
            equivalence: self.equivalence,
            trial: &mut self.trial,
        };
        if size_of::<S::State>() == 0 {
            maps.solve(self.tolerance)?;
            return Ok(1);
        }
        let report = self.coupling.couple(&mut maps, self.tolerance)?;
        Ok(report.iterations)
    }

    /// `u`, `v`, `a` and the state of the new time take the place of the old ones.
    fn accept(&mut self, coefficients: &Coefficients) {
        for i in 0..self.displacement.len() {
            for c in 0..C {
                let motion = coefficients.motion(
                    self.trial.velocity[i][c],
                    Predicted {
                        displacement: self.predicted_displacement[i][c],
                        acceleration: self.predicted_acceleration.get(i).map_or(0.0, |a| a[c]),
                    },
                );
                self.displacement[i][c] = motion.displacement;
                if let Some(a) = self.acceleration.get_mut(i) {
                    a[c] = motion.acceleration;
                }
            }
        }
        std::mem::swap(&mut self.velocity, &mut self.trial.velocity);
        std::mem::swap(&mut self.states, &mut self.trial.states);
    }
}

impl<Op, L, S, R, const C: usize> Stepper<C> for Simulation<Op, L, S, R, C>
where
    Op: Operator<C>,
    L: FrictionLaw + Clone,
    S: StateLaw,
    L::State: From<S::State>,
    R: RateScheme,
{
    fn step(&mut self, dt: f64) -> Result<StepReport, Failure> {
        let next = self.clock.after(dt);
        self.try_step(dt, &next).map_err(|cause| Failure {
            step: next.step,
            time: next.time(),
            cause,
        })?;
        self.clock = next;
        Ok(self.report)
    }

    fn snapshot(&self) -> Snapshot<'_, C> {
        Snapshot {
            step: self.clock.step,
            time: self.clock.time(),
            displacement: &self.displacement,
            velocity: &self.velocity,
            acceleration: &self.acceleration,
            frictional: &self.vertices,
            states: &self.states,
            report: self.report,
        }
    }
}

fn fill_load<const C: usize>(load: &Load<C>, time: f64, target: &mut [SVector<f64, C>]) {
    match load {
        Load::None => target.fill(SVector::zeros()),
        Load::Constant(load) => target.copy_from_slice(load),
        Load::History(history) => {
            target.fill(SVector::zeros());
            history(time, target);
        }
    }
}

fn finite<const C: usize>(what: &'static str, field: &[SVector<f64, C>]) -> Result<(), StepError> {
    for (vertex, value) in field.iter().enumerate() {
        if let Some(&value) = value.iter().find(|value| !value.is_finite()) {
            return Err(StepError::Data {
                what,
                vertex,
                value,
            });
        }
    }
    Ok(())
}

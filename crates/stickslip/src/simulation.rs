//! The time loop.

use nalgebra::SVector;
use stickslip_friction::FrictionLaw;
use stickslip_state::{StateLaw, StateVariable};
use stickslip_time::{Coefficients, Motion, RateScheme, Stages};
use stickslip_tnnmg::{Energy, NonsmoothSolver, Operator};

use crate::clock::Clock;
use crate::doubling::Doubling;
use crate::highest_frequency::highest_frequency;
use crate::maps::Maps;
use crate::scene::{Load, Scene};
use crate::state_update::StepStart;
use crate::{
    Coupling, CouplingReport, ErrorControl, Failure, InterfacePotential, Snapshot, StateUpdate,
    StepError, StepReport, Stepper,
};

/// A scene in motion: scene, scheme, solver and coupling, and the last accepted step.
///
/// ```text
/// (u, v, a, alpha) -> (u^, a^) -> r = l - M a^ - A u^ -> { alpha from v, v from alpha } -> (u, v, a, alpha)
/// ```
///
/// All memory is taken in [`new`](Simulation::new). The operator `c_a M + C + c_u A` is formed anew
/// only when the step size changes.
pub struct Simulation<Op, L, S, R, const C: usize>
where
    L: FrictionLaw,
    S: StateLaw,
    L::State: From<S::State>,
{
    pub(crate) scene: Scene<Op, L, S, C>,
    pub(crate) scheme: R,
    pub(crate) solver: Box<dyn NonsmoothSolver<Op, InterfacePotential<L, S>, C>>,
    pub(crate) coupling: Box<dyn Coupling>,
    pub(crate) state_update: StateUpdate,
    pub(crate) tolerance: f64,
    /// `c_a M + C + c_u A` for the step size `prepared`.
    pub(crate) operator: Op,
    /// `A + M`.
    pub(crate) norm: Op,
    pub(crate) prepared: Option<f64>,
    /// The stiffness is no part of the operator.
    pub(crate) explicit: bool,
    /// The largest stable step \[s\], once it is known.
    pub(crate) step_limit: Option<f64>,
    pub(crate) equivalence: f64,
    pub(crate) vertices: Vec<usize>,
    pub(crate) weights: Vec<f64>,
    pub(crate) fixed: Vec<[bool; C]>,
    /// The vertices with a fixed component.
    pub(crate) held: Vec<usize>,
    pub(crate) now: Accepted<S::State, C>,
    /// The last accepted step, while a step of two stages is under way.
    pub(crate) old: Option<Box<Accepted<S::State, C>>>,
    pub(crate) predicted_displacement: Vec<SVector<f64, C>>,
    pub(crate) predicted_acceleration: Vec<SVector<f64, C>>,
    pub(crate) trial: Trial<L, S, C>,
    pub(crate) doubling: Option<Box<Doubling<S::State, C>>>,
}

/// An accepted step: motion of all vertices, state of the frictional ones.
#[derive(Debug, Clone)]
pub(crate) struct Accepted<T, const C: usize> {
    pub(crate) clock: Clock,
    pub(crate) displacement: Vec<SVector<f64, C>>,
    pub(crate) velocity: Vec<SVector<f64, C>>,
    /// Empty without mass.
    pub(crate) acceleration: Vec<SVector<f64, C>>,
    pub(crate) states: Vec<T>,
    /// The velocity of the frictional vertices one step earlier, and the step since; empty without
    /// state.
    pub(crate) earlier: Vec<SVector<f64, C>>,
    pub(crate) last_step: f64,
    pub(crate) report: StepReport,
}

impl<T: StateVariable, const C: usize> Accepted<T, C> {
    /// `old + weight (self - old)`.
    fn move_beyond(&mut self, old: &Self, weight: f64) {
        for (now, old) in [
            (&mut self.displacement, &old.displacement),
            (&mut self.velocity, &old.velocity),
        ] {
            for (now, old) in now.iter_mut().zip(old) {
                *now = old + (*now - old) * weight;
            }
        }
        for (now, old) in self.states.iter_mut().zip(&old.states) {
            let (to, from) = (now.value(), old.value());
            *now = T::from_value(from + weight * (to - from));
        }
    }

    /// Takes the values of another step of the same scene.
    pub(crate) fn copy_from(&mut self, other: &Self) {
        self.clock = other.clock;
        self.displacement.copy_from_slice(&other.displacement);
        self.velocity.copy_from_slice(&other.velocity);
        self.acceleration.copy_from_slice(&other.acceleration);
        self.states.copy_from_slice(&other.states);
        self.earlier.copy_from_slice(&other.earlier);
        self.last_step = other.last_step;
        self.report = other.report;
    }
}

/// The step being taken.
pub(crate) struct Trial<L: FrictionLaw, S: StateLaw, const C: usize>
where
    L::State: From<S::State>,
{
    /// `r`.
    pub(crate) load: Vec<SVector<f64, C>>,
    pub(crate) velocity: Vec<SVector<f64, C>>,
    /// By how much the last velocity problem moved the velocity.
    pub(crate) change: Vec<SVector<f64, C>>,
    /// Velocity problems solved, and the changes of the state before the last two of them.
    pub(crate) solves: usize,
    pub(crate) state_changes: [f64; 2],
    /// The state proposed last; the one in use is part of the potentials.
    pub(crate) proposed: Vec<S::State>,
    /// The last two differences between them, the latest at the end; empty without state.
    pub(crate) differences: Vec<[f64; 2]>,
    pub(crate) potentials: Vec<InterfacePotential<L, S>>,
    /// The normal stress of the frictional vertices, where it depends on time \[Pa\].
    pub(crate) normal_stress: Vec<f64>,
    pub(crate) solver_iterations: usize,
}

impl<Op, L, S, R, const C: usize> Simulation<Op, L, S, R, C>
where
    Op: Operator<C>,
    L: FrictionLaw + Clone,
    S: StateLaw + Clone,
    L::State: From<S::State>,
    R: RateScheme,
{
    fn try_step(&mut self, dt: f64, next: &Clock) -> Result<(), StepError> {
        let (mut coupled, mut iterations) = (CouplingReport::default(), 0);
        match self.scheme.stages() {
            None => self.stage(dt, next.time(), &mut coupled, &mut iterations)?,
            Some(stages) => {
                let old = self.take_old();
                let result = self.two_stages(dt, next, stages, &old, &mut coupled, &mut iterations);
                if result.is_err() {
                    self.now.copy_from(&old);
                }
                self.old = Some(old);
                result?;
            }
        }
        self.now.report = StepReport {
            coupling_iterations: coupled.iterations,
            solver_iterations: iterations,
            fell_back: coupled.fell_back,
            weakening: coupled.weakening,
        };
        self.now.clock = *next;
        Ok(())
    }

    /// A copy of the last accepted step; takes memory the first time.
    fn take_old(&mut self) -> Box<Accepted<S::State, C>> {
        match self.old.take() {
            Some(mut old) => {
                old.copy_from(&self.now);
                old
            }
            None => Box::new(self.now.clone()),
        }
    }

    fn two_stages(
        &mut self,
        dt: f64,
        next: &Clock,
        stages: Stages,
        old: &Accepted<S::State, C>,
        coupled: &mut CouplingReport,
        iterations: &mut usize,
    ) -> Result<(), StepError> {
        let part = stages.share * dt;
        let first = self.now.clock.time() + part;
        self.stage(part, first, coupled, iterations)?;
        self.now.move_beyond(old, stages.weight);
        self.stage(part, next.time(), coupled, iterations)
    }

    /// The scheme itself over `dt`, to the time `time`.
    fn stage(
        &mut self,
        dt: f64,
        time: f64,
        total: &mut CouplingReport,
        iterations: &mut usize,
    ) -> Result<(), StepError> {
        let coefficients = self.prepare(dt)?;
        self.predict(dt, time)?;
        self.load_friction(dt, time)?;
        let coupled = self.couple(dt)?;
        total.iterations += coupled.iterations;
        total.fell_back |= coupled.fell_back;
        total.weakening = total.weakening.max(coupled.weakening);
        *iterations += self.trial.solver_iterations;
        self.accept(&coefficients);
        self.now.last_step = dt;
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
        self.check_stability(dt)?;
        let Scene {
            stiffness,
            mass,
            viscosity,
            ..
        } = &self.scene;
        let stiffness = (coefficients.displacement, stiffness);
        let inertia = |mass| (coefficients.acceleration, mass);
        match (self.explicit, mass, viscosity) {
            (false, None, None) => self.operator.set_combination(&[stiffness]),
            (false, Some(m), None) => self.operator.set_combination(&[stiffness, inertia(m)]),
            (false, None, Some(c)) => self.operator.set_combination(&[stiffness, (1.0, c)]),
            (false, Some(m), Some(c)) => {
                self.operator
                    .set_combination(&[stiffness, inertia(m), (1.0, c)]);
            }
            (true, Some(m), None) => self.operator.set_combination(&[inertia(m)]),
            (true, Some(m), Some(c)) => self.operator.set_combination(&[inertia(m), (1.0, c)]),
            (true, None, _) => {}
        }
        self.solver.prepare(&Energy {
            operator: &self.operator,
            load: &self.trial.load,
            potentials: &self.trial.potentials,
            vertices: &self.vertices,
            fixed: &self.fixed,
        })?;
        // The norm is A + M, the operator c_u A + c_a M and more; without A in explicit schemes.
        let factors = match (&self.scene.mass, self.explicit) {
            (Some(_), true) => coefficients.acceleration,
            (Some(_), false) => coefficients.displacement.min(coefficients.acceleration),
            (None, _) => coefficients.displacement,
        };
        self.equivalence = factors.recip();
        self.prepared = Some(dt);
        Ok(coefficients)
    }

    /// Refuses a step that an explicit scheme does not bear; the limit is computed once.
    fn check_stability(&mut self, dt: f64) -> Result<(), StepError> {
        let (Some(bound), Some(mass)) = (self.scheme.stability_limit(), &self.scene.mass) else {
            return Ok(());
        };
        let limit = match self.step_limit {
            Some(limit) => limit,
            None => {
                let (stiffness, solver) = (&self.scene.stiffness, &mut *self.solver);
                let highest = highest_frequency(stiffness, mass, &self.fixed, solver)?;
                *self.step_limit.insert(bound / highest)
            }
        };
        if dt > limit {
            return Err(StepError::Unstable { dt, limit });
        }
        Ok(())
    }

    /// `r = l - M a^ - A u^`, the prescribed velocities of the new time, the start of the coupling.
    fn predict(&mut self, dt: f64, time: f64) -> Result<(), StepError> {
        let scheme = &self.scheme;
        let fields = self.now.displacement.iter().zip(&self.now.velocity);
        let targets = self.predicted_displacement.iter_mut();
        if self.scene.mass.is_some() {
            let accelerations = self.now.acceleration.iter();
            let second_targets = self.predicted_acceleration.iter_mut();
            for (((u, v), a), (to_u, to_a)) in
                fields.zip(accelerations).zip(targets.zip(second_targets))
            {
                for c in 0..C {
                    let motion = Motion {
                        displacement: u[c],
                        velocity: v[c],
                        acceleration: a[c],
                    };
                    let predicted = scheme.predict(dt, motion);
                    to_u[c] = predicted.displacement;
                    to_a[c] = predicted.acceleration;
                }
            }
        } else {
            for ((u, v), to) in fields.zip(targets) {
                for c in 0..C {
                    let motion = Motion {
                        displacement: u[c],
                        velocity: v[c],
                        acceleration: 0.0,
                    };
                    to[c] = scheme.predict(dt, motion).displacement;
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
        trial.velocity.copy_from_slice(&self.now.velocity);
        for &vertex in &self.held {
            for c in (0..C).filter(|&c| self.fixed[vertex][c]) {
                trial.velocity[vertex][c] = 0.0;
            }
        }
        for moved in &self.scene.moved {
            let velocity = (moved.velocity)(time);
            for &vertex in &moved.patch.vertices {
                for c in (0..C).filter(|&c| moved.components[c]) {
                    trial.velocity[vertex][c] = velocity[c];
                }
            }
            finite(
                "prescribed velocity",
                &trial.velocity,
                &moved.patch.vertices,
            )?;
        }
        // The sum is finite if all terms are, but for overflow, which no step survives either.
        let sum: f64 = trial.load.iter().map(SVector::sum).sum();
        if sum.is_finite() {
            return Ok(());
        }
        finite("load", &trial.load, 0..trial.load.len())?;
        Err(StepError::Data {
            what: "the sum of the load",
            vertex: 0,
            value: sum,
        })
    }

    /// Normal stress of the new time, and what the state starts from.
    fn load_friction(&mut self, dt: f64, time: f64) -> Result<(), StepError> {
        if let Some(history) = &self.scene.friction.stress_history {
            for (k, stress) in self.trial.normal_stress.iter_mut().enumerate() {
                *stress = *self.scene.friction.normal_stress.at(k);
            }
            history(time, &mut self.trial.normal_stress);
            for (k, &stress) in self.trial.normal_stress.iter().enumerate() {
                if !stress.is_finite() {
                    return Err(StepError::Data {
                        what: "normal stress",
                        vertex: self.vertices[k],
                        value: stress,
                    });
                }
                self.trial.potentials[k].law.normal_stress = stress.abs();
            }
        }
        if size_of::<S::State>() > 0 {
            for (k, potential) in self.trial.potentials.iter_mut().enumerate() {
                potential.law.state = self.now.states[k];
                potential.law.guess.set(None);
                potential.law.start = StepStart {
                    state: self.now.states[k],
                    slip_rate: self.now.velocity[self.vertices[k]].norm(),
                    dt,
                    // A stage of a Runge-Kutta method is backward Euler, for the state too.
                    update: match self.scheme.stages() {
                        Some(_) => StateUpdate::BackwardEuler,
                        None => self.state_update,
                    },
                };
            }
        }
        Ok(())
    }

    /// Rate and state of the new time.
    fn couple(&mut self, dt: f64) -> Result<CouplingReport, StepError> {
        self.trial.solver_iterations = 0;
        self.trial.solves = 0;
        let mut maps = Maps {
            operator: &self.operator,
            norm: &self.norm,
            solver: &mut *self.solver,
            vertices: &self.vertices,
            weights: &self.weights,
            fixed: &self.fixed,
            from: &self.now.velocity,
            earlier: &self.now.earlier,
            growth: if self.now.last_step > 0.0 {
                dt / self.now.last_step
            } else {
                0.0
            },
            equivalence: self.equivalence,
            trial: &mut self.trial,
        };
        if size_of::<S::State>() == 0 {
            maps.solve(self.tolerance)?;
            return Ok(CouplingReport {
                iterations: 1,
                ..CouplingReport::default()
            });
        }
        self.coupling.couple(&mut maps, self.tolerance)
    }

    /// `u`, `v`, `a` and the state of the new time take the place of the old ones.
    fn accept(&mut self, coefficients: &Coefficients) {
        let c_u = coefficients.displacement;
        let fields = self.trial.velocity.iter().zip(&self.predicted_displacement);
        for (u, (v, predicted)) in self.now.displacement.iter_mut().zip(fields) {
            *u = v * c_u + predicted;
        }
        let c_a = coefficients.acceleration;
        let fields = self.trial.velocity.iter().zip(&self.predicted_acceleration);
        for (a, (v, predicted)) in self.now.acceleration.iter_mut().zip(fields) {
            *a = v * c_a + predicted;
        }
        for (earlier, &vertex) in self.now.earlier.iter_mut().zip(&self.vertices) {
            *earlier = self.now.velocity[vertex];
        }
        std::mem::swap(&mut self.now.velocity, &mut self.trial.velocity);
        for (state, potential) in self.now.states.iter_mut().zip(&self.trial.potentials) {
            *state = potential.law.state;
        }
    }
}

impl<Op, L, S, R, const C: usize> Stepper<C> for Simulation<Op, L, S, R, C>
where
    Op: Operator<C>,
    L: FrictionLaw + Clone,
    S: StateLaw + Clone,
    L::State: From<S::State>,
    R: RateScheme,
{
    fn step(&mut self, dt: f64) -> Result<StepReport, Failure> {
        let next = self.now.clock.after(dt);
        self.try_step(dt, &next).map_err(|cause| Failure {
            step: next.step,
            time: next.time(),
            cause,
        })?;
        Ok(self.now.report)
    }

    fn snapshot(&self) -> Snapshot<'_, C> {
        Snapshot {
            step: self.now.clock.step,
            time: self.now.clock.time(),
            displacement: &self.now.displacement,
            velocity: &self.now.velocity,
            acceleration: &self.now.acceleration,
            frictional: &self.vertices,
            states: &self.now.states,
            report: self.now.report,
        }
    }

    fn step_estimated(&mut self, dt: f64, control: &ErrorControl) -> Result<f64, Failure> {
        self.double(dt, control)
    }

    fn order(&self) -> usize {
        let staged = self.scheme.stages().is_some();
        let first_order = !staged && self.state_update == StateUpdate::BackwardEuler;
        if size_of::<S::State>() > 0 && first_order {
            1
        } else {
            self.scheme.order()
        }
    }

    fn error_order(&self, control: &ErrorControl) -> usize {
        control.error_order(self.order(), self.is_symmetric())
    }

    fn undo(&mut self) {
        if let Some(doubling) = &self.doubling {
            self.now.copy_from(&doubling.start);
        }
    }
}

pub(crate) fn fill_load<const C: usize>(load: &Load<C>, time: f64, target: &mut [SVector<f64, C>]) {
    match load {
        Load::None => target.fill(SVector::zeros()),
        Load::Constant(load) => target.copy_from_slice(load),
        Load::History(history) => {
            target.fill(SVector::zeros());
            history(time, target);
        }
    }
}

fn finite<const C: usize>(
    what: &'static str,
    field: &[SVector<f64, C>],
    vertices: impl IntoIterator<Item = impl std::borrow::Borrow<usize>>,
) -> Result<(), StepError> {
    for vertex in vertices {
        let vertex = *vertex.borrow();
        if let Some(&value) = field[vertex].iter().find(|value| !value.is_finite()) {
            return Err(StepError::Data {
                what,
                vertex,
                value,
            });
        }
    }
    Ok(())
}

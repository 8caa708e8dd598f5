//! The time loop.

use nalgebra::SVector;
use stickslip_friction::FrictionLaw;
use stickslip_state::{StateLaw, StateVariable};
use stickslip_time::{Coefficients, Motion, Predicted, RateScheme, Stages};
use stickslip_tnnmg::{Energy, NonsmoothSolver, Operator};

use crate::clock::Clock;
use crate::doubling::Doubling;
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
    pub(crate) equivalence: f64,
    pub(crate) vertices: Vec<usize>,
    pub(crate) weights: Vec<f64>,
    pub(crate) fixed: Vec<[bool; C]>,
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
        let coupled = self.couple()?;
        total.iterations += coupled.iterations;
        total.fell_back |= coupled.fell_back;
        *iterations += self.trial.solver_iterations;
        self.accept(&coefficients);
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
        let stiffness = (coefficients.displacement, &self.scene.stiffness);
        let mass = |mass| (coefficients.acceleration, mass);
        match (&self.scene.mass, &self.scene.viscosity) {
            (None, None) => self.operator.set_combination(&[stiffness]),
            (Some(m), None) => self.operator.set_combination(&[stiffness, mass(m)]),
            (None, Some(c)) => self.operator.set_combination(&[stiffness, (1.0, c)]),
            (Some(m), Some(c)) => self
                .operator
                .set_combination(&[stiffness, mass(m), (1.0, c)]),
        }
        self.solver.prepare(&Energy {
            operator: &self.operator,
            load: &self.trial.load,
            potentials: &self.trial.potentials,
            vertices: &self.vertices,
            fixed: &self.fixed,
        })?;
        // The norm is A + M, the operator c_u A + c_a M and more.
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
        for i in 0..self.now.displacement.len() {
            for c in 0..C {
                let predicted = self.scheme.predict(
                    dt,
                    Motion {
                        displacement: self.now.displacement[i][c],
                        velocity: self.now.velocity[i][c],
                        acceleration: self.now.acceleration.get(i).map_or(0.0, |a| a[c]),
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
        trial.velocity.copy_from_slice(&self.now.velocity);
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
    fn couple(&mut self) -> Result<CouplingReport, StepError> {
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
            equivalence: self.equivalence,
            trial: &mut self.trial,
        };
        if size_of::<S::State>() == 0 {
            maps.solve(self.tolerance)?;
            return Ok(CouplingReport {
                iterations: 1,
                fell_back: false,
            });
        }
        self.coupling.couple(&mut maps, self.tolerance)
    }

    /// `u`, `v`, `a` and the state of the new time take the place of the old ones.
    fn accept(&mut self, coefficients: &Coefficients) {
        for i in 0..self.now.displacement.len() {
            for c in 0..C {
                let motion = coefficients.motion(
                    self.trial.velocity[i][c],
                    Predicted {
                        displacement: self.predicted_displacement[i][c],
                        acceleration: self.predicted_acceleration.get(i).map_or(0.0, |a| a[c]),
                    },
                );
                self.now.displacement[i][c] = motion.displacement;
                if let Some(a) = self.now.acceleration.get_mut(i) {
                    a[c] = motion.acceleration;
                }
            }
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

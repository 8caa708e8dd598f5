//! The time loop.

use nalgebra::SVector;
use stickslip_friction::FrictionLaw;
use stickslip_state::StateLaw;
use stickslip_time::{Coefficients, QuasiStatic, RateScheme, Stages};
use stickslip_tnnmg::{Energy, NonsmoothSolver, Operator};

use crate::accepted::Accepted;
use crate::clock::Clock;
use crate::highest_frequency::highest_frequency;
use crate::local_error::Comparison;
use crate::maps::Maps;
use crate::scene::Scene;
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
    pub(crate) comparison: Option<Box<Comparison<S::State, C>>>,
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
        let mut report = StepReport::default();
        match self.scheme.stages() {
            None => self.stage(dt, next.time(), &mut report)?,
            Some(stages) => {
                let old = self.take_old();
                let result = self.two_stages(dt, next, stages, &old, &mut report);
                if result.is_err() {
                    self.now.copy_from(&old);
                }
                self.old = Some(old);
                result?;
            }
        }
        self.now.report = report;
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
        report: &mut StepReport,
    ) -> Result<(), StepError> {
        let part = stages.share * dt;
        let first = self.now.clock.time() + part;
        self.stage(part, first, report)?;
        self.now.move_beyond(old, stages.weight);
        self.stage(part, next.time(), report)
    }

    /// The scheme itself over `dt`, to the time `time`; adds what it costs to `report`.
    fn stage(&mut self, dt: f64, time: f64, report: &mut StepReport) -> Result<(), StepError> {
        let coefficients = self.prepare(dt)?;
        self.predict(dt, time)?;
        self.load_friction(dt, time)?;
        let coupled = self.couple(dt)?;
        report.coupling_iterations += coupled.iterations;
        report.solver_iterations += self.trial.solver_iterations;
        report.fell_back |= coupled.fell_back;
        report.weakening = report.weakening.max(coupled.weakening);
        self.accept(dt, &coefficients);
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
        let scene = &self.scene;
        let stiffness = (coefficients.displacement, &scene.stiffness);
        let mut terms = [stiffness; 3];
        let mut count = 0;
        for term in [
            (!self.explicit).then_some(stiffness),
            (scene.mass.as_ref()).map(|mass| (coefficients.acceleration, mass)),
            (scene.viscosity.as_ref()).map(|viscosity| (1.0, viscosity)),
        ]
        .into_iter()
        .flatten()
        {
            terms[count] = term;
            count += 1;
        }
        self.operator.set_combination(&terms[..count]);
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
            // The second of two stages starts where the first one points to.
            growth: if self.now.last_step > 0.0 && self.scheme.stages().is_none() {
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

    fn time_left(&self, until: f64) -> f64 {
        self.now.clock.left(until)
    }

    fn step_estimated(&mut self, dt: f64, control: &ErrorControl) -> Result<f64, Failure> {
        self.compare(dt, control)
    }

    fn order(&self) -> usize {
        let staged = self.scheme.stages().is_some();
        let euler = self.state_update == StateUpdate::BackwardEuler && size_of::<S::State>() > 0;
        if euler && !staged {
            1
        } else if self.scene.mass.is_some() {
            self.scheme.order()
        } else {
            QuasiStatic(&self.scheme).order()
        }
    }

    fn error_order(&self, control: &ErrorControl) -> usize {
        control.error_order(self.order(), self.is_symmetric())
    }

    fn undo(&mut self) {
        if let Some(comparison) = &self.comparison {
            self.now.copy_from(&comparison.start);
        }
    }
}

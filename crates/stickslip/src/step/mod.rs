//! The time step: prepare, predict, couple, accept.

mod acceleration;
mod build;
mod clock;
mod contact_view;
mod convexity;
mod coupling;
mod definite;
mod error;
mod fixed_point;
mod following;
mod highest_frequency;
mod holding;
mod method;
mod monolithic;
mod motion;
mod operators;
pub(crate) mod placement;
pub(crate) mod reduction;
mod residuals;
mod seen;
mod simulation;
mod snapshot;
mod source;
mod staggered;
pub(crate) mod state;
mod velocity_problem;

pub(crate) use acceleration::Accelerations;
pub use clock::Clock;
pub use contact_view::AtContact;
pub use convexity::Convexity;
pub use coupling::{Coupling, CouplingReport, StepMaps};
pub use error::{Failure, StepError};
pub use fixed_point::FixedPoint;
pub(crate) use following::Following;
pub(crate) use method::{Method, Tolerance};
pub use monolithic::Monolithic;
pub use residuals::Residuals;
pub(crate) use seen::Seen;
pub use simulation::Simulation;
pub use snapshot::{Snapshot, StepReport};
pub(crate) use source::{Source, StepEnd};
pub use staggered::Staggered;
pub use state::{ContactState, ControlState, StepState};

use nalgebra::SVector;
use stickslip_friction::modulus;
use stickslip_time::Rule;
use stickslip_tnnmg::{Energy, Operator};

use crate::contact::StateStep;
use crate::scene::same_mesh;
use reduction::agreed;
use velocity_problem::{Passages, VelocityProblem};

/// The step being taken.
pub(crate) struct Trial<const C: usize> {
    /// `u^` and `a^`; the latter is empty without mass.
    pub(crate) displacement: Vec<SVector<f64, C>>,
    pub(crate) acceleration: Vec<SVector<f64, C>>,
    /// `r`.
    pub(crate) load: Vec<SVector<f64, C>>,
    pub(crate) velocity: Vec<SVector<f64, C>>,
    /// By how much the last velocity problem moved the velocity.
    pub(crate) change: Vec<SVector<f64, C>>,
    pub(crate) scratch: Vec<SVector<f64, C>>,
    /// Products with the operator at the frictional vertices.
    pub(crate) products: Vec<SVector<f64, C>>,
    /// What the coupling remembers.
    pub(crate) memory: [f64; 4],
    pub(crate) solver_iterations: usize,
    /// The accepted step that load and operator still belong to.
    pub(crate) balanced: Option<Clock>,
}

impl<Op: Operator<C>, const C: usize> Simulation<Op, C> {
    /// Takes one step of `dt` \[s\].
    ///
    /// # Errors
    /// [`Failure`]; the last accepted step stays in place and another `dt` may be tried.
    pub fn step(&mut self, dt: f64) -> Result<StepReport, Failure> {
        let report = self.step_unseen(dt)?;
        self.seen.show(&self.state);
        Ok(report)
    }

    /// [`step`](Self::step) for another one that follows before anything is seen.
    pub(crate) fn step_unseen(&mut self, dt: f64) -> Result<StepReport, Failure> {
        let next = self.state.clock.after(dt);
        self.keep_acceleration();
        if let Err(cause) = self.try_step(dt, &next) {
            self.contacts.set_normal_stress(&self.state.contacts);
            self.restore_acceleration();
            return Err(Failure {
                step: next.step(),
                time: next.time(),
                cause,
            });
        }
        Ok(self.state.report)
    }

    fn try_step(&mut self, dt: f64, next: &Clock) -> Result<(), StepError> {
        if !(dt > 0.0 && dt.is_finite()) {
            return Err(StepError::StepSize { dt });
        }
        self.trial.balanced = None;
        let stages = self.method.scheme.facts().stages;
        let old = (stages.len() > 1).then(|| self.take_old());
        let begin = self.state.clock.time();
        let mut report = StepReport::default();
        let mut result = Ok(());
        for (k, stage) in stages.iter().enumerate() {
            if let (Some(old), true) = (&old, k > 0) {
                result = self
                    .contacts
                    .unload(&mut self.state.contacts, &old.contacts);
                if result.is_err() {
                    break;
                }
                self.state.lead(old, stage.lead);
            }
            let time = if k + 1 == stages.len() {
                next.time()
            } else {
                begin + stage.end * dt
            };
            result = self.stage(stage.share * dt, time, &mut report);
            if result.is_err() {
                break;
            }
        }
        if let Some(old) = old {
            if result.is_err() {
                self.state.copy_from(&old);
            } else {
                self.recount_slip(&old);
            }
            self.old = Some(old);
        }
        result?;
        self.state.report = report;
        self.state.clock = *next;
        self.trial.balanced = Some(*next);
        Ok(())
    }

    /// The scheme itself over `dt`, to the time `time`; adds what it costs to `report`.
    fn stage(&mut self, dt: f64, time: f64, report: &mut StepReport) -> Result<(), StepError> {
        let rule = self.prepare(dt)?;
        self.begin_acceleration(&rule, dt)?;
        self.predict(&rule, dt, time)?;
        let coupled = self.couple(dt);
        let mut followed = 0;
        let coupled = self.single_out(coupled, (dt, time), &mut followed)?;
        self.accept(&rule, dt);
        self.settle_acceleration(&rule, time, dt);
        report.coupling_iterations += coupled.iterations;
        report.solver_iterations += self.trial.solver_iterations;
        report.followed += followed;
        report.fell_back |= coupled.fell_back;
        report.weakening = report.weakening.max(coupled.weakening);
        Ok(())
    }

    /// The operator of this step size, and whatever the solver makes of it.
    fn prepare(&mut self, dt: f64) -> Result<Rule, StepError> {
        let rule = self.method.scheme.rule(dt);
        if self.operators.prepared == Some(dt) {
            return Ok(rule);
        }
        self.operators.prepared = None;
        same_mesh(self.scene.mesh, self.solver.mesh())?;
        let fixed = &self.constraints.fixed;
        self.operators.check_stability(&self.scene, fixed, dt)?;
        self.operators
            .form(&self.scene, &rule, &self.contacts.vertices);
        self.solver.prepare(&Energy {
            operator: &self.operators.step,
            load: &self.trial.load,
            potentials: &self.contacts,
            vertices: &self.contacts.vertices,
            fixed,
        })?;
        self.operators.prepared = Some(dt);
        Ok(rule)
    }

    /// `r = l - M a^ - A u^`, prescribed velocities, and what the states start from.
    fn predict(&mut self, rule: &Rule, dt: f64, time: f64) -> Result<(), StepError> {
        let (state, trial) = (&self.state, &mut self.trial);
        motion::predict(
            rule,
            state,
            &mut trial.displacement,
            &mut trial.acceleration,
        );
        trial.velocity.copy_from_slice(&state.velocity);
        let prescribed = self.constraints.prescribe(time, &mut trial.velocity);
        agreed(&self.scene.stiffness, prescribed)?;
        motion::move_prescribed(
            rule,
            state,
            &self.constraints,
            &trial.velocity,
            &mut trial.displacement,
        );
        self.move_accelerations(rule);
        let (state, trial, fixed) = (&self.state, &mut self.trial, &self.constraints.fixed);
        let step = StateStep {
            dt,
            update: self.method.update_of_a_stage(),
        };
        let begun = (self.contacts).begin(step, time, &state.contacts, &state.velocity);
        agreed(&self.scene.stiffness, begun)?;
        self.contacts.prescribe(fixed, &trial.velocity);
        self.loads.fill(time, &mut trial.load, &mut trial.scratch);
        self.contacts.add_tractions(true, &mut trial.load);
        (self.scene.stiffness).multiply_add(-1.0, &trial.displacement, &mut trial.load);
        if let Some(mass) = &self.scene.mass {
            mass.multiply_add(-1.0, &trial.acceleration, &mut trial.load);
        }
        agreed(
            &self.scene.stiffness,
            motion::check_finite("load", &trial.load),
        )
    }

    /// Rate and state of the new time.
    fn couple(&mut self, dt: f64) -> Result<CouplingReport, StepError> {
        self.trial.solver_iterations = 0;
        self.trial.memory = self.state.coupling;
        let tolerance = self.tolerance();
        let (coupling, mut problem) = self.problem(dt);
        if problem.contacts.have_state() {
            let report = coupling.couple(&mut problem, tolerance)?;
            problem.follow()?;
            Ok(report)
        } else {
            problem.solve(tolerance)?;
            problem.follow()?;
            Ok(CouplingReport::one_problem(problem.weakening()))
        }
    }

    /// The velocity problem of a step, and the coupling that is to solve it.
    fn problem(&mut self, dt: f64) -> (&dyn Coupling, VelocityProblem<'_, Op, C>) {
        let several = self.method.scheme.facts().stages.len() > 1;
        let problem = VelocityProblem {
            operators: &self.operators,
            solver: &mut *self.solver,
            contacts: &mut self.contacts,
            fixed: &self.constraints.fixed,
            from: &self.state,
            // A stage starts where the one before points to.
            growth: if self.state.last_step > 0.0 && !several {
                dt / self.state.last_step
            } else {
                0.0
            },
            trial: &mut self.trial,
            changed: false,
            // Steps that are compared change their size from one to the next.
            recurs: self.follows && (self.state.last_step == dt || self.state.last_step == 0.0),
            passages: Passages::default(),
        };
        (&*self.method.coupling, problem)
    }

    /// How far a velocity may be off, in the norm of the operators.
    fn tolerance(&self) -> f64 {
        let relative = match self.method.tolerance {
            Tolerance::Absolute(tolerance) => return tolerance,
            Tolerance::Relative(relative) => relative,
        };
        let mut scale = self.operators.scale(self.contacts.strengths());
        if scale == 0.0 {
            // Nothing but the motion to compare with.
            scale = self.operators.norm().norm(&self.trial.velocity);
        }
        (relative * scale).max(f64::MIN_POSITIVE)
    }

    /// The new motion and states take the place of the old ones.
    fn accept(&mut self, rule: &Rule, dt: f64) {
        motion::add_slip(rule, &self.contacts, &self.trial, &mut self.state);
        motion::accept(rule, &mut self.trial, &self.contacts, &mut self.state);
        self.contacts.accept(&mut self.state.contacts);
        self.state.coupling = self.trial.memory;
        self.state.last_step = dt;
    }

    /// A copy of the last accepted step; takes memory the first time.
    fn take_old(&mut self) -> Box<StepState<C>> {
        match self.old.take() {
            Some(mut old) => {
                old.copy_from(&self.state);
                old
            }
            None => Box::new(self.state.clone()),
        }
    }

    /// Counts the slip of a step of several stages from its beginning to its end.
    fn recount_slip(&mut self, old: &StepState<C>) {
        let contacts = self.contacts.contacts.iter().zip(&mut self.state.contacts);
        for ((contact, state), old_contact) in contacts.zip(&old.contacts) {
            for (k, &vertex) in contact.part.vertices.iter().enumerate() {
                let moved = self.state.displacement[vertex] - old.displacement[vertex];
                state.slip[k] = old_contact.slip[k] + modulus(&contact.tangential(k, &moved));
            }
        }
    }
}

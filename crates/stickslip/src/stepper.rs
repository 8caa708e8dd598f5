//! A simulation whose types are forgotten, and what can be seen of it.

use nalgebra::SVector;
use stickslip_state::StateVariable;

use crate::{ErrorControl, Failure};

/// What the last step cost.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct StepReport {
    /// Velocity problems solved.
    pub coupling_iterations: usize,
    /// Iterations of the velocity solver over all of these: multigrid cycles, or sweeps where the
    /// solver has no cycles.
    pub solver_iterations: usize,
    /// The coupling gave up, and the one it falls back on took the step.
    pub fell_back: bool,
    /// The vertices at which friction, its state following, weakens with the slip rate at the end of
    /// the step, if the coupling looks: [`Monolithic`](crate::Monolithic) does.
    pub weakening: usize,
}

/// The state of all frictional vertices, whatever variable the law integrates.
pub trait StateField {
    /// The state of the frictional vertex number `k`, in the law's own variable.
    fn state(&self, k: usize) -> f64;
}

impl<T: StateVariable> StateField for Vec<T> {
    fn state(&self, k: usize) -> f64 {
        self[k].value()
    }
}

/// The last accepted step.
#[derive(Clone, Copy)]
pub struct Snapshot<'a, const C: usize> {
    /// Its number; 0 is the initial state.
    pub step: usize,
    /// Its time \[s\].
    pub time: f64,
    /// `u`, one vector a vertex \[m\].
    pub displacement: &'a [SVector<f64, C>],
    /// `v`, one vector a vertex [m/s].
    pub velocity: &'a [SVector<f64, C>],
    /// `a`, one vector a vertex [m/s^2]; empty for a scene without mass.
    pub acceleration: &'a [SVector<f64, C>],
    /// The frictional vertices, increasing.
    pub frictional: &'a [usize],
    /// The state at the frictional vertices.
    pub states: &'a dyn StateField,
    /// What the step cost.
    pub report: StepReport,
}

impl<const C: usize> Snapshot<'_, C> {
    /// `|v|` at the frictional vertex number `k` [m/s].
    pub fn slip_rate(&self, k: usize) -> f64 {
        self.velocity[self.frictional[k]].norm()
    }

    /// The largest slip rate [m/s]; 0 without frictional vertices.
    pub fn max_slip_rate(&self) -> f64 {
        (0..self.frictional.len())
            .map(|k| self.slip_rate(k))
            .fold(0.0, f64::max)
    }

    /// The position of a vertex among the frictional ones.
    pub fn frictional_position(&self, vertex: usize) -> Option<usize> {
        self.frictional.binary_search(&vertex).ok()
    }
}

/// What every simulation can do, object safe: a `Box<dyn Stepper<2>>` holds any 2D scene.
pub trait Stepper<const C: usize> {
    /// Takes one step of `dt` \[s\].
    ///
    /// # Errors
    /// [`Failure`]; the last accepted step stays in place and another `dt` may be tried.
    fn step(&mut self, dt: f64) -> Result<StepReport, Failure>;

    /// Takes a step of `dt` \[s\] and returns its estimated local error, see [`ErrorControl`].
    /// [`Adaptive`](crate::Adaptive) is built on this.
    ///
    /// # Errors
    /// [`Failure`]; the last accepted step stays in place and another `dt` may be tried.
    fn step_estimated(&mut self, dt: f64, control: &ErrorControl) -> Result<f64, Failure>;

    /// The order in time of rate and state together.
    fn order(&self) -> usize;

    /// The power of the step with which the estimated error falls.
    fn error_order(&self, control: &ErrorControl) -> usize;

    /// Takes the last [`step_estimated`](Stepper::step_estimated) back.
    fn undo(&mut self);

    /// The last accepted step.
    fn snapshot(&self) -> Snapshot<'_, C>;

    /// The step that leads to the time `until` \[s\]. Override it where the time is known better
    /// than to the rounding of [`Snapshot::time`].
    fn time_left(&self, until: f64) -> f64 {
        until - self.snapshot().time
    }

    /// Takes `steps` steps of `dt` \[s\] and shows each to `observe`.
    ///
    /// # Errors
    /// [`Failure`] of the first step that fails.
    fn run(
        &mut self,
        steps: usize,
        dt: f64,
        observe: &mut dyn FnMut(Snapshot<'_, C>),
    ) -> Result<(), Failure> {
        for _ in 0..steps {
            self.step(dt)?;
            observe(self.snapshot());
        }
        Ok(())
    }
}

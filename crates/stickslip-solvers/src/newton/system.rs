//! The interface of the quadratic part of an energy, sparse or dense, in the iteration.

use nalgebra::SVector;

use super::models::Models;
use crate::SolveError;

/// A direction `d` along which the second-order model is to be minimised.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Aim {
    /// Minus the slope of the model, `d . (-gradient)`.
    pub(crate) decrease: f64,
    /// Its second derivative, `d . H d`.
    pub(crate) curvature: f64,
}

/// The outcome of one step.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Step {
    /// The square of the step in the energy norm.
    pub(crate) taken: f64,
    /// Whether it was not shortened.
    pub(crate) full: bool,
    /// Whether it was neither shortened nor bent, and ended where the potentials are smooth.
    pub(crate) whole: bool,
}

/// `v.Bv/2 - r.v` with a solver for `B + D`, where `D` is the Hessian of the kept components.
///
/// Fields have one vector per vertex of the system.
pub(crate) trait System<const C: usize> {
    /// Begins an iteration without a sweep; false if each needs one.
    fn begin(&mut self, v: &[SVector<f64, C>]) -> bool {
        let _ = v;
        false
    }

    /// Minimises over one vertex after the other.
    fn sweep(&mut self, v: &mut [SVector<f64, C>]);

    /// The largest diagonal entry of the block of a frictional vertex, by its number. Unlike a system, the result can
    /// be used in any thread.
    fn scales(&self) -> impl Fn(usize) -> f64 + Sync;

    /// Prepares to solve with the models' Hessians on their kept components.
    fn linearize(&mut self, models: &mut Models<C>, iteration: usize) -> Result<(), SolveError>;

    /// Solves for a direction at `v`.
    fn aim(&mut self, models: &Models<C>, v: &[SVector<f64, C>]) -> Aim;

    /// The direction of the last aim.
    fn direction(&mut self) -> &mut [SVector<f64, C>];

    /// Slope and second derivative of the model along a direction that was changed since.
    fn slopes(&mut self, models: &Models<C>, v: &[SVector<f64, C>]) -> Aim;

    /// Moves `v` by `length` times the direction.
    fn advance(&mut self, v: &mut [SVector<f64, C>], length: f64);

    /// The estimated error after a step in the stopping norm, if it is small enough; `v` may then be moved by the
    /// estimated change.
    fn settled(
        &mut self,
        models: &mut Models<C>,
        v: &mut [SVector<f64, C>],
        step: &Step,
    ) -> Result<Option<f64>, SolveError>;

    /// Another direction from the same linearisation, if that is worth it.
    fn again(&mut self, step: &Step) -> Option<Aim>;

    /// The change of `v` since the sweep in the stopping norm.
    fn moved(&mut self, v: &[SVector<f64, C>]) -> f64;

    /// The tolerance of a change; it may grow as the rounding errors become known.
    fn tolerance(&self) -> f64;

    /// The largest ratio of squares in the stopping norm to those in the energy norm; may be infinite.
    fn equivalence(&self) -> f64;

    /// Whether the rest of an iteration is at the level of rounding; called if an iteration makes no progress.
    fn is_exhausted(&mut self, models: &Models<C>, v: &[SVector<f64, C>]) -> bool {
        let _ = (models, v);
        false
    }
}

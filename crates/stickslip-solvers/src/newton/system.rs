//! What the iteration asks of the quadratic part of an energy, sparse or dense.

use nalgebra::SVector;

use super::models::Models;
use crate::SolveError;

/// A direction `d` in which the model of second order is to be minimised.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Aim {
    /// Minus the slope of the model, `d . (-gradient)`.
    pub(crate) decrease: f64,
    /// Its second derivative, `d . H d`.
    pub(crate) curvature: f64,
}

/// How one step went.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Step {
    /// The square of the step in the energy norm.
    pub(crate) taken: f64,
    /// It was not shortened.
    pub(crate) full: bool,
    /// It was neither shortened nor bent, and led to where the potentials are smooth.
    pub(crate) whole: bool,
}

/// `v.Bv/2 - r.v` with a way to solve with `B + D`, where `D` is the Hessian of the kept components.
///
/// Fields have one vector a vertex of the system.
pub(crate) trait System<const C: usize> {
    /// Begins an iteration without a sweep; false if each is to have one.
    fn begin(&mut self, v: &[SVector<f64, C>]) -> bool {
        let _ = v;
        false
    }

    /// Minimises over one vertex after the other.
    fn sweep(&mut self, v: &mut [SVector<f64, C>]);

    /// The largest diagonal entry of the block of a frictional vertex, by its number: to be asked in any thread, as a system
    /// is not.
    fn scales(&self) -> impl Fn(usize) -> f64 + Sync;

    /// Makes ready to solve with the models' Hessians on their kept components.
    fn linearize(&mut self, models: &mut Models<C>, iteration: usize) -> Result<(), SolveError>;

    /// Solves for a direction from `v`.
    fn aim(&mut self, models: &Models<C>, v: &[SVector<f64, C>]) -> Aim;

    /// The direction of the last aim.
    fn direction(&mut self) -> &mut [SVector<f64, C>];

    /// Slope and second derivative of the model along a direction that was changed since.
    fn slopes(&mut self, models: &Models<C>, v: &[SVector<f64, C>]) -> Aim;

    /// Moves `v` by `length` times the direction.
    fn advance(&mut self, v: &mut [SVector<f64, C>], length: f64);

    /// The estimated error after a step if it is small enough, in the stopping norm; `v` may then be moved by what the
    /// estimate says.
    fn settled(
        &mut self,
        models: &mut Models<C>,
        v: &mut [SVector<f64, C>],
        step: &Step,
    ) -> Result<Option<f64>, SolveError>;

    /// Another direction by the same linearisation, where that is worth its while.
    fn again(&mut self, step: &Step) -> Option<Aim>;

    /// By how much `v` changed since the sweep, in the stopping norm.
    fn moved(&mut self, v: &[SVector<f64, C>]) -> f64;

    /// The change that is small enough; it may grow as more is known of the rounding errors.
    fn tolerance(&self) -> f64;

    /// By how much squares in the stopping norm exceed those in the energy norm at most; may be infinite.
    fn equivalence(&self) -> f64;

    /// Whether only rounding is left of what an iteration would still do; asked where one makes no headway.
    fn is_exhausted(&mut self, models: &Models<C>, v: &[SVector<f64, C>]) -> bool {
        let _ = (models, v);
        false
    }
}

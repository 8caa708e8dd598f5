//! The coupling of rate and state in one time step.

mod fixed_point;
mod monolithic;
mod staggered;
#[cfg(test)]
#[path = "../../../tests/unit/fixed_point.rs"]
mod tests;
mod velocity_problem;

pub use fixed_point::FixedPoint;
pub use monolithic::Monolithic;
pub use staggered::Staggered;

use crate::StepError;

/// Step maps are the library's own.
pub(crate) mod sealed {
    /// Implemented in this crate alone.
    pub trait Sealed {}
}

/// The two maps whose common fixed point is one time step, their composition, and quantities to accelerate them.
///
/// The library alone implements it; all couplings, also those of the library, use nothing else.
pub trait StepMaps: sealed::Sealed {
    /// State from rate: computes `S(|v|)` and returns how far it lies from the state in use,
    /// in `L2` of the contacts.
    ///
    /// # Errors
    /// [`StepError::State`] where the law has no answer.
    fn propose_states(&mut self) -> Result<f64, StepError>;

    /// Moves the state in use by the share `relaxation` towards the last proposal.
    fn relax_states(&mut self, relaxation: f64);

    /// With `d` and `d'` the last two differences between the state proposed and the state in use,
    /// latest first, `-d'.(d - d')/|d - d'|^2` in `L2` of the contacts: what Aitken's rule
    /// multiplies the last relaxation with. No number before the second one of a step.
    fn secant_factor(&self) -> f64;

    /// Rate from state: solves the velocity problem to `tolerance`, from the velocity moved on by the share `lead` of
    /// its last change in this step, and returns how far the velocity moved in all. Both in the norm
    /// `sqrt((C eps, eps) + (rho v, v))`. A solver that condenses the load once per step measures the change of the contacts, extended to
    /// the body: for the first problem of a step without the part that the load moves.
    ///
    /// # Errors
    /// [`StepError::Solver`] where the solver gives up.
    fn solve_rates(&mut self, lead: f64, tolerance: f64) -> Result<f64, StepError>;

    /// Solves the velocity problem without measuring how far the velocity moved.
    ///
    /// # Errors
    /// [`StepError::Solver`] where the solver gives up.
    fn solve_once(&mut self, tolerance: f64) -> Result<(), StepError>;

    /// The change of the velocity, in its norm, that rounding may leave of an iteration.
    ///
    /// # Errors
    /// [`StepError::Solver`] where the velocity is not finite.
    fn rate_rounding(&mut self) -> Result<f64, StepError>;

    /// Extrapolates the rates of the last two steps to the new time, to second order: linearly where they grow, by
    /// their ratio where they fall, so that no slip rate changes its sign. In the first step the rate stays.
    fn extrapolate_rates(&mut self);

    /// Rate and state at once: solves the velocity problem to `tolerance` with the state of each
    /// vertex eliminated, a function of its slip rate. The state in use stays as it was.
    ///
    /// # Errors
    /// [`StepError::Solver`] where the solver fails, as with an eliminated problem that is not convex; the velocity is
    /// then that of the last accepted step.
    fn solve_coupled(&mut self, tolerance: f64) -> Result<(), StepError>;

    /// Numbers that are kept from one accepted step to the next, and with a state that is saved: the memory of a
    /// coupling. All zero at the start.
    fn memory(&mut self) -> &mut [f64; 4];
}

/// The cost of the coupling in one step.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct CouplingReport {
    /// Velocity problems solved.
    pub iterations: usize,
    /// The method failed, and the one it falls back on took the step.
    pub fell_back: bool,
}

/// A method to solve for rate and state together.
///
/// Implement [`couple`](Coupling::couple): call the maps until they agree, and leave the state of the final velocity in
/// use. Numbers to be kept from step to step go to [`StepMaps::memory`]. The solution is certified behind any coupling:
/// [`StepError::NotUnique`].
///
/// ```
/// use stickslip::integrate::{CouplingReport, StepMaps};
/// use stickslip::{Coupling, StepError};
///
/// /// One pass: the state of the last step's rate, then the rate.
/// struct OnePass;
///
/// impl Coupling for OnePass {
///     fn couple(&self, maps: &mut dyn StepMaps, tolerance: f64) -> Result<CouplingReport, StepError> {
///         maps.propose_states()?;
///         maps.relax_states(1.0);
///         maps.solve_once(tolerance)?;
///         maps.propose_states()?;
///         maps.relax_states(1.0);
///         Ok(CouplingReport { iterations: 1, ..CouplingReport::default() })
///     }
/// }
/// ```
pub trait Coupling: Send + Sync {
    /// Brings rate and state of one step to agree within `tolerance`, in the norm of
    /// [`StepMaps::solve_rates`].
    ///
    /// # Errors
    /// [`StepError::NotCoupled`] where they do not, and whatever the maps report.
    fn couple(&self, maps: &mut dyn StepMaps, tolerance: f64) -> Result<CouplingReport, StepError>;

    /// Whether rate and state agree at the end of a step, so that it may have several solutions and needs a certificate;
    /// a coupling that leaves the state behind has a single one.
    fn is_simultaneous(&self) -> bool {
        true
    }
}

impl<T: Coupling + ?Sized> Coupling for Box<T> {
    fn couple(&self, maps: &mut dyn StepMaps, tolerance: f64) -> Result<CouplingReport, StepError> {
        (**self).couple(maps, tolerance)
    }

    fn is_simultaneous(&self) -> bool {
        (**self).is_simultaneous()
    }
}

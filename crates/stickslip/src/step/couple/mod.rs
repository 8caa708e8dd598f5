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

/// Seals the step maps.
pub(crate) mod sealed {
    /// Implemented in this crate only.
    pub trait Sealed {}
}

/// The two maps whose common fixed point is one time step, their composition, and quantities for acceleration.
///
/// Only the library implements it; all couplings, including the library's own, use nothing else.
pub trait StepMaps: sealed::Sealed {
    /// State from rate: computes `S(|v|)` and returns its distance from the state in use, in `L2` of the contacts.
    ///
    /// # Errors
    /// [`StepError::State`] where the law has no solution.
    fn propose_states(&mut self) -> Result<f64, StepError>;

    /// Moves the state in use by the share `relaxation` towards the last proposal.
    fn relax_states(&mut self, relaxation: f64);

    /// The secant factor `-d'.(d - d')/|d - d'|^2` in `L2` of the contacts, with `d` and `d'` the last two differences
    /// between the proposed state and the state in use, latest first. Aitken's rule multiplies the last relaxation
    /// factor by it. NaN before the second difference of a step.
    fn secant_factor(&self) -> f64;

    /// Rate from state: solves the velocity problem to `tolerance` and returns the total change of the velocity. The
    /// initial guess is the velocity advanced by the share `lead` of its last change in this step. Both use the norm
    /// `sqrt((C eps, eps) + (rho v, v))`. A solver that condenses the load once per step measures the change of the
    /// contacts, extended to the body: for the first problem of a step without the part that the load moves.
    ///
    /// # Errors
    /// [`StepError::Solver`] where the solver fails.
    fn solve_rates(&mut self, lead: f64, tolerance: f64) -> Result<f64, StepError>;

    /// Solves the velocity problem without measuring the change of the velocity.
    ///
    /// # Errors
    /// [`StepError::Solver`] where the solver fails.
    fn solve_once(&mut self, tolerance: f64) -> Result<(), StepError>;

    /// The rounding error of the velocity's change in an iteration, in its norm.
    ///
    /// # Errors
    /// [`StepError::Solver`] where the velocity is not finite.
    fn rate_rounding(&mut self) -> Result<f64, StepError>;

    /// Extrapolates the rates of the last two steps linearly to the new time. A component that would turn is zero
    /// instead: friction stops it first. In the first step the rate stays.
    fn extrapolate_rates(&mut self);

    /// Rate and state at once: solves the velocity problem to `tolerance` with the state of each vertex condensed, as a
    /// function of its slip rate. The state in use is unchanged.
    ///
    /// # Errors
    /// [`StepError::Solver`] where the solver fails, as with a condensed problem that is not convex; the velocity is
    /// then that of the last accepted step.
    fn solve_coupled(&mut self, tolerance: f64) -> Result<(), StepError>;

    /// The memory of a coupling: numbers that persist from one accepted step to the next, and in a saved state. All
    /// zero at the start.
    fn memory(&mut self) -> &mut [f64; 4];
}

/// The cost of the coupling in one step.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct CouplingReport {
    /// Velocity problems solved.
    pub iterations: usize,
    /// The coupling failed, and its fallback took the step.
    pub fell_back: bool,
}

/// A coupling: a method for solving rate and state together.
///
/// Implement [`couple`](Coupling::couple): call the maps until they agree, and leave the state of the final velocity in
/// use. Store numbers for later steps in [`StepMaps::memory`]. The solution is certified after any coupling:
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
    /// Iterates rate and state of one step to agreement within `tolerance`, in the norm of [`StepMaps::solve_rates`].
    ///
    /// # Errors
    /// [`StepError::NotCoupled`] without convergence, and the errors of the maps.
    fn couple(&self, maps: &mut dyn StepMaps, tolerance: f64) -> Result<CouplingReport, StepError>;

    /// Whether rate and state agree at the end of a step. Such a step can have several solutions and requires a
    /// certificate; a coupling with a lagged state has a unique solution.
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

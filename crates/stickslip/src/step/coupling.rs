//! How rate and state meet in one time step.

use crate::StepError;

/// What a coupling works with: the two maps whose common fixed point is one time step, their composition,
/// and what there is to accelerate them.
///
/// The library implements it; all couplings, also those of the library, use nothing else.
pub trait StepMaps {
    /// State from rate: computes `S(|v|)` and returns how far it lies from the state in use,
    /// in `L2` of the contacts.
    ///
    /// # Errors
    /// [`StepError::State`] where the law has no answer.
    fn propose_states(&mut self) -> Result<f64, StepError>;

    /// Moves the state in use by the share `relaxation` towards what was proposed last.
    fn relax_states(&mut self, relaxation: f64);

    /// With `d` and `d'` the last two differences between the state proposed and the state in use,
    /// latest first, `-d'.(d - d')/|d - d'|^2` in `L2` of the contacts: what Aitken's rule
    /// multiplies the last relaxation with. No number before the second one of a step.
    fn secant_factor(&self) -> f64;

    /// Rate from state: solves the velocity problem to `tolerance`, from the velocity moved on by the share
    /// `lead` of its last change in this step, and returns how far the velocity moved in all. Both in the norm
    /// `sqrt((C eps, eps) + (rho v, v))`. A solver that takes the load once a step measures how far the contacts
    /// moved, and the body with them: from the first problem of a step it leaves out what the load moved besides.
    ///
    /// # Errors
    /// [`StepError::Solver`] where the solver gives up.
    fn solve_rates(&mut self, lead: f64, tolerance: f64) -> Result<f64, StepError>;

    /// Solves the velocity problem without measuring how far the velocity moved.
    ///
    /// # Errors
    /// [`StepError::Solver`] where the solver gives up.
    fn solve_once(&mut self, tolerance: f64) -> Result<(), StepError>;

    /// Whether friction, with the state in use, is what the velocity leaves for it to balance, as far as a
    /// velocity that is known to `tolerance` can tell. Maps that do not know say so.
    ///
    /// # Errors
    /// [`StepError::Solver`] where the velocity is not finite.
    fn is_balanced(&mut self, tolerance: f64) -> Result<bool, StepError> {
        let _ = tolerance;
        Ok(true)
    }

    /// The change of the velocity, in its norm, that rounding may leave of an iteration.
    ///
    /// # Errors
    /// [`StepError::Solver`] where the velocity is not finite.
    fn rate_rounding(&mut self) -> Result<f64, StepError>;

    /// Continues the rates of the last two steps to the new time, to second order: straight on where they grow, by
    /// their share where they fall, so that no slip ends. Where there are none yet, the last one stays.
    fn extrapolate_rates(&mut self);

    /// Rate and state at once: solves the velocity problem to `tolerance` with the state of each
    /// vertex eliminated, a function of its slip rate. The state in use stays as it was.
    ///
    /// # Errors
    /// [`StepError::Solver`] where the solver gives up, as it does where friction weakens faster
    /// than the body stiffens; the velocity is then that of the last accepted step.
    fn solve_coupled(&mut self, tolerance: f64) -> Result<(), StepError>;

    /// At how many vertices friction, its state following, weakens with the slip rate: there only the body makes the
    /// problem convex, and a larger step may have several solutions. The state in use has to be the one that belongs to
    /// the velocity in use. Maps that do not know say none.
    fn weakening(&self) -> usize {
        0
    }

    /// Numbers that are kept from one accepted step to the next, and with a state that is saved: the one
    /// place for what a coupling remembers. All zero at the start.
    fn memory(&mut self) -> &mut [f64; 4];
}

/// What coupling cost in one step.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct CouplingReport {
    /// Velocity problems solved.
    pub iterations: usize,
    /// The method gave up, and the one it falls back on took the step.
    pub fell_back: bool,
    /// The vertices at which friction, its state following, weakens with the slip rate, if the method
    /// looks; see [`StepMaps::weakening`].
    pub weakening: usize,
}

impl CouplingReport {
    /// One velocity problem.
    pub(crate) fn one_problem(weakening: usize) -> Self {
        Self {
            iterations: 1,
            fell_back: false,
            weakening,
        }
    }
}

/// A method to solve for rate and state together.
///
/// Implement [`couple`](Coupling::couple): call the maps until they agree, and leave the state of
/// the final velocity in use. What is remembered from step to step goes to [`StepMaps::memory`].
///
/// ```
/// use stickslip::{Coupling, CouplingReport, StepError, StepMaps};
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

    /// Whether the solution that continues the last step is followed as the step grows, where the coupling found one
    /// that may be another, or found none and failed: by default where it found one. A coupling that leaves the state
    /// behind has a single solution and nothing to follow.
    fn is_followed(&self, failure: Option<&StepError>) -> bool {
        failure.is_none()
    }
}

impl<T: Coupling + ?Sized> Coupling for Box<T> {
    fn couple(&self, maps: &mut dyn StepMaps, tolerance: f64) -> Result<CouplingReport, StepError> {
        (**self).couple(maps, tolerance)
    }

    fn is_followed(&self, failure: Option<&StepError>) -> bool {
        (**self).is_followed(failure)
    }
}

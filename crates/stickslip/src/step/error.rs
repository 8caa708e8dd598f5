//! What can go wrong when a step is taken.

use stickslip_state::StateError;
use stickslip_tnnmg::SolveError;
use thiserror::Error;

use crate::run::{Limit, LocalError};

/// Why a step failed.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum StepError {
    /// Another process has failed, and says why.
    #[error("another process has failed")]
    Elsewhere,
    /// The step size is not a positive number.
    #[error("a step must be positive and finite, is {dt:e} s")]
    StepSize {
        /// The step size \[s\].
        dt: f64,
    },
    /// The step is beyond what an explicit scheme bears.
    #[error("a step of {dt:.6e} s is unstable: the limit is {limit:.6e} s")]
    Unstable {
        /// The step size \[s\].
        dt: f64,
        /// The largest stable one \[s\].
        limit: f64,
    },
    /// The velocity problem was not solved.
    #[error("velocity problem: {0}")]
    Solver(#[from] SolveError),
    /// The state of a vertex could not be advanced.
    #[error("state at vertex {vertex}, slip rate {slip_rate:e} m/s: {source}")]
    State {
        /// The vertex.
        vertex: usize,
        /// Its slip rate [m/s].
        slip_rate: f64,
        /// What the law says.
        source: StateError,
    },
    /// Prescribed velocities or loads are not finite at the new time.
    #[error("{what} at vertex {vertex} is {value:e}")]
    Data {
        /// What was evaluated.
        what: &'static str,
        /// The vertex.
        vertex: usize,
        /// The value found.
        value: f64,
    },
    /// A contact is pulled apart.
    #[error(
        "normal stress at vertex {vertex} is {normal_stress:e} Pa, a tension: Contact::opening lets it open"
    )]
    Tension {
        /// The vertex.
        vertex: usize,
        /// The normal stress \[Pa\], negative.
        normal_stress: f64,
    },
    /// A state is to follow the logarithm of a normal stress that vanishes.
    #[error(
        "the state at vertex {vertex} follows the logarithm of the normal stress, which goes from {from:e} Pa to {to:e} Pa"
    )]
    NormalStressEffect {
        /// The vertex.
        vertex: usize,
        /// The normal stress before \[Pa\].
        from: f64,
        /// The normal stress after \[Pa\].
        to: f64,
    },
    /// A slip rate or rate of the state inside an explicit step is not finite.
    #[error(
        "at t = {} s, vertex {vertex}, state {state:e}: slip rate {slip_rate:e} m/s, rate of the state {evolution:e}",
        twelve_digits(*.time)
    )]
    Stage {
        /// The vertex.
        vertex: usize,
        /// The time inside the step \[s\].
        time: f64,
        /// The slip rate found [m/s].
        slip_rate: f64,
        /// The state there.
        state: f64,
        /// The rate of the state found.
        evolution: f64,
    },
    /// The error of a step is too large at every step size allowed.
    #[error(
        "a step of {dt:.3e} s would be needed, tolerance {tolerance:.3e}; limited by {error}{}",
        if *resisted { String::new() } else { format!("; {NONE}") }
    )]
    StepTooSmall {
        /// The step size that was asked for next \[s\].
        dt: f64,
        /// The local error of the last one tried.
        error: LocalError,
        /// The local error allowed.
        tolerance: f64,
        /// Whether the scene has inertia or damping, with which small steps follow slip that runs away.
        resisted: bool,
    },
    /// The step-size control ran out of steps.
    #[error("{steps} steps taken, the next one of {dt:.3e} s; limited by {limit}")]
    TooManySteps {
        /// The number of steps allowed.
        steps: usize,
        /// The size of the next one \[s\].
        dt: f64,
        /// What limits it.
        limit: Limit,
    },
    /// Step after step of an adaptive run fails, and only smaller ones get on, see
    /// [`Steps::with_max_steps`](crate::Steps::with_max_steps).
    #[error("{failed} of {steps} steps failed, the last one by this: {cause}")]
    TooManyFailures {
        /// The number of steps that failed.
        failed: usize,
        /// The number of all steps.
        steps: usize,
        /// Why the last one failed.
        cause: Box<Self>,
    },
    /// A run does not get to its end with the steps it may take, see
    /// [`Steps::with_max_steps`](crate::Steps::with_max_steps).
    #[error(
        "{steps} steps taken, {dt:.3e} s each for a long time: {needed:.1e} more to the end at t = {} s, \
         {max_steps} allowed; limited by {limit}",
        twelve_digits(*.end)
    )]
    TooSlow {
        /// The number of steps taken, those taken back and those failed among them.
        steps: usize,
        /// By how much one led on, on average of the last ones \[s\].
        dt: f64,
        /// The end of the run \[s\].
        end: f64,
        /// The number of steps that the rest would need like this.
        needed: f64,
        /// The number of steps allowed.
        max_steps: usize,
        /// What limits them.
        limit: Limit,
    },
    /// A setting of the step-size control is out of its range.
    #[error("step-size control: {what} is {value:e}")]
    Control {
        /// The setting.
        what: &'static str,
        /// Its value.
        value: f64,
    },
    /// Steps may not be extrapolated: waves that a step does not resolve would grow.
    #[error(
        "extrapolation would multiply waves that a step does not resolve by {growth:.3} a step: use Sdirk2, or \
         ErrorControl without it"
    )]
    Extrapolation {
        /// The largest factor.
        growth: f64,
    },
    /// No solution continues the last step to the size of this one.
    #[error(
        "friction at vertex {vertex} weakens faster than the body stiffens: the solution that continues the last step \
         ends at {reached:.3e} s of {dt:.3e} s, at a slip rate of {slip_rate:.3e} m/s; {}",
        if *resisted { SMALLER } else { NONE }
    )]
    Fold {
        /// A vertex that would jump to another one.
        vertex: usize,
        /// Its slip rate where the solution ends [m/s].
        slip_rate: f64,
        /// The step size up to which the solution was followed \[s\]; 0 if it was not.
        reached: f64,
        /// The step size \[s\].
        dt: f64,
        /// Whether the scene has inertia or damping, with which a smaller step follows the jump.
        resisted: bool,
    },
    /// Velocity and state did not come to terms.
    #[error(
        "velocity and state not coupled after {iterations} iterations: change {change:.3e}, tolerance {tolerance:.3e}; a smaller step or Monolithic coupling may do"
    )]
    NotCoupled {
        /// Velocity problems solved.
        iterations: usize,
        /// The last change of the velocity in the norm of the coupling.
        change: f64,
        /// The change asked for.
        tolerance: f64,
    },
}

const SMALLER: &str = "a smaller step follows it";
const NONE: &str = "with no inertia and no damping there is no solution below the critical stiffness: give the scene one of \
                    them";

/// A step that failed; the simulation still stands at the last accepted one.
#[derive(Debug, Clone, PartialEq, Error)]
#[error("step {step} at t = {} s: {cause}", twelve_digits(*.time))]
pub struct Failure {
    /// The number of the step that failed, from 1.
    pub step: usize,
    /// The time it would have reached \[s\].
    pub time: f64,
    /// Why it failed.
    #[source]
    pub cause: StepError,
}

/// The number of steps times their size carries a rounding error that nobody wants to read, nor hundreds of zeros.
fn twelve_digits(time: f64) -> String {
    let rounded = format!("{time:.11e}").parse().unwrap_or(time);
    if rounded == 0.0 || (1e-4..1e12).contains(&rounded.abs()) {
        rounded.to_string()
    } else {
        format!("{rounded:e}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_are_short() {
        let times = [0.0, 4240.0 * 1.5e-3, -0.25, 1e9, 1e12, 3e-310];
        let read = times.map(twelve_digits);
        assert_eq!(read, ["0", "6.36", "-0.25", "1000000000", "1e12", "3e-310"]);
    }

    #[test]
    fn a_failure_reads_as_one_line_with_its_numbers() {
        let cause = StepError::NotCoupled {
            iterations: 200,
            change: 4.7e-10,
            tolerance: 1e-10,
        };
        let failure = Failure {
            step: 4240,
            time: 4240.0 * 1.5e-3,
            cause,
        };
        assert_eq!(
            failure.to_string(),
            "step 4240 at t = 6.36 s: velocity and state not coupled after 200 iterations: \
             change 4.700e-10, tolerance 1.000e-10; a smaller step or Monolithic coupling may do"
        );
    }
}

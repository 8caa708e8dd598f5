//! Errors of a step.

use stickslip_solvers::SolveError;
use stickslip_state::{Number, StateError};
use thiserror::Error;

use super::{Limit, LocalError, hint};
use crate::fields::FieldError;
/// The cause of a failed step.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum StepError {
    /// Another process has failed; its error contains the cause.
    #[error("another process has failed")]
    Elsewhere,
    /// The step size is not a positive number.
    #[error("a step must be positive and finite, is {} s", Number(*.dt))]
    StepSize {
        /// The step size \[s\].
        dt: f64,
    },
    /// The step exceeds the stability limit of an explicit scheme.
    #[error("a step of {dt:.6e} s is unstable: the limit is {limit:.6e} s")]
    Unstable {
        /// The step size \[s\].
        dt: f64,
        /// The largest stable step \[s\].
        limit: f64,
    },
    /// A step has another size than those before in a cycle of local steps.
    #[error(
        "a step of {dt:.6e} s after {taken} of a cycle of {cycle} steps of {before:.6e} s: local steps are equal in a cycle; \
         end at a multiple of {cycle} steps"
    )]
    AmidCycle {
        /// The step size \[s\].
        dt: f64,
        /// The size of the steps before \[s\].
        before: f64,
        /// The number of steps taken of the cycle.
        taken: usize,
        /// The number of steps of a cycle.
        cycle: usize,
    },
    /// The velocity problem could not be solved.
    #[error("velocity problem: {0}")]
    Solver(#[from] SolveError),
    /// A field on a contact could not be advanced.
    #[error("field {field} of a contact: {source}")]
    Field {
        /// The number of the field among those of its contact.
        field: usize,
        /// The error of the field.
        source: FieldError,
    },
    /// The state of a vertex could not be advanced.
    #[error("state at vertex {vertex}, slip rate {} m/s: {source}", Number(*.slip_rate))]
    State {
        /// The vertex.
        vertex: usize,
        /// Its slip rate [m/s].
        slip_rate: f64,
        /// The error of the law.
        source: StateError,
    },
    /// Data are not finite at the new time: a prescribed velocity, a load, a normal stress, or what follows from them.
    #[error(
        "{what} at vertex {vertex} must be finite, is {}{}", Number(*.value),
        self.hint().map_or_else(String::new, |hint| format!("; {hint}"))
    )]
    Data {
        /// The evaluated quantity.
        what: &'static str,
        /// The vertex.
        vertex: usize,
        /// The value of the quantity.
        value: f64,
    },
    /// A law of a contact has no finite value, at finite arguments.
    #[error(
        "{what} at vertex {vertex} must be finite, is {} at a slip rate of {} m/s and the state {}",
        Number(*.value), Number(*.slip_rate), Number(*.state)
    )]
    Law {
        /// The value: "friction coefficient", "new state", "rate of the state".
        what: &'static str,
        /// The vertex.
        vertex: usize,
        /// Its slip rate [m/s].
        slip_rate: f64,
        /// Its state, in the state law's own variable; 0 without one.
        state: f64,
        /// The value of the law.
        value: f64,
    },
    /// A contact is under tension.
    #[error(
        "normal stress at vertex {vertex} is {} Pa, a tension: {}",
        Number(*.normal_stress), hint::OPENING
    )]
    Tension {
        /// The vertex.
        vertex: usize,
        /// The normal stress \[Pa\], negative.
        normal_stress: f64,
    },
    /// The pore pressure of fields on a contact exceeds its normal stress.
    #[error(
        "pore pressure at vertex {vertex} is {} Pa, beyond the normal stress of {} Pa: {}",
        Number(*.pore_pressure), Number(*.normal_stress), hint::PRESSURE
    )]
    PorePressure {
        /// The vertex.
        vertex: usize,
        /// The pore pressure \[Pa\].
        pore_pressure: f64,
        /// The normal stress \[Pa\], less than that.
        normal_stress: f64,
        /// Whether slip feeds a field: a shorter step can succeed then.
        by_slip: bool,
    },
    /// The slip rates of a solver take the sides of a contact into each other.
    #[error(
        "the solver lets the sides of a contact penetrate by {} m at vertex {vertex}: {}",
        Number(-*.opening), hint::MINIMISES
    )]
    Penetration {
        /// The vertex.
        vertex: usize,
        /// The opening \[m\], negative.
        opening: f64,
    },
    /// The normal stress that comes from the deformation does not converge with the slip rates: slip changes the pressure
    /// that resists it faster than the body stiffens. Likewise the forces of a stiffness matrix that is not symmetric.
    #[error(
        "normal stress and slip rates do not contract in {iterations} iterations of a step of {dt:.3e} s: a change of the \
         normal stress grows by {contraction:.3}, largest at vertex {vertex}; {}",
        hint::LESS_FRICTION
    )]
    NotContracting {
        /// The vertex with the largest missing friction.
        vertex: usize,
        /// The factor of a change of the normal stress from one iteration to the next.
        contraction: f64,
        /// The iterations.
        iterations: usize,
        /// The step size \[s\].
        dt: f64,
    },
    /// The normal stress of a state with the Linker-Dieterich effect vanishes.
    #[error(
        "the state at vertex {vertex} follows the logarithm of the normal stress, which goes from {} Pa to {} Pa",
        Number(*.from), Number(*.to)
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
        "slip rate {} m/s, state {} and its rate {} at vertex {vertex} are not all finite: {}",
        Number(*.slip_rate), Number(*.state), Number(*.evolution), hint::ADAPTIVE
    )]
    Stage {
        /// The vertex.
        vertex: usize,
        /// The time inside the step \[s\].
        time: f64,
        /// The slip rate [m/s].
        slip_rate: f64,
        /// The state there.
        state: f64,
        /// The rate of the state.
        evolution: f64,
    },
    /// The error of a step exceeds the tolerance at every allowed step size.
    #[error(
        "a step of {dt:.3e} s would be needed, tolerance {tolerance:.3e}; limited by {}{}",
        Limit::Error(*error),
        if *resisted { String::new() } else { format!("; {}", hint::INERTIA) }
    )]
    StepTooSmall {
        /// The step size that would be needed \[s\].
        dt: f64,
        /// The local error of the last attempt.
        error: LocalError,
        /// The allowed local error.
        tolerance: f64,
        /// Whether the scene has inertia or damping, with which small steps resolve a slip instability.
        resisted: bool,
    },
    /// The step-size control has reached its maximum number of steps.
    #[error("{steps} steps taken, the next one of {dt:.3e} s; limited by {limit}")]
    TooManySteps {
        /// The maximum number of steps.
        steps: usize,
        /// The size of the next step \[s\].
        dt: f64,
        /// The limit of the step size.
        limit: Limit,
    },
    /// A setting of the step-size control is out of its range.
    #[error("step-size control: {what} must be {requirement}, is {}", Number(*.value))]
    Control {
        /// The name of the setting.
        what: &'static str,
        /// The condition on the setting.
        requirement: &'static str,
        /// Its value.
        value: f64,
    },
    /// An option without meaning for steps of this kind.
    #[error("`Steps::{option}` means nothing for {} steps", if *option == "without_substeps" || *option == "with_substeps" { "adaptive" } else { "constant" })]
    Option {
        /// The function that set it.
        option: &'static str,
    },
    /// Steps that cannot be extrapolated: those of second order and higher, where extrapolation multiplies unresolved
    /// waves by up to 5/3 per step without damping.
    #[error(
        "extrapolation of a scheme of order {order} would let waves grow that a step does not resolve: {}",
        hint::PLAIN
    )]
    Extrapolation {
        /// The order of the scheme.
        order: usize,
    },
    /// The step has no certificate of a unique solution: friction, with its states condensed, weakens between the old
    /// and the new slip rates faster than the body stiffens.
    #[error(
        "no unique solution of a step of {dt:.3e} s: friction at vertex {vertex}, slip rate {slip_rate:.3e} m/s, weakens \
         faster than the body stiffens; {}",
        if *shorter { hint::SHORTER } else { hint::INERTIA }
    )]
    NotUnique {
        /// The vertex with the largest ratio of weakening to the body's resistance.
        vertex: usize,
        /// Its slip rate before the step [m/s].
        slip_rate: f64,
        /// The step size \[s\].
        dt: f64,
        /// Whether a sufficiently short step has a unique solution: with inertia, damping or a direct effect.
        shorter: bool,
    },
    /// The fixed-point coupling of velocity and state did not converge.
    #[error(
        "the fixed-point coupling did not converge in {iterations} iterations (change {change:.3e}, tolerance \
         {tolerance:.3e}): {}",
        hint::MONOLITHIC
    )]
    NotCoupled {
        /// Velocity problems solved.
        iterations: usize,
        /// The last change of the velocity in the norm of the coupling.
        change: f64,
        /// The tolerance for the change.
        tolerance: f64,
    },
}

impl StepError {
    /// The vertex where the step failed; none for a failure of the whole step.
    pub fn vertex(&self) -> Option<usize> {
        match self {
            Self::State { vertex, .. }
            | Self::Data { vertex, .. }
            | Self::Law { vertex, .. }
            | Self::Tension { vertex, .. }
            | Self::PorePressure { vertex, .. }
            | Self::Penetration { vertex, .. }
            | Self::NotContracting { vertex, .. }
            | Self::NormalStressEffect { vertex, .. }
            | Self::Stage { vertex, .. }
            | Self::NotUnique { vertex, .. } => Some(*vertex),
            Self::StepTooSmall { error, .. }
            | Self::TooManySteps {
                limit: Limit::Error(error),
                ..
            } => error.vertex(),
            _ => None,
        }
    }
}

/// The data that follow from the rates of a step.
pub(crate) const BODY_STRESS: &str = "normal stress from the body";

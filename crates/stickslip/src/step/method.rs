//! How a simulation goes through time.

use stickslip_time::{QuasiStatic, RateScheme};

use super::{Coupling, Monolithic};
use crate::StateUpdate;

/// Scheme, coupling, state update and tolerance.
pub(crate) struct Method {
    pub(crate) scheme: Box<dyn RateScheme>,
    pub(crate) coupling: Box<dyn Coupling>,
    pub(crate) state_update: StateUpdate,
    pub(crate) tolerance: Tolerance,
}

/// How far the velocity of a step may be off.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Tolerance {
    /// In the norm of `A + M`.
    Absolute(f64),
    /// In the norm of the step's operator `B`, as a share of what normal stress could move there.
    Relative(f64),
}

impl Method {
    /// The defaults, for a scene with inertia or without.
    pub(crate) fn new(scheme: Box<dyn RateScheme>, inertia: bool) -> Self {
        Self {
            scheme: with_or_without(scheme, inertia),
            coupling: Box::new(Monolithic::default()),
            state_update: StateUpdate::default(),
            tolerance: Tolerance::Relative(1e-13),
        }
    }

    /// A stage of a Runge-Kutta method is backward Euler, for the state too.
    pub(crate) fn update_of_a_stage(&self) -> StateUpdate {
        if self.scheme.facts().stages.len() > 1 {
            StateUpdate::BackwardEuler
        } else {
            self.state_update
        }
    }

    /// The order in time of rate and state together.
    pub(crate) fn order(&self, has_state: bool) -> usize {
        let staged = self.scheme.facts().stages.len() > 1;
        if has_state && !staged && self.state_update == StateUpdate::BackwardEuler {
            1
        } else {
            self.scheme.facts().order
        }
    }

    /// Whether the error has even powers of the step only.
    pub(crate) fn is_symmetric(&self, has_state: bool) -> bool {
        self.scheme.facts().symmetric && self.order(has_state) > 1
    }
}

/// A scheme as it is for a scene with inertia, or what is left of it without.
pub(crate) fn with_or_without(scheme: Box<dyn RateScheme>, inertia: bool) -> Box<dyn RateScheme> {
    if inertia {
        scheme
    } else {
        Box::new(QuasiStatic(scheme))
    }
}

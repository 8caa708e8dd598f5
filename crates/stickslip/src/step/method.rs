//! How a simulation goes through time.

use std::sync::Arc;

use stickslip_time::{BackwardEuler, FirstOrderAlpha, QuasiStatic, RateScheme, Weights};

use super::{Coupling, Monolithic};
use crate::StateUpdate;
use crate::numerics::NUMERICS;

/// Scheme, coupling, state update and tolerance.
#[derive(Clone)]
pub(crate) struct Method {
    /// The scheme that was given, and what it is in this scene.
    given: Arc<dyn RateScheme>,
    pub(crate) scheme: Arc<dyn RateScheme>,
    scene: Traits,
    pub(crate) coupling: Arc<dyn Coupling>,
    state_update: StateUpdate,
    pub(crate) tolerance: Tolerance,
    /// Steps whose rates are not [resolved](super::resolved::are_resolved) are taken by [`Halves`](super::resolved::Halves).
    pub(crate) switches: bool,
}

/// What a scheme depends on of a scene.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Traits {
    pub(crate) inertia: bool,
    pub(crate) has_state: bool,
    /// Friction or viscosity grows with the slip rate at every frictional vertex.
    pub(crate) resists: bool,
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
    /// The defaults for a scene.
    pub(crate) fn new(given: Arc<dyn RateScheme>, scene: Traits) -> Self {
        let mut method = Self {
            scheme: Arc::clone(&given),
            given,
            scene,
            coupling: Arc::new(Monolithic::default()),
            state_update: StateUpdate::default(),
            tolerance: Tolerance::Relative(1e-10),
            switches: false,
        };
        method.settle();
        method
    }

    pub(crate) fn set_scheme(&mut self, given: Arc<dyn RateScheme>) {
        self.given = given;
        self.settle();
    }

    pub(crate) fn set_state_update(&mut self, state_update: StateUpdate) {
        self.state_update = state_update;
        self.settle();
    }

    /// What is left of the scheme in a scene without inertia. There the weights of the slip rate in displacement and
    /// state have to match, or a stiff contact has steps without a single solution, however short: a state by backward
    /// Euler goes with backward Euler.
    fn settle(&mut self) {
        let Traits {
            inertia,
            has_state,
            resists,
        } = self.scene;
        let given = Arc::clone(&self.given);
        // A scheme may leave out the inertia that a scene has.
        let inertia = inertia && given.update_formula(1.0).acceleration != Weights::ZERO;
        let implicit = has_state && self.state_update == StateUpdate::BackwardEuler;
        self.scheme = match given.quasi_static_radius() {
            _ if inertia => given,
            Some(_) if implicit => Arc::new(QuasiStatic(BackwardEuler)),
            Some(radius) if radius < 1.0 => Arc::new(FirstOrderAlpha {
                spectral_radius: radius,
            }),
            Some(_) if !resists => Arc::new(FirstOrderAlpha {
                spectral_radius: NUMERICS.damped_radius,
            }),
            _ => Arc::new(QuasiStatic(given)),
        };
        let single = self.scheme.properties().stages.len() == 1;
        self.switches = !inertia && (!single || self.scheme.properties().order > 1);
    }

    /// A stage of a Runge-Kutta method is backward Euler, for the state too.
    pub(crate) fn update_of(&self, scheme: &dyn RateScheme) -> StateUpdate {
        if scheme.properties().stages.len() > 1 {
            StateUpdate::BackwardEuler
        } else {
            self.state_update
        }
    }

    /// The order in time of rate and state together.
    pub(crate) fn order(&self) -> usize {
        let staged = self.scheme.properties().stages.len() > 1;
        if self.scene.has_state && !staged && self.state_update == StateUpdate::BackwardEuler {
            1
        } else {
            self.scheme.properties().order
        }
    }

    /// Whether the error has even powers of the step only.
    pub(crate) fn is_symmetric(&self) -> bool {
        self.scheme.properties().symmetric && self.order() > 1
    }
}

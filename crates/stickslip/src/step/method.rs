//! The method of time integration.

use std::sync::Arc;

use stickslip_time::{BackwardEuler, FirstOrderAlpha, QuasiStatic, RateScheme, Weights};

use super::{Coupling, Monolithic};
use crate::StateUpdate;
use crate::numerics::NUMERICS;

/// Scheme, coupling, state update and tolerance.
#[derive(Clone)]
pub(crate) struct Method {
    /// The given scheme, and its variant for this scene.
    given: Arc<dyn RateScheme>,
    pub(crate) scheme: Arc<dyn RateScheme>,
    scene: Traits,
    pub(crate) coupling: Arc<dyn Coupling>,
    state_update: StateUpdate,
    pub(crate) tolerance: Tolerance,
    /// Steps without [resolved](super::resolved::are_resolved) rates are replaced by
    /// [`Halves`](super::resolved::Halves).
    pub(crate) switches: bool,
}

/// The properties of a scene that determine the scheme.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Traits {
    pub(crate) inertia: bool,
    pub(crate) has_state: bool,
    /// Friction or viscosity grows with the slip rate at every frictional vertex.
    pub(crate) resists: bool,
    /// Explicit steps lag a viscosity, which is of first order.
    pub(crate) lags: bool,
}

/// The allowed error of a step's velocity.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Tolerance {
    /// In the norm of `A + M`.
    Absolute(f64),
    /// In the norm of the step's operator `B`, as a share of the velocity change by the frictional forces.
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

    /// Selects the first-order counterpart of the scheme in a scene without inertia. There the weights of the slip rate
    /// in displacement and state have to match; otherwise a stiff contact has steps without a unique solution, however
    /// short. Backward Euler for the state requires backward Euler for the displacement.
    fn settle(&mut self) {
        let Traits {
            inertia,
            has_state,
            resists,
            ..
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

    /// The state update of a stage; backward Euler for stages of a Runge-Kutta method.
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
        let lags = self.scene.lags && !self.scheme.properties().implicit;
        let implicit = self.state_update == StateUpdate::BackwardEuler;
        if lags || self.scene.has_state && !staged && implicit {
            1
        } else {
            self.scheme.properties().order
        }
    }

    /// Whether the error has only even powers of the step.
    pub(crate) fn is_symmetric(&self) -> bool {
        self.scheme.properties().symmetric && self.order() > 1
    }
}

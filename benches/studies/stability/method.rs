//! The coupling of rate and state of a case, and its laws.

use stickslip::friction::FrictionLaw;
use stickslip::state::LogTheta;
use stickslip::{FixedPoint, Monolithic, Simulation, StateUpdate};
use stickslip_cli::laws::{Friction, Law};

/// The coupling of rate and state.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Method {
    FixedPoint,
    Monolithic,
}

/// The couplings and state updates.
pub(crate) const METHODS: [(Method, StateUpdate, &str); 4] = [
    (
        Method::FixedPoint,
        StateUpdate::BackwardEuler,
        "fixed point",
    ),
    (
        Method::FixedPoint,
        StateUpdate::Midpoint,
        "fixed point, midpoint",
    ),
    (Method::Monolithic, StateUpdate::BackwardEuler, "monolithic"),
    (
        Method::Monolithic,
        StateUpdate::Midpoint,
        "monolithic, midpoint",
    ),
];

impl Method {
    /// The simulation with this coupling.
    pub(crate) fn on<const C: usize>(self, simulation: Simulation<C>) -> Simulation<C> {
        match self {
            Self::FixedPoint => simulation.with_coupling(FixedPoint::default()),
            Self::Monolithic => simulation.with_coupling(Monolithic::default()),
        }
    }
}

/// A friction law that reads `ln(theta)`.
pub(crate) type AnyFriction = Box<dyn FrictionLaw<State = LogTheta>>;

/// The state laws.
pub(crate) const EVOLUTIONS: [(Law, &str); 3] = [
    (Law::Dieterich, "Dieterich"),
    (Law::Ruina, "Ruina"),
    (Law::Discontinuous, "discontinuous"),
];

/// The friction laws that read a state.
pub(crate) const FRICTIONS: [(Friction, &str); 3] = [
    (Friction::DieterichRuina, "cut off"),
    (Friction::Regularized, "regularised"),
    (Friction::Tresca, "Tresca with state"),
];

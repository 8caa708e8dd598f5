//! How a case couples rate and state, and the friction laws it does so with.

use stickslip::StateUpdate;
use stickslip::friction::{DieterichRuina, RegularizedDieterichRuina, StateDependentTresca};

/// How rate and state are coupled.
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

/// The three friction laws that read a state.
pub(crate) fn friction(
    a: f64,
    ratio: f64,
    slip_distance: f64,
) -> (
    DieterichRuina,
    RegularizedDieterichRuina,
    StateDependentTresca,
) {
    let (b, reference_friction, reference_velocity) = (ratio * a, 0.6, 1e-6);
    (
        DieterichRuina {
            a,
            b,
            reference_friction,
            reference_velocity,
            slip_distance,
        },
        RegularizedDieterichRuina {
            a,
            b,
            reference_friction,
            reference_velocity,
            slip_distance,
        },
        StateDependentTresca {
            reference_friction,
            b,
            reference_velocity,
            slip_distance,
        },
    )
}

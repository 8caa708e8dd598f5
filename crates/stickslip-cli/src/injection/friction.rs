//! Friction on the fault: of rate and state, or constant.

use clap::{Args, ValueEnum};
use stickslip::friction::RegularizedDieterichRuina;

use crate::cli::{non_negative, positive};

/// Friction.
#[derive(Debug, Args)]
pub struct Friction {
    /// A constant coefficient of friction, by implicit steps with the dense matrix of the fault [default: friction that
    /// depends on rate and state]
    #[arg(long, value_name = "COEFFICIENT", value_parser = positive, conflicts_with_all = [
        "law", "a", "b", "slip_distance", "reference_friction", "reference_velocity", "initial_rate",
    ])]
    pub constant_friction: Option<f64>,
    /// The evolution of the state
    #[arg(long, value_enum, default_value_t = Law::Aging)]
    pub law: Law,
    /// The direct effect
    #[arg(long, value_name = "A", default_value_t = 0.016, value_parser = positive)]
    pub a: f64,
    /// The evolution effect
    #[arg(long, value_name = "B", default_value_t = 0.010, value_parser = non_negative)]
    pub b: f64,
    /// The characteristic slip distance [m]
    #[arg(long, value_name = "METRES", default_value = "0.5e-3", value_parser = positive)]
    pub slip_distance: f64,
    /// The steady coefficient of friction at the reference slip rate
    #[arg(long, value_name = "COEFFICIENT", default_value_t = 0.6, value_parser = positive)]
    pub reference_friction: f64,
    /// The reference slip rate [m/s]
    #[arg(long, value_name = "RATE", default_value = "1e-6", value_parser = positive)]
    pub reference_velocity: f64,
    /// The initial slip rate [m/s]; the initial state is that with which friction balances the shear stress
    #[arg(long, value_name = "RATE", default_value = "1e-12", value_parser = positive)]
    pub initial_rate: f64,
}

/// State laws by name.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Law {
    /// The aging law
    #[value(alias = "dieterich")]
    Aging,
    /// The slip law
    #[value(alias = "ruina")]
    Slip,
}

impl Friction {
    /// The initial slip rate [m/s]: 0 under constant friction.
    pub(super) fn creep(&self) -> f64 {
        self.constant_friction.map_or(self.initial_rate, |_| 0.0)
    }

    /// The coefficient of friction of rate and state.
    pub(super) fn of_rate_and_state(&self) -> RegularizedDieterichRuina {
        RegularizedDieterichRuina {
            a: self.a,
            b: self.b,
            reference_friction: self.reference_friction,
            reference_velocity: self.reference_velocity,
            slip_distance: self.slip_distance,
        }
    }
}

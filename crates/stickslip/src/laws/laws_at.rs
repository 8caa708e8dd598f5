//! The laws of a contact that keeps some of its vertices.

use std::sync::Arc;

use stickslip_friction::Response;
use stickslip_state::StateError;

use super::contact_laws::{ContactLaws, Followed, StateStart};

/// The laws at some places of a contact.
pub(crate) struct LawsAt {
    pub(crate) laws: Arc<dyn ContactLaws>,
    pub(crate) places: Vec<usize>,
}

impl ContactLaws for LawsAt {
    fn response(&self, k: usize, slip_rate: f64, state: f64) -> Response {
        self.laws.response(self.places[k], slip_rate, state)
    }

    fn potential(&self, k: usize, slip_rate: f64, state: f64) -> f64 {
        self.laws.potential(self.places[k], slip_rate, state)
    }

    fn slip_rate(&self, k: usize, viscosity: f64, drive: f64, state: f64) -> f64 {
        (self.laws).slip_rate(self.places[k], viscosity, drive, state)
    }

    fn advanced(&self, k: usize, from: StateStart, slip_rate: f64) -> Result<f64, StateError> {
        self.laws.advanced(self.places[k], from, slip_rate)
    }

    fn followed(&self, k: usize, from: StateStart, slip_rate: f64) -> Result<Followed, StateError> {
        self.laws.followed(self.places[k], from, slip_rate)
    }

    fn evolution(&self, k: usize, slip_rate: f64, state: f64) -> f64 {
        self.laws.evolution(self.places[k], slip_rate, state)
    }

    fn shifted(&self, k: usize, state: f64, stress: f64) -> (f64, f64) {
        self.laws.shifted(self.places[k], state, stress)
    }

    fn distance(&self, a: f64, b: f64) -> f64 {
        self.laws.distance(a, b)
    }
}

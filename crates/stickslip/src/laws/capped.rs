//! The laws of a contact below a cap of friction.

use std::sync::Arc;

use stickslip_friction::{Capped, FrictionLaw, Response};
use stickslip_state::{StateError, StateVariable};

use super::contact_laws::{ContactLaws, Followed, StateStart};

/// Laws, and the largest coefficient of each vertex; no caps at all where none are given.
#[derive(Clone)]
pub(crate) struct CappedLaws {
    pub(crate) laws: Arc<dyn ContactLaws>,
    pub(crate) caps: Vec<f64>,
}

impl CappedLaws {
    /// Laws without caps.
    pub(crate) fn new(laws: Arc<dyn ContactLaws>) -> Self {
        Self {
            laws,
            caps: Vec::new(),
        }
    }

    /// The laws with their caps.
    #[inline]
    pub(crate) fn in_force(&self) -> &dyn ContactLaws {
        if self.caps.is_empty() {
            &*self.laws
        } else {
            self
        }
    }

    fn at(&self, k: usize) -> Capped<AtVertex<'_>> {
        Capped {
            law: AtVertex {
                laws: &*self.laws,
                k,
            },
            cap: self.caps[k],
        }
    }
}

/// The friction of a vertex.
struct AtVertex<'a> {
    laws: &'a dyn ContactLaws,
    k: usize,
}

/// A state in the variable of its law.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Value(f64);

impl StateVariable for Value {
    fn value(self) -> f64 {
        self.0
    }

    fn from_value(value: f64) -> Self {
        Self(value)
    }
}

impl FrictionLaw for AtVertex<'_> {
    type State = Value;

    fn coefficient(&self, slip_rate: f64, state: Value) -> f64 {
        self.response(slip_rate, state).coefficient
    }

    fn coefficient_rate_slope(&self, slip_rate: f64, state: Value) -> f64 {
        self.response(slip_rate, state).rate_slope
    }

    fn response(&self, slip_rate: f64, Value(state): Value) -> Response {
        self.laws.response(self.k, slip_rate, state)
    }

    fn potential(&self, slip_rate: f64, Value(state): Value) -> f64 {
        self.laws.potential(self.k, slip_rate, state)
    }

    fn slip_rate(&self, viscosity: f64, drive: f64, Value(state): Value) -> f64 {
        self.laws.slip_rate(self.k, viscosity, drive, state)
    }
}

impl ContactLaws for CappedLaws {
    fn response(&self, k: usize, slip_rate: f64, state: f64) -> Response {
        (self.laws.response(k, slip_rate, state)).capped(self.caps[k])
    }

    fn potential(&self, k: usize, slip_rate: f64, state: f64) -> f64 {
        self.at(k).potential(slip_rate, Value(state))
    }

    fn slip_rate(&self, k: usize, viscosity: f64, drive: f64, state: f64) -> f64 {
        self.at(k).slip_rate(viscosity, drive, Value(state))
    }

    fn advanced(&self, k: usize, from: StateStart, slip_rate: f64) -> Result<f64, StateError> {
        self.laws.advanced(k, from, slip_rate)
    }

    fn followed(&self, k: usize, from: StateStart, slip_rate: f64) -> Result<Followed, StateError> {
        let mut followed = self.laws.followed(k, from, slip_rate)?;
        if followed.coefficient >= self.caps[k] {
            (followed.coefficient, followed.rate_slope) = (self.caps[k], 0.0);
        }
        Ok(followed)
    }

    fn evolution(&self, k: usize, slip_rate: f64, state: f64) -> f64 {
        self.laws.evolution(k, slip_rate, state)
    }

    fn slip_rates(&self, first: usize, problem: [&[f64]; 3], slip_rates: &mut [f64]) {
        self.laws.slip_rates(first, problem, slip_rates);
        let [viscosity, drive, _] = problem;
        let nodes = viscosity.iter().zip(drive).zip(&self.caps[first..]);
        for (rate, ((viscosity, drive), cap)) in slip_rates.iter_mut().zip(nodes) {
            let at_cap = (drive - cap) / viscosity;
            if at_cap > *rate {
                *rate = at_cap;
            }
        }
    }

    fn slopes(&self, first: usize, at: [&[f64]; 2], [by_rate, by_state]: [&mut [f64]; 2]) {
        (self.laws).slopes(first, at, [&mut *by_rate, &mut *by_state]);
        let [slip_rates, states] = at;
        for (i, cap) in self.caps[first..].iter().take(states.len()).enumerate() {
            // Most vertices are far from a cap, which is infinite where none is forced.
            if *cap < f64::INFINITY {
                let response = self.response(first + i, slip_rates[i], states[i]);
                (by_rate[i], by_state[i]) = (response.rate_slope, response.state_slope);
            }
        }
    }

    fn evolutions(&self, first: usize, at: [&[f64]; 2], rates: &mut [f64]) {
        self.laws.evolutions(first, at, rates);
    }

    fn shifted(&self, k: usize, state: f64, stress: f64) -> (f64, f64) {
        self.laws.shifted(k, state, stress)
    }

    fn distance(&self, a: f64, b: f64) -> f64 {
        self.laws.distance(a, b)
    }
}

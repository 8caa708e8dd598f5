//! Values of contacts that are not finite, and laws under observation: which of them returns such a value.

use std::sync::{Arc, OnceLock};

use stickslip_friction::Response;
use stickslip_state::StateError;

use super::balance::balance;
use super::trial::Refused;
use super::{ContactSet, DiscreteContact};
use crate::StepError;
use crate::error::BODY_STRESS;
use crate::laws::{ContactLaws, Followed, StateStart};
use crate::scene::NORMAL_STRESS_CHANGE;

/// The values of laws in errors.
pub(crate) const COEFFICIENT: &str = "friction coefficient";
pub(crate) const STATE: &str = "new state";
pub(crate) const EVOLUTION: &str = "rate of the state";

/// Laws that remember the first value of theirs that is not finite, at finite arguments.
struct WatchedLaws {
    laws: Arc<dyn ContactLaws>,
    vertices: Vec<usize>,
    first: OnceLock<StepError>,
}

/// The laws of all contacts under observation.
pub(crate) struct Watch(Vec<Arc<WatchedLaws>>);

impl WatchedLaws {
    fn see(&self, k: usize, [slip_rate, state]: [f64; 2], what: &'static str, value: f64) {
        if !value.is_finite() && slip_rate.is_finite() && state.is_finite() {
            self.first.get_or_init(|| StepError::Law {
                what,
                vertex: self.vertices[k],
                slip_rate,
                state,
                value,
            });
        }
    }

    fn see_step<T>(
        &self,
        k: usize,
        slip_rate: f64,
        advanced: Result<T, StateError>,
    ) -> Result<T, StateError> {
        advanced.inspect_err(|&source| {
            if slip_rate.is_finite() {
                self.first.get_or_init(|| StepError::State {
                    vertex: self.vertices[k],
                    slip_rate,
                    source,
                });
            }
        })
    }
}

impl ContactLaws for WatchedLaws {
    fn response(&self, k: usize, slip_rate: f64, state: f64) -> Response {
        let response = self.laws.response(k, slip_rate, state);
        self.see(k, [slip_rate, state], COEFFICIENT, response.coefficient);
        response
    }

    fn potential(&self, k: usize, slip_rate: f64, state: f64) -> f64 {
        let potential = self.laws.potential(k, slip_rate, state);
        self.see(k, [slip_rate, state], "potential of friction", potential);
        potential
    }

    fn slip_rate(&self, k: usize, viscosity: f64, drive: f64, state: f64) -> f64 {
        let found = self.laws.slip_rate(k, viscosity, drive, state);
        if !found.is_finite() && drive.is_finite() && viscosity > 0.0 {
            // The slip rate at which the coefficient is lost, if it is the coefficient.
            balance(viscosity, drive, f64::INFINITY, |rate| {
                let response = self.response(k, rate, state);
                (response.coefficient, response.rate_slope)
            });
            let fastest = [drive / viscosity, state];
            self.see(k, fastest, "slip rate of the friction law", found);
        }
        found
    }

    fn advanced(&self, k: usize, from: StateStart, slip_rate: f64) -> Result<f64, StateError> {
        let state = self.see_step(k, slip_rate, self.laws.advanced(k, from, slip_rate))?;
        self.see(k, [slip_rate, from.state], STATE, state);
        Ok(state)
    }

    fn followed(&self, k: usize, from: StateStart, slip_rate: f64) -> Result<Followed, StateError> {
        let to = self.see_step(k, slip_rate, self.laws.followed(k, from, slip_rate))?;
        self.see(k, [slip_rate, from.state], STATE, to.state);
        self.see(k, [slip_rate, to.state], COEFFICIENT, to.coefficient);
        Ok(to)
    }

    fn evolution(&self, k: usize, slip_rate: f64, state: f64) -> f64 {
        let rate = self.laws.evolution(k, slip_rate, state);
        self.see(k, [slip_rate, state], EVOLUTION, rate);
        rate
    }

    fn shifted(&self, k: usize, state: f64, stress: f64) -> (f64, f64) {
        self.laws.shifted(k, state, stress)
    }

    fn distance(&self, a: f64, b: f64) -> f64 {
        self.laws.distance(a, b)
    }
}

impl<const C: usize> ContactSet<C> {
    /// Watches the laws of all contacts, to repeat a step that failed for a value that is not finite.
    pub(crate) fn watch(&mut self) -> Watch {
        let contacts = self.contacts.iter_mut().map(|contact| {
            let laws = contact.trial.laws_mut();
            let watched = Arc::new(WatchedLaws {
                laws: laws.clone(),
                vertices: contact.part.vertices.clone(),
                first: OnceLock::new(),
            });
            *laws = watched.clone();
            watched
        });
        Watch(contacts.collect())
    }

    /// Ends a watch; returns the error of a law that was not finite.
    pub(crate) fn end_watch(&mut self, Watch(watched): Watch) -> Option<StepError> {
        for (contact, watched) in self.contacts.iter_mut().zip(&watched) {
            *contact.trial.laws_mut() = watched.laws.clone();
        }
        let mut errors = watched.iter().filter_map(|watched| watched.first.get());
        errors.next().cloned()
    }
}

impl<const C: usize> DiscreteContact<C> {
    /// The error of a slip rate in use without a state.
    pub(crate) fn refused(&self, k: usize, refused: Refused) -> StepError {
        let rate = self.rates.as_ref().map(|rates| rates[k]);
        let (vertex, slip_rate) = (self.part.vertices[k], rate.unwrap_or_default());
        let (what, value) = match refused {
            Refused::State(source) => {
                return StepError::State {
                    vertex,
                    slip_rate,
                    source,
                };
            }
            Refused::Value(to) if to.state.is_finite() => (COEFFICIENT, to.coefficient),
            Refused::Value(to) => (STATE, to.state),
        };
        StepError::Law {
            what,
            vertex,
            slip_rate,
            state: self.trial.state(k),
            value,
        }
    }

    /// The error of a normal stress in force that is not finite at vertex number `k`, with its change at each vertex of
    /// the body, or none.
    #[cold]
    pub(crate) fn lost_stress(&self, k: usize, change: &[f64]) -> StepError {
        let vertex = self.part.vertices[k];
        let change = change.get(vertex).copied().unwrap_or(0.0);
        let (what, value) = if !change.is_finite() {
            (NORMAL_STRESS_CHANGE, change)
        } else if self.body.is_some() {
            (BODY_STRESS, self.normal_stress[k])
        } else {
            ("normal stress", self.normal_stress[k])
        };
        StepError::Data {
            what,
            vertex,
            value,
        }
    }
}

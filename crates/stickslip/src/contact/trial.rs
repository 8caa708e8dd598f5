//! The states of a contact in the current step, and friction as a function of the slip rate alone.

mod propose;

pub(crate) use propose::Refused;

use std::sync::Arc;

use stickslip_friction::Response;
use stickslip_state::StateError;

use super::balance::balance;
use super::quadrature::integral;
use crate::StateUpdate;
use crate::laws::{
    CappedLaws, ContactLaws, Followed, LawProperties, StateStart, StateStep, at_least, change,
};
use crate::scene::ErasedLaws;

/// The states of a contact in a step: frozen for a fixed point, or condensed, each a function `alpha(V)` of its slip
/// rate by the step's own state update. Vertices are counted along the contact.
#[derive(Clone)]
pub(crate) struct Trial {
    pub(super) laws: CappedLaws,
    properties: LawProperties,
    #[cfg(feature = "checkpoint")]
    initial: Vec<f64>,
    eliminated: bool,
    step: StateStep,
    /// The states in use, unless they are condensed.
    states: Vec<f64>,
    /// The last proposed states.
    proposed: Vec<f64>,
    /// The slip rates for which they were proposed [m/s], NaN before, and the slopes of friction there.
    slopes: Vec<(f64, f64)>,
    /// The state, after the first share of the normal stress change, and the slip rate at the beginning of the step
    /// [m/s].
    starts: Vec<(f64, f64)>,
    /// The share of the logarithmic normal stress change that acts at the end of the step; empty without such an
    /// effect.
    stress: Vec<f64>,
    /// The least states that friction reads at the time in force; empty where it reads the states themselves.
    pub(crate) least: Vec<f64>,
}

/// A state whose normal stress vanishes, by its place in the contact.
pub(crate) struct Vanished(pub(crate) usize);

impl Trial {
    /// Allocates all memory.
    pub(crate) fn new(laws: ErasedLaws) -> Self {
        let ErasedLaws {
            functions: laws,
            properties,
            initial,
        } = laws;
        let count = initial.len();
        let size = |needed: bool| if needed { count } else { 0 };
        Self {
            eliminated: false,
            step: StateStep {
                dt: 0.0,
                update: StateUpdate::default(),
                new_share: 0.5,
            },
            proposed: vec![0.0; size(properties.has_state)],
            slopes: vec![(f64::NAN, 0.0); size(properties.has_state)],
            starts: initial.iter().map(|&state| (state, 0.0)).collect(),
            stress: vec![0.0; size(properties.follows_normal_stress)],
            least: Vec::new(),
            #[cfg(feature = "checkpoint")]
            initial: initial.clone(),
            states: initial,
            laws: CappedLaws::new(laws),
            properties,
        }
    }

    #[inline]
    pub(crate) fn laws(&self) -> &dyn ContactLaws {
        self.laws.in_force()
    }

    pub(crate) fn laws_mut(&mut self) -> &mut Arc<dyn ContactLaws> {
        &mut self.laws.laws
    }

    pub(crate) fn has_state(&self) -> bool {
        self.properties.has_state
    }

    pub(crate) fn follows_normal_stress(&self) -> bool {
        self.properties.follows_normal_stress
    }

    /// Whether friction, with its state condensed, can weaken with the slip rate.
    pub(crate) fn may_weaken(&self) -> bool {
        self.properties.has_state || self.properties.unchecked
    }

    /// The initial states.
    #[cfg(feature = "checkpoint")]
    pub(crate) fn initial(&self) -> &[f64] {
        &self.initial
    }

    /// The state in use.
    #[inline]
    pub(crate) fn state(&self, k: usize) -> f64 {
        self.states[k]
    }

    /// The states in use.
    pub(crate) fn states(&self) -> &[f64] {
        &self.states
    }

    /// The states in use, to freeze others.
    pub(crate) fn states_mut(&mut self) -> &mut [f64] {
        &mut self.states
    }

    /// The states in use from the `first` on, as friction reads them.
    pub(crate) fn read_states(&self, first: usize, to: &mut [f64]) {
        to.copy_from_slice(&self.states[first..][..to.len()]);
        for (state, &least) in to.iter_mut().zip(self.least.iter().skip(first)) {
            (*state, _) = at_least(*state, least);
        }
    }

    /// Whether the local problem is searched from the slip rate of the last step: that of laws that were not checked.
    pub(crate) fn is_searched(&self) -> bool {
        !self.properties.has_state && self.properties.unchecked
    }

    /// Begins a step from states and slip rates with the states frozen, while the normal stress changes from one value
    /// to another. The slip rates are empty where no law depends on them.
    pub(crate) fn begin(
        &mut self,
        step: StateStep,
        (states, rates): (&[f64], &[f64]),
        normal_stress: [&[f64]; 2],
    ) -> Result<(), Vanished> {
        (self.step, self.eliminated) = (step, false);
        self.slopes.fill((f64::NAN, 0.0));
        for (now, &state) in self.states.iter_mut().zip(states) {
            *now = state;
        }
        for (start, &state) in self.starts.iter_mut().zip(states) {
            start.0 = state;
        }
        for (start, &rate) in self.starts.iter_mut().zip(rates) {
            start.1 = rate;
        }
        let [before, after] = step.update.shares();
        for (k, left) in self.stress.iter_mut().enumerate() {
            let (start, _) = self.starts[k];
            let stress = normal_stress.map(|stress| stress[k]);
            let moved = change(&*self.laws.laws, k, start, stress).ok_or(Vanished(k))?;
            *left = after * moved;
            self.starts[k].0 = self.laws.laws.shifted(k, start, before * moved).0;
        }
        Ok(())
    }

    /// Condenses the state, or freezes it again.
    pub(crate) fn eliminate(&mut self, eliminated: bool) {
        self.eliminated = eliminated && self.properties.has_state;
    }

    fn start(&self, k: usize) -> StateStart {
        let (state, rate) = self.starts[k];
        StateStart {
            step: self.step,
            state,
            rate,
            stress: self.stress.get(k).copied().unwrap_or(0.0),
            least: self.least(k),
        }
    }

    #[inline]
    fn least(&self, k: usize) -> f64 {
        self.least.get(k).copied().unwrap_or(f64::NEG_INFINITY)
    }

    /// The state in use, as friction reads it, and its derivative in the former.
    #[inline]
    fn read(&self, k: usize) -> (f64, f64) {
        at_least(self.states[k], self.least(k))
    }

    /// `mu(V, alpha)` and its slopes at the state in use.
    #[inline]
    pub(crate) fn response(&self, k: usize, slip_rate: f64) -> Response {
        let (state, slope) = self.read(k);
        let mut response = self.laws().response(k, slip_rate, state);
        response.state_slope *= slope;
        response
    }

    /// Friction with the state of a slip rate at the end of the step.
    #[inline]
    fn followed(&self, k: usize, slip_rate: f64) -> Result<Followed, StateError> {
        self.laws().followed(k, self.start(k), slip_rate)
    }

    /// The same; NaN where the law has no solution.
    #[inline]
    fn followed_or_nan(&self, k: usize, slip_rate: f64) -> Followed {
        self.followed(k, slip_rate).unwrap_or(Followed::NONE)
    }

    /// Moves the states in use by the share `relaxation` towards the proposed ones.
    pub(crate) fn relax(&mut self, relaxation: f64) {
        for (state, proposed) in self.states.iter_mut().zip(&self.proposed) {
            // The whole way must not pass through a rounded difference.
            *state = if relaxation == 1.0 {
                *proposed
            } else {
                *state + relaxation * (proposed - *state)
            };
        }
    }

    /// `mu(V)` and its slope in the step.
    #[inline]
    pub(crate) fn coefficient_and_rate_slope(&self, k: usize, slip_rate: f64) -> (f64, f64) {
        if self.eliminated {
            let followed = self.followed_or_nan(k, slip_rate);
            (followed.coefficient, followed.rate_slope)
        } else {
            let response = self.response(k, slip_rate);
            (response.coefficient, response.rate_slope)
        }
    }

    /// The slope of `mu` at a slip rate of the end of the step, with the state condensed. That of the last proposal is
    /// known.
    pub(crate) fn slope_at_end(&self, k: usize, slip_rate: f64) -> f64 {
        match self.slopes.get(k) {
            Some(&(rate, slope)) if rate == slip_rate => slope,
            Some(_) => self.followed_or_nan(k, slip_rate).rate_slope,
            None => self.response(k, slip_rate).rate_slope,
        }
    }

    /// The integral of `mu`; with a condensed state by quadrature.
    pub(crate) fn potential(&self, k: usize, slip_rate: f64) -> f64 {
        if !self.eliminated {
            return self.laws().potential(k, slip_rate, self.read(k).0);
        }
        integral(slip_rate, |rate| self.followed_or_nan(k, rate).coefficient)
    }

    /// The slip rate with `viscosity V + mu(V) = drive`.
    pub(crate) fn slip_rate(&self, k: usize, viscosity: f64, drive: f64) -> f64 {
        // Every search starts from the slip rate at the beginning of the step. A start from what was found last would be
        // nearer, but then a result would depend on what was solved before.
        let (_, start) = self.starts[k];
        let closed_form = |state: f64| self.laws().slip_rate(k, viscosity, drive, state);
        let guess = if self.eliminated {
            let state = self.laws().advanced(k, self.start(k), start);
            closed_form(at_least(state.unwrap_or(f64::NAN), self.least(k)).0)
        } else if self.is_searched() {
            start
        } else {
            return closed_form(self.read(k).0);
        };
        balance(viscosity, drive, guess, |rate| {
            self.coefficient_and_rate_slope(k, rate)
        })
    }
}

#[cfg(test)]
#[path = "../../tests/unit/trial.rs"]
mod tests;

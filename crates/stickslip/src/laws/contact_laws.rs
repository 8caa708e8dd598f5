//! The type-erased laws of a contact for the time step: functions of numbers per vertex.

use stickslip_friction::Response;
use stickslip_state::{StateError, StateLaw};
use stickslip_time::{Motion, UpdateFormula};

use super::one_by_one;
use super::state_update::StateUpdate;

/// Properties of the laws of a contact.
#[derive(Debug, Clone, Copy)]
pub(crate) struct LawProperties {
    pub(crate) has_state: bool,
    /// The laws were not checked: friction without a state need not grow with the slip rate.
    pub(crate) unchecked: bool,
    /// The state depends on the normal stress.
    pub(crate) follows_normal_stress: bool,
}

/// The start of a state's step.
#[derive(Debug, Clone, Copy)]
pub(crate) struct StateStart {
    pub(crate) step: StateStep,
    /// The state, and the slip rate from the previous step [m/s], see [`StateStep::new_share`].
    pub(crate) state: f64,
    pub(crate) rate: f64,
    /// The logarithm of the share of a normal stress change that acts on the state after the law's step.
    pub(crate) stress: f64,
    /// The least state that friction reads; negative infinity for any.
    pub(crate) least: f64,
}

/// A state as friction reads it, at least a given one, and its derivative in the state.
#[inline]
pub(crate) fn at_least(state: f64, least: f64) -> (f64, f64) {
    // A maximum would forget a state that is not a number.
    if state < least {
        (least, 0.0)
    } else {
        (state, 1.0)
    }
}

/// Friction with its state advanced at the slip rate.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Followed {
    pub(crate) state: f64,
    pub(crate) coefficient: f64,
    /// `dmu/dV + dmu/dalpha dalpha/dV`; a negative value is weakening.
    pub(crate) rate_slope: f64,
}

impl Followed {
    /// The value where the law has no solution.
    pub(crate) const NONE: Self = Self {
        state: f64::NAN,
        coefficient: f64::NAN,
        rate_slope: f64::NAN,
    };
}

/// The laws of a contact; states are in the state law's own variable. Vertices are counted along the contact.
pub(crate) trait ContactLaws: Send + Sync {
    /// `mu(V, alpha)` and its slopes.
    fn response(&self, k: usize, slip_rate: f64, state: f64) -> Response;

    /// The integral of `mu` over the slip rate.
    fn potential(&self, k: usize, slip_rate: f64, state: f64) -> f64;

    /// The `V` with `viscosity V + mu(V, alpha) = drive`.
    fn slip_rate(&self, k: usize, viscosity: f64, drive: f64, state: f64) -> f64;

    /// The state after the law's own step to a slip rate.
    fn advanced(&self, k: usize, from: StateStart, slip_rate: f64) -> Result<f64, StateError>;

    /// State, coefficient and slope after that step.
    fn followed(&self, k: usize, from: StateStart, slip_rate: f64) -> Result<Followed, StateError>;

    /// `alpha'`.
    fn evolution(&self, k: usize, slip_rate: f64, state: f64) -> f64;

    /// The slip rates of the vertices from the `first` on, by their viscosities, drives and states.
    fn slip_rates(&self, first: usize, problem: [&[f64]; 3], slip_rates: &mut [f64]) {
        one_by_one::slip_rates(self, first, problem, slip_rates);
    }

    /// `dmu/dV` and `dmu/dalpha` of the vertices from the `first` on, at slip rates above 0 and states.
    fn slopes(&self, first: usize, at: [&[f64]; 2], slopes: [&mut [f64]; 2]) {
        one_by_one::slopes(self, first, at, slopes);
    }

    /// `alpha'` of the vertices from the `first` on, by their slip rates and states.
    fn evolutions(&self, first: usize, at: [&[f64]; 2], rates: &mut [f64]) {
        one_by_one::evolutions(self, first, at, rates);
    }

    /// The state after a change of the normal stress, given by its logarithm, and its derivative in the old state.
    fn shifted(&self, k: usize, state: f64, stress: f64) -> (f64, f64);

    /// The distance of two states, on the scale of the state's effect.
    fn distance(&self, a: f64, b: f64) -> f64;
}

/// The logarithm of a change of the normal stress, 0 where the state does not depend on it; none where the state does
/// and the normal stress vanishes.
pub(crate) fn change(
    laws: &dyn ContactLaws,
    k: usize,
    state: f64,
    [from, to]: [f64; 2],
) -> Option<f64> {
    if from > 0.0 && to > 0.0 {
        return Some((to / from).ln());
    }
    (from == to || laws.shifted(k, state, 1.0).0 == state).then_some(0.0)
}

/// The step of the state at all vertices.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct StateStep {
    pub(crate) dt: f64,
    pub(crate) update: StateUpdate,
    /// The share of the new slip rate in the mean one of [`StateUpdate::Midpoint`].
    pub(crate) new_share: f64,
}

impl StateStep {
    /// A step of `dt` that is consistent with an update formula of the motion: the state sees the slip of the
    /// displacement.
    ///
    /// A formula with an algorithmic velocity updates the displacement by that velocity. With inertia this velocity
    /// damps waves, and the state does not use it.
    pub(crate) fn new(
        dt: f64,
        update: StateUpdate,
        formula: &UpdateFormula,
        inertia: bool,
    ) -> Self {
        let new_share = if Self::has_algorithmic_velocity(formula, inertia) {
            formula.displacement.new_velocity / dt
        } else {
            0.5
        };
        Self {
            dt,
            update,
            new_share,
        }
    }

    fn has_algorithmic_velocity(formula: &UpdateFormula, inertia: bool) -> bool {
        !inertia && formula.displacement.algorithmic != 0.0
    }

    /// The velocity of a motion from the previous step.
    pub(crate) fn taken_over(&self, formula: &UpdateFormula, from: Motion, inertia: bool) -> f64 {
        if !Self::has_algorithmic_velocity(formula, inertia) {
            return from.velocity;
        }
        let moved = formula.displacement.of_old(Motion {
            displacement: 0.0,
            ..from
        });
        moved / (self.dt * (1.0 - self.new_share))
    }

    fn mean(&self, old_rate: f64, slip_rate: f64) -> f64 {
        (1.0 - self.new_share) * old_rate + self.new_share * slip_rate
    }

    /// The state at the slip rate `slip_rate` at the end of the step, from a state and a slip rate.
    #[inline]
    pub(crate) fn advance<S: StateLaw>(
        &self,
        law: &S,
        from: S::State,
        old_rate: f64,
        slip_rate: f64,
    ) -> Result<S::State, StateError> {
        match self.update {
            StateUpdate::BackwardEuler => law.advance(from, slip_rate, self.dt),
            StateUpdate::Midpoint => {
                law.advance_at_constant_rate(from, self.mean(old_rate, slip_rate), self.dt)
            }
        }
    }

    /// The derivative of [`advance`](Self::advance), whose result is `to`, in the slip rate.
    #[inline]
    pub(crate) fn slope<S: StateLaw>(
        &self,
        law: &S,
        (from, to): (S::State, S::State),
        old_rate: f64,
        slip_rate: f64,
    ) -> f64 {
        match self.update {
            StateUpdate::BackwardEuler => law.advance_rate_slope(from, to, slip_rate, self.dt),
            StateUpdate::Midpoint => {
                let rate = self.mean(old_rate, slip_rate);
                self.new_share * law.advance_at_constant_rate_rate_slope(from, to, rate, self.dt)
            }
        }
    }
}

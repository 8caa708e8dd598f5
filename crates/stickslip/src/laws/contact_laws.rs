//! The type-erased laws of a contact for the time step: functions of numbers per vertex.

use std::any::Any;

use stickslip_friction::{FrictionLaw, Nodal, Response};
use stickslip_state::{Reads, StateError, StateLaw, StateVariable};
use stickslip_time::{Motion, UpdateFormula};

use super::normal_stress_effect::NormalStressEffect;
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
pub(crate) trait ContactLaws: Any + Send + Sync {
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

    /// The state after a change of the normal stress, given by its logarithm, and its derivative in the old state.
    fn shifted(&self, k: usize, state: f64, stress: f64) -> (f64, f64);

    /// The distance of two states, on the scale of the state's effect.
    fn distance(&self, a: f64, b: f64) -> f64;
}

/// A state after a law's own step, that state after a change of the normal stress, and the slope of this change.
type Stepped<S> = (<S as StateLaw>::State, <S as StateLaw>::State, f64);

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

/// A friction law with its state law, static for each vertex.
pub(crate) struct RateAndState<L, S: StateLaw> {
    pub(crate) friction: Nodal<L>,
    pub(crate) evolution: Nodal<S>,
    pub(crate) effect: Option<NormalStressEffect<S::State>>,
}

impl<L, S: StateLaw> RateAndState<L, S> {
    /// The state after the law's own step, after the remaining share of the normal stress change, and the derivative of
    /// the latter in the former.
    #[inline]
    fn stepped(
        &self,
        k: usize,
        from: StateStart,
        slip_rate: f64,
    ) -> Result<Stepped<S>, StateError> {
        let (law, start) = (self.evolution.at(k), S::State::from_value(from.state));
        let advanced = from.step.advance(law, start, from.rate, slip_rate)?;
        let (state, shift_slope) = match &self.effect {
            Some(effect) => effect.shifted(k, advanced, from.stress),
            None => (advanced, 1.0),
        };
        Ok((advanced, state, shift_slope))
    }
}

impl<L, S> ContactLaws for RateAndState<L, S>
where
    L: FrictionLaw + 'static,
    S: StateLaw + 'static,
    L::State: Reads<S::State>,
{
    #[inline]
    fn response(&self, k: usize, slip_rate: f64, state: f64) -> Response {
        let state = S::State::from_value(state);
        let friction = self.friction.at(k);
        let mut response = friction.response(slip_rate, L::State::read(state));
        response.state_slope *= L::State::slope(state);
        response
    }

    fn potential(&self, k: usize, slip_rate: f64, state: f64) -> f64 {
        let state = L::State::read(S::State::from_value(state));
        self.friction.at(k).potential(slip_rate, state)
    }

    fn slip_rate(&self, k: usize, viscosity: f64, drive: f64, state: f64) -> f64 {
        let state = L::State::read(S::State::from_value(state));
        self.friction.at(k).slip_rate(viscosity, drive, state)
    }

    fn advanced(&self, k: usize, from: StateStart, slip_rate: f64) -> Result<f64, StateError> {
        let (_, state, _) = self.stepped(k, from, slip_rate)?;
        Ok(state.value())
    }

    fn followed(&self, k: usize, from: StateStart, slip_rate: f64) -> Result<Followed, StateError> {
        let (law, start) = (self.evolution.at(k), S::State::from_value(from.state));
        let (advanced, state, shift_slope) = self.stepped(k, from, slip_rate)?;
        let (read, read_slope) = at_least(state.value(), from.least);
        let read = S::State::from_value(read);
        let response = (self.friction.at(k)).response(slip_rate, L::State::read(read));
        let mut rate_slope = response.rate_slope;
        if response.state_slope != 0.0 && read_slope != 0.0 {
            let follows = (from.step).slope(law, (start, advanced), from.rate, slip_rate);
            rate_slope += response.state_slope * L::State::slope(state) * shift_slope * follows;
        }
        Ok(Followed {
            state: state.value(),
            coefficient: response.coefficient,
            rate_slope,
        })
    }

    fn evolution(&self, k: usize, slip_rate: f64, state: f64) -> f64 {
        (self.evolution.at(k)).evolution(S::State::from_value(state), slip_rate)
    }

    fn shifted(&self, k: usize, state: f64, stress: f64) -> (f64, f64) {
        let Some(effect) = &self.effect else {
            return (state, 1.0);
        };
        let (state, slope) = effect.shifted(k, S::State::from_value(state), stress);
        (state.value(), slope)
    }

    fn distance(&self, a: f64, b: f64) -> f64 {
        S::State::from_value(a).distance(S::State::from_value(b))
    }
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

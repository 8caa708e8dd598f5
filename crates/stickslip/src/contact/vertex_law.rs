//! The coefficient of friction of one vertex in one step, as a function of its slip rate alone.

use stickslip_friction::FrictionLaw;
use stickslip_state::{Reads, StateLaw, StateVariable};

use super::balance::balance;
use super::state_update::StateStep;

/// What a step knows of the state of a vertex.
#[derive(Debug, Clone, Copy)]
pub(super) struct VertexState<T> {
    /// The state in use, unless it is eliminated.
    pub(super) state: T,
    /// What was proposed last in its place.
    pub(super) proposed: T,
    /// State and slip rate at the beginning of the step.
    pub(super) start: T,
    pub(super) start_rate: f64,
    /// The state for the slip rate of the last step, where every search of this step starts. A start from
    /// what was found last would be nearer, but where a step has several solutions it may follow another
    /// one than that which continues the last step.
    pub(super) guess: T,
}

impl<T: Copy> VertexState<T> {
    pub(super) fn at_rest(state: T) -> Self {
        Self {
            state,
            proposed: state,
            start: state,
            start_rate: 0.0,
            guess: state,
        }
    }
}

/// `mu(V, alpha)` with the state either frozen, which is how a fixed point sees it, or eliminated: a function
/// `alpha(V)` of the slip rate by the step's own state update.
///
/// Eliminated, the coefficient need not grow with the slip rate. Its slope is that of the whole,
/// `dmu/dV + dmu/dalpha dalpha/dV`, and may be negative.
pub(super) struct VertexLaw<'a, L, S: StateLaw> {
    pub(super) friction: &'a L,
    pub(super) evolution: &'a S,
    pub(super) vertex: &'a VertexState<S::State>,
    /// The step by which the state is eliminated.
    pub(super) eliminated: Option<StateStep>,
}

impl<L: FrictionLaw, S: StateLaw> VertexLaw<'_, L, S>
where
    L::State: Reads<S::State>,
{
    /// The state at a slip rate; not a number where the law has no answer.
    #[inline]
    pub(super) fn state_at(&self, slip_rate: f64) -> S::State {
        let Some(step) = self.eliminated else {
            return self.vertex.state;
        };
        let (start, old_rate) = (self.vertex.start, self.vertex.start_rate);
        let advanced = step.advance(self.evolution, start, old_rate, slip_rate);
        advanced.unwrap_or_else(|_| S::State::from_value(f64::NAN))
    }

    pub(super) fn coefficient(&self, slip_rate: f64) -> f64 {
        let state = self.state_at(slip_rate);
        self.friction.coefficient(slip_rate, L::State::read(state))
    }

    #[inline]
    pub(super) fn coefficient_and_rate_slope(&self, slip_rate: f64) -> (f64, f64) {
        let state = self.state_at(slip_rate);
        let read = L::State::read(state);
        let Some(step) = self.eliminated else {
            return self.friction.coefficient_and_rate_slope(slip_rate, read);
        };
        let response = self.friction.response(slip_rate, read);
        let mut slope = response.rate_slope;
        if response.state_slope != 0.0 {
            let (start, old_rate) = (self.vertex.start, self.vertex.start_rate);
            slope += response.state_slope
                * L::State::slope(state)
                * step.slope(self.evolution, (start, state), old_rate, slip_rate);
        }
        (response.coefficient, slope)
    }

    /// The integral of the coefficient; with an eliminated state by quadrature: Gauss's rule of three points
    /// on 256 panels that shrink towards rest.
    pub(super) fn potential(&self, slip_rate: f64) -> f64 {
        if self.eliminated.is_none() {
            let state = L::State::read(self.vertex.state);
            return self.friction.potential(slip_rate, state);
        }
        const PANELS: usize = 256;
        const SHRINK: f64 = 0.75;
        let (mut right, mut sum) = (slip_rate, 0.0);
        for panel in 1..=PANELS {
            let left = if panel < PANELS { right * SHRINK } else { 0.0 };
            let (middle, half) = (0.5 * (left + right), 0.5 * (right - left));
            let offset = half * 0.6_f64.sqrt();
            let outer = self.coefficient(middle - offset) + self.coefficient(middle + offset);
            sum += half * (5.0 * outer + 8.0 * self.coefficient(middle)) / 9.0;
            right = left;
        }
        sum
    }

    /// The slip rate with `viscosity V + mu(V) = drive`.
    pub(super) fn slip_rate(&self, viscosity: f64, drive: f64) -> f64 {
        if self.eliminated.is_none() {
            let state = L::State::read(self.vertex.state);
            return self.friction.slip_rate(viscosity, drive, state);
        }
        let state = L::State::read(self.vertex.guess);
        let guess = self.friction.slip_rate(viscosity, drive, state);
        balance(viscosity, drive, guess, |rate| {
            self.coefficient_and_rate_slope(rate)
        })
    }
}

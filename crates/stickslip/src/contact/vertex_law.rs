//! The coefficient of friction of one vertex in one step, as a function of its slip rate alone.

use stickslip_friction::FrictionLaw;
use stickslip_state::{Reads, StateLaw, StateVariable};

use super::balance::balance;
use super::normal_stress_effect::Shift;
use super::state_update::StateStep;

/// What a step knows of the state of a vertex.
#[derive(Debug, Clone, Copy)]
pub(super) struct VertexState<T> {
    /// The state in use, unless it is eliminated.
    pub(super) state: T,
    /// What was proposed last in its place.
    pub(super) proposed: T,
    /// State, with what the normal stress moves at once, and slip rate at the beginning of the step.
    pub(super) start: T,
    pub(super) start_rate: f64,
    /// The slip rate on the solution that is followed: that of the last step, or of a part of this one.
    pub(super) aim: f64,
}

impl<T: Copy> VertexState<T> {
    pub(super) fn at_rest(state: T) -> Self {
        Self {
            state,
            proposed: state,
            start: state,
            start_rate: 0.0,
            aim: 0.0,
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
    /// What the normal stress moves at the end of it.
    pub(super) shift: Option<Shift<S::State>>,
    /// Without a state, and nobody has looked whether friction grows with the slip rate.
    pub(super) unchecked: bool,
}

impl<L: FrictionLaw, S: StateLaw> VertexLaw<'_, L, S>
where
    L::State: Reads<S::State>,
{
    /// The state at a slip rate; not a number where the law has no answer.
    #[inline]
    pub(super) fn state_at(&self, slip_rate: f64) -> S::State {
        match self.eliminated {
            Some(step) => self.moved(self.advanced(step, slip_rate)),
            None => self.vertex.state,
        }
    }

    /// The law's own step.
    #[inline]
    fn advanced(&self, step: StateStep, slip_rate: f64) -> S::State {
        let (start, old_rate) = (self.vertex.start, self.vertex.start_rate);
        let advanced = step.advance(self.evolution, start, old_rate, slip_rate);
        advanced.unwrap_or_else(|_| S::State::from_value(f64::NAN))
    }

    /// What the normal stress makes of it.
    #[inline]
    fn moved(&self, state: S::State) -> S::State {
        match &self.shift {
            Some(shift) => shift.of(state),
            None => state,
        }
    }

    pub(super) fn coefficient(&self, slip_rate: f64) -> f64 {
        let state = self.state_at(slip_rate);
        self.friction.coefficient(slip_rate, L::State::read(state))
    }

    #[inline]
    pub(super) fn coefficient_and_rate_slope(&self, slip_rate: f64) -> (f64, f64) {
        let Some(step) = self.eliminated else {
            let read = L::State::read(self.vertex.state);
            return self.friction.coefficient_and_rate_slope(slip_rate, read);
        };
        self.following(step, self.advanced(step, slip_rate), slip_rate)
    }

    /// Whether the coefficient, the state following, falls with the slip rate to which the state in use belongs.
    pub(super) fn weakens(&self, step: StateStep, slip_rate: f64) -> bool {
        let advanced = match self.shift {
            None => self.vertex.state,
            Some(_) => self.advanced(step, slip_rate),
        };
        self.following(step, advanced, slip_rate).1 < 0.0
    }

    /// The coefficient and its slope, where the law's own step leads to the state `advanced`.
    #[inline]
    fn following(&self, step: StateStep, advanced: S::State, slip_rate: f64) -> (f64, f64) {
        let state = self.moved(advanced);
        let read = L::State::read(state);
        let response = self.friction.response(slip_rate, read);
        let mut slope = response.rate_slope;
        if response.state_slope != 0.0 {
            let (start, old_rate) = (self.vertex.start, self.vertex.start_rate);
            slope += response.state_slope
                * L::State::slope(state)
                * self
                    .shift
                    .as_ref()
                    .map_or(1.0, |shift| shift.slope(advanced))
                * step.slope(self.evolution, (start, advanced), old_rate, slip_rate);
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
        // Every search starts from the state on the solution that is followed, or from its slip rate. A start from what
        // was found last would be nearer, but where a step has several solutions it may find another one.
        let aim = self.vertex.aim;
        let guess = match self.eliminated {
            None if self.unchecked => aim,
            None => {
                let state = L::State::read(self.vertex.state);
                return self.friction.slip_rate(viscosity, drive, state);
            }
            Some(_) => {
                let state = L::State::read(self.state_at(aim));
                self.friction.slip_rate(viscosity, drive, state)
            }
        };
        balance(viscosity, drive, guess, |rate| {
            self.coefficient_and_rate_slope(rate)
        })
    }
}

#[cfg(test)]
mod tests {
    use stickslip_friction::Nodal;
    use stickslip_state::{LogScale, LogTheta, Theta};

    use super::super::StateUpdate;
    use super::super::normal_stress_effect::NormalStressEffect;
    use super::*;
    use crate::problems::FRICTION;

    /// `theta' = 1 - V theta/L` in `theta` itself.
    struct Aging;

    impl StateLaw for Aging {
        type State = Theta;

        fn evolution(&self, Theta(theta): Theta, slip_rate: f64) -> f64 {
            1.0 - slip_rate * theta / 1e-5
        }

        fn evolution_state_slope(&self, _: Theta, slip_rate: f64) -> f64 {
            -slip_rate / 1e-5
        }
    }

    /// The slope is that of the coefficient, also behind a normal stress that rises by half.
    fn check<S: StateLaw>(evolution: &S, start: S::State)
    where
        S::State: LogScale,
        LogTheta: Reads<S::State>,
    {
        for update in [StateUpdate::BackwardEuler, StateUpdate::Midpoint] {
            let mut effect = NormalStressEffect::new(Nodal::Uniform(0.4));
            assert!(effect.build(1).is_ok());
            let mut vertex = VertexState::at_rest(start);
            let begun = effect.begin(0, start, update, [2e6, 3e6]);
            vertex.start = begun.unwrap_or(start);
            vertex.start_rate = 1e-6;
            let law = VertexLaw {
                friction: &FRICTION,
                evolution,
                vertex: &vertex,
                eliminated: Some(StateStep { dt: 2.0, update }),
                shift: Some(effect.after(0)),
                unchecked: false,
            };
            for rate in [1e-7_f64, 1e-6, 1e-4] {
                let h = 1e-4 * rate;
                let difference = law.coefficient(rate + h) - law.coefficient(rate - h);
                let (coefficient, slope) = law.coefficient_and_rate_slope(rate);
                assert_eq!(coefficient, law.coefficient(rate));
                // The difference keeps h^2/rate^2 of it, and rounding over h.
                let bound = 1e-6 * slope.abs() + 1e-15 / h;
                assert!((difference / (2.0 * h) - slope).abs() < bound, "{rate}");
            }
        }
    }

    #[test]
    fn the_slope_follows_state_and_normal_stress() {
        check(&crate::problems::AGING, LogTheta(2.0));
        check(&Aging, Theta(5.0));
    }
}

//! The laws of a contact: friction and the evolution of its state.

use std::ops::Range;
use std::sync::OnceLock;

use stickslip_core::lanes::LANES;
use stickslip_friction::{FrictionLaw, Nodal, Response, SlipRates};
use stickslip_state::{Evolutions, Reads, StateError, StateLaw, StateVariable};

use super::contact_laws::{ContactLaws, Followed, StateStart, at_least};
use super::normal_stress_effect::NormalStressEffect;
use super::one_by_one;

/// A state after a law's own step, that state after a change of the normal stress, and the slope of this change.
type Stepped<S> = (<S as StateLaw>::State, <S as StateLaw>::State, f64);

/// A friction law with its state law, static for each vertex.
pub(crate) struct RateAndState<L: FrictionLaw, S: StateLaw> {
    friction: Nodal<L>,
    evolution: Nodal<S>,
    effect: Option<NormalStressEffect<S::State>>,
    /// What the laws bring for many vertices, prepared by the first pass over them.
    slip_rates: OnceLock<Option<Box<dyn SlipRates<L::State>>>>,
    evolutions: OnceLock<Option<Box<dyn Evolutions<S::State>>>>,
}

impl<L: FrictionLaw, S: StateLaw> RateAndState<L, S> {
    pub(crate) fn new(
        friction: Nodal<L>,
        evolution: Nodal<S>,
        effect: Option<NormalStressEffect<S::State>>,
    ) -> Self {
        Self {
            slip_rates: OnceLock::new(),
            evolutions: OnceLock::new(),
            friction,
            evolution,
            effect,
        }
    }

    fn slip_rates(&self) -> Option<&dyn SlipRates<L::State>> {
        let prepare = || L::slip_rates(self.friction.iter().as_slice());
        self.slip_rates.get_or_init(prepare).as_deref()
    }

    fn evolutions(&self) -> Option<&dyn Evolutions<S::State>> {
        let prepare = || S::evolutions(self.evolution.iter().as_slice());
        self.evolutions.get_or_init(prepare).as_deref()
    }

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

impl<L: FrictionLaw, S: StateLaw> RateAndState<L, S>
where
    L::State: Reads<S::State>,
{
    /// The state of friction, from the value of the state law's.
    #[inline]
    fn read(state: f64) -> L::State {
        L::State::read(S::State::from_value(state))
    }
}

/// States in the variable of a law, block by block: `work` takes the number of the first one, and the states.
#[inline]
fn in_blocks<T: Copy>(
    states: &[f64],
    read: impl Fn(f64) -> T,
    mut work: impl FnMut(Range<usize>, &[T]),
) {
    let mut block = [read(0.0); LANES];
    for first in (0..states.len()).step_by(LANES) {
        let range = first..states.len().min(first + LANES);
        for (own, state) in block.iter_mut().zip(&states[range.clone()]) {
            *own = read(*state);
        }
        let count = range.len();
        work(range, &block[..count]);
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
        self.friction.at(k).potential(slip_rate, Self::read(state))
    }

    fn slip_rate(&self, k: usize, viscosity: f64, drive: f64, state: f64) -> f64 {
        (self.friction.at(k)).slip_rate(viscosity, drive, Self::read(state))
    }

    fn slip_rates(&self, first: usize, problem: [&[f64]; 3], slip_rates: &mut [f64]) {
        let Some(many) = self.slip_rates() else {
            return one_by_one::slip_rates(self, first, problem, slip_rates);
        };
        let [viscosity, drive, states] = problem;
        in_blocks(states, Self::read, |at, states| {
            let problem = [&viscosity[at.clone()], &drive[at.clone()]];
            many.slip_rates(first + at.start, problem, states, &mut slip_rates[at]);
        });
    }

    fn slopes(&self, first: usize, at: [&[f64]; 2], slopes: [&mut [f64]; 2]) {
        let Some(many) = self.slip_rates() else {
            return one_by_one::slopes(self, first, at, slopes);
        };
        let ([slip_rates, states], [by_rate, by_state]) = (at, slopes);
        in_blocks(states, Self::read, |at, read| {
            let to = [&mut by_rate[at.clone()], &mut by_state[at.clone()]];
            many.slopes(first + at.start, &slip_rates[at.clone()], read, to);
            for (slope, state) in by_state[at.clone()].iter_mut().zip(&states[at]) {
                *slope *= L::State::slope(S::State::from_value(*state));
            }
        });
    }

    fn evolutions(&self, first: usize, at: [&[f64]; 2], rates: &mut [f64]) {
        let Some(many) = self.evolutions() else {
            return one_by_one::evolutions(self, first, at, rates);
        };
        let [slip_rates, states] = at;
        in_blocks(states, S::State::from_value, |at, states| {
            many.evolutions(
                first + at.start,
                states,
                &slip_rates[at.clone()],
                &mut rates[at],
            );
        });
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

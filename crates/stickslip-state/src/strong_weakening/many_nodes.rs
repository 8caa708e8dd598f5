//! Strong rate weakening of many nodes, several of them per instruction.

use stickslip_core::lanes::elementary::{exp, exp_m1, ln};
use stickslip_core::lanes::{LANES, Parameter, Pass, load, run};

use super::{LEAST, StrongWeakening};
use crate::{Evolutions, Psi, StateLaw};

/// The laws of the nodes, or one of all.
pub(super) struct ManyNodes {
    laws: Vec<StrongWeakening>,
    a: Parameter,
    /// `-2/a`.
    twice_per_a: Parameter,
    /// `b - a`.
    fall: Parameter,
    /// `mu0 + (b - a) ln V0`: `f_LV` at 1 m/s.
    at_one: Parameter,
    /// `ln V0` and `ln V_w`.
    ln_reference: Parameter,
    ln_weakening: Parameter,
    weakened: Parameter,
    per_distance: Parameter,
}

impl ManyNodes {
    pub(super) fn new(laws: &[StrongWeakening]) -> Self {
        let of = |value: fn(&StrongWeakening) -> f64| Parameter::new(laws.iter().map(value));
        Self {
            a: of(|law| law.a),
            twice_per_a: of(|law| -2.0 / law.a),
            fall: of(|law| law.b - law.a),
            at_one: of(|law| {
                law.reference_friction + (law.b - law.a) * law.reference_velocity.ln()
            }),
            ln_reference: of(|law| law.reference_velocity.ln()),
            ln_weakening: of(|law| law.weakening_velocity.ln()),
            weakened: of(|law| law.weakened_friction),
            per_distance: of(|law| law.slip_distance.recip()),
            laws: laws.to_vec(),
        }
    }
}

struct Rates<'a> {
    of: &'a ManyNodes,
    /// The number of the first node.
    first: usize,
    states: &'a [Psi],
    slip_rates: &'a [f64],
    rates: &'a mut [f64],
    /// Whether a node is to be computed by itself.
    has_others: &'a mut bool,
}

/// Whether a node is one of the pass: its slip rate is a normal number.
#[inline(always)]
fn is_normal(slip_rate: f64) -> bool {
    (f64::MIN_POSITIVE..=f64::MAX).contains(&slip_rate)
}

impl Pass for Rates<'_> {
    #[inline(always)]
    fn block(&mut self, at: usize, count: usize) {
        let (of, first) = (self.of, self.first + at);
        let mut spare = [None; 9];
        let [
            of_a,
            of_twice,
            of_fall,
            of_one,
            of_v0,
            of_vw,
            of_fw,
            of_l,
            of_rates,
        ] = &mut spare;
        let a = of.a.load(first, of_a);
        let twice_per_a = of.twice_per_a.load(first, of_twice);
        let fall = of.fall.load(first, of_fall);
        let at_one = of.at_one.load(first, of_one);
        let ln_reference = of.ln_reference.load(first, of_v0);
        let ln_weakening = of.ln_weakening.load(first, of_vw);
        let weakened = of.weakened.load(first, of_fw);
        let per_distance = of.per_distance.load(first, of_l);
        let slip_rates = load(&self.slip_rates[at..], of_rates);
        let (mut steady, mut all) = ([0.0; LANES], true);
        for k in 0..LANES {
            let ln_rate = ln(slip_rates[k]);
            let excess = 8.0 * (ln_rate - ln_weakening[k]);
            let (high, size) = if excess > 0.0 {
                (excess, excess)
            } else {
                (0.0, -excess)
            };
            let softplus = high + ln(1.0 + exp(-size));
            let above = at_one[k] - fall[k] * ln_rate - weakened[k];
            let raw = weakened[k] + above * exp(-0.125 * softplus);
            let least = LEAST * a[k];
            let coefficient = if raw < least { least } else { raw };
            let below = -exp_m1(twice_per_a[k] * coefficient);
            steady[k] = coefficient + a[k] * (ln_reference[k] - ln_rate + ln(below));
            all &= is_normal(slip_rates[k]);
        }
        *self.has_others |= !all;
        let nodes = self.states[at..at + count].iter().zip(&steady);
        let rates = self.rates[at..at + count].iter_mut().zip(nodes);
        let factors = slip_rates.iter().zip(per_distance);
        for ((rate, (state, steady)), (slip_rate, per_distance)) in rates.zip(factors) {
            *rate = slip_rate * per_distance * (steady - state.0);
        }
    }
}

impl Evolutions<Psi> for ManyNodes {
    fn evolutions(&self, first: usize, states: &[Psi], slip_rates: &[f64], rates: &mut [f64]) {
        let mut has_others = false;
        let pass = Rates {
            of: self,
            first,
            states,
            slip_rates,
            rates,
            has_others: &mut has_others,
        };
        run(states.len(), pass);
        let nodes = states.iter().zip(slip_rates).enumerate();
        for (k, (state, slip_rate)) in nodes.filter(|_| has_others) {
            if !is_normal(*slip_rate) {
                let law = self.laws.get(first + k).unwrap_or(&self.laws[0]);
                rates[k] = law.evolution(*state, *slip_rate);
            }
        }
    }
}

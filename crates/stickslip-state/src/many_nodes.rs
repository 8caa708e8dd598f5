//! The aging law and the slip law of many nodes, several of them per instruction.

use stickslip_core::lanes::elementary::{exp, ln};
use stickslip_core::lanes::{Parameter, Pass, run};

use crate::{Dieterich, Evolutions, LogTheta, Ruina, StateLaw};

/// Bound of the logarithms whose exponentials are normal numbers.
const NORMAL: f64 = 700.0;

/// The laws of the nodes, or one of all, and `1/L` \[1/m\].
pub(crate) struct ManyNodes<L> {
    laws: Vec<L>,
    per_distance: Parameter,
}

impl<L: Copy> ManyNodes<L> {
    pub(crate) fn new(laws: &[L], slip_distance: impl Fn(&L) -> f64) -> Self {
        Self {
            laws: laws.to_vec(),
            per_distance: Parameter::new(laws.iter().map(|law| slip_distance(law).recip())),
        }
    }

    /// Repeats the nodes of a pass at the ends of the range of numbers by themselves.
    fn repeat(
        &self,
        (first, states): (usize, &[LogTheta]),
        slip_rates: &[f64],
        rates: &mut [f64],
        is_normal: impl Fn(f64, f64) -> bool,
    ) where
        L: StateLaw<State = LogTheta>,
    {
        for (k, (state, rate)) in states.iter().zip(slip_rates).enumerate() {
            if !is_normal(state.0, *rate) {
                let law = self.laws.get(first + k).unwrap_or(&self.laws[0]);
                rates[k] = law.evolution(*state, *rate);
            }
        }
    }
}

/// The states of a pass, their slip rates and rates.
struct States<'a> {
    per_distance: &'a Parameter,
    /// The number of the first node.
    first: usize,
    states: &'a [LogTheta],
    slip_rates: &'a [f64],
    rates: &'a mut [f64],
}

impl States<'_> {
    /// Sets the rates of a block by `(alpha, V/L)`.
    #[inline(always)]
    fn block(&mut self, at: usize, count: usize, law: impl Fn(f64, f64) -> f64) {
        let mut spare = None;
        let per_distance = self.per_distance.load(self.first + at, &mut spare);
        let nodes = self.states[at..at + count]
            .iter()
            .zip(&self.slip_rates[at..at + count]);
        let rates = self.rates[at..at + count].iter_mut().zip(per_distance);
        for ((rate, per_distance), (state, slip_rate)) in rates.zip(nodes) {
            *rate = law(state.0, slip_rate * per_distance);
        }
    }
}

struct Aging<'a>(States<'a>);

impl Pass for Aging<'_> {
    #[inline(always)]
    fn block(&mut self, first: usize, count: usize) {
        (self.0).block(first, count, |alpha, rate| exp(-alpha) - rate);
    }
}

impl Evolutions<LogTheta> for ManyNodes<Dieterich> {
    fn evolutions(&self, first: usize, states: &[LogTheta], slip_rates: &[f64], rates: &mut [f64]) {
        let pass = Aging(States {
            per_distance: &self.per_distance,
            first,
            states,
            slip_rates,
            rates,
        });
        run(states.len(), pass);
        let is_normal = |alpha: f64, _| alpha.abs() < NORMAL;
        self.repeat((first, states), slip_rates, rates, is_normal);
    }
}

struct Slip<'a>(States<'a>);

impl Pass for Slip<'_> {
    #[inline(always)]
    fn block(&mut self, first: usize, count: usize) {
        (self.0).block(first, count, |alpha, rate| -rate * (alpha + ln(rate)));
    }
}

impl Evolutions<LogTheta> for ManyNodes<Ruina> {
    fn evolutions(&self, first: usize, states: &[LogTheta], slip_rates: &[f64], rates: &mut [f64]) {
        let pass = Slip(States {
            per_distance: &self.per_distance,
            first,
            states,
            slip_rates,
            rates,
        });
        run(states.len(), pass);
        // The logarithm is that of normal numbers.
        let normal = (-NORMAL).exp()..NORMAL.exp();
        let is_normal = |_, rate: f64| normal.contains(&rate);
        self.repeat((first, states), slip_rates, rates, is_normal);
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    /// The passes of laws, one for all nodes or one each, against each node by itself.
    fn check<L: StateLaw<State = LogTheta> + Copy>(
        laws: &[L],
        distances: &[f64],
        (nodes, first): (&[(f64, f64)], usize),
    ) -> Result<(), TestCaseError> {
        let states: Vec<_> = nodes.iter().map(|node| LogTheta(node.0)).collect();
        let slip_rates: Vec<_> = nodes.iter().map(|node| node.1).collect();
        let mut rates = vec![0.0; nodes.len() - first];
        let many = L::evolutions(laws).expect("passes");
        many.evolutions(first, &states[first..], &slip_rates[first..], &mut rates);
        for (k, rate) in (first..).zip(rates) {
            let law = laws.get(k).unwrap_or(&laws[0]);
            let each = law.evolution(states[k], slip_rates[k]);
            // The terms of both laws; the logarithm of V/L rounds with its argument.
            let per_time = slip_rates[k] / distances.get(k).unwrap_or(&distances[0]);
            let log = if per_time > 0.0 {
                per_time.ln().abs()
            } else {
                0.0
            };
            let largest = (-states[k].0).exp() + per_time * (2.0 + states[k].0.abs() + log);
            prop_assert!(
                rate == each || (rate - each).abs() <= 8.0 * f64::EPSILON * largest,
                "{k}: {rate:e} {each:e}"
            );
        }
        Ok(())
    }

    fn nodes() -> impl Strategy<Value = Vec<(f64, f64, f64)>> {
        let alpha = prop_oneof![-30.0..30.0, -800.0..800.0];
        let rate = prop_oneof![
            (-60.0..5.0).prop_map(f64::exp),
            (-745.0..200.0).prop_map(f64::exp),
            Just(0.0)
        ];
        prop::collection::vec((alpha, rate, (-14.0..0.0).prop_map(f64::exp)), 1..200)
    }

    proptest! {
        #[test]
        fn passes_are_the_laws_of_each_node(nodes in nodes(), at in any::<prop::sample::Index>(), one in any::<bool>()) {
            let count = if one { 1 } else { nodes.len() };
            let distances: Vec<_> = nodes[..count].iter().map(|node| node.2).collect();
            let first = at.index(nodes.len());
            let nodes: Vec<_> = nodes.iter().map(|node| (node.0, node.1)).collect();
            let aging: Vec<_> = distances.iter().map(|&slip_distance| Dieterich { slip_distance }).collect();
            check(&aging, &distances, (&nodes, first))?;
            let slip: Vec<_> = distances.iter().map(|&slip_distance| Ruina { slip_distance }).collect();
            check(&slip, &distances, (&nodes, first))?;
        }
    }
}

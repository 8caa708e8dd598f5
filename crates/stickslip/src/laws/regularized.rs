//! Regularised friction behind erased types, for integrators that compute many cells at once.

use std::any::Any;

use stickslip_friction::{EvolutionLaw, Nodal, RegularizedDieterichRuina};
use stickslip_state::{Dieterich, Ruina, StateLaw};

use super::contact_laws::{ContactLaws, RateAndState};

/// The laws of `count` cells, if all of them are regularised friction with the aging law or the slip law.
pub(crate) fn regularized(
    laws: &dyn ContactLaws,
    count: usize,
) -> Option<(Vec<RegularizedDieterichRuina>, EvolutionLaw)> {
    let aging = of_state_law(laws, count, |law: &Dieterich| law.slip_distance);
    if let Some(aging) = aging {
        return Some((aging, EvolutionLaw::Aging));
    }
    let slip = of_state_law(laws, count, |law: &Ruina| law.slip_distance);
    Some((slip?, EvolutionLaw::Slip))
}

/// The friction laws, if the state law is an `S` with the slip distances of friction.
fn of_state_law<S: StateLaw + 'static>(
    laws: &dyn ContactLaws,
    count: usize,
    slip_distance: impl Fn(&S) -> f64,
) -> Option<Vec<RegularizedDieterichRuina>> {
    let laws: &dyn Any = laws;
    let RateAndState {
        friction,
        evolution,
        effect: None,
    } = laws.downcast_ref::<RateAndState<RegularizedDieterichRuina, S>>()?
    else {
        return None;
    };
    let (friction, evolution): (&Nodal<_>, &Nodal<S>) = (friction, evolution);
    let one = |k: usize| {
        let law = friction.at(k);
        (law.slip_distance == slip_distance(evolution.at(k))).then_some(*law)
    };
    (0..count).map(one).collect()
}

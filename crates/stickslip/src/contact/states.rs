//! What a step does with the states of all contacts.

use nalgebra::SVector;
use stickslip_friction::modulus;

use super::{Beginning, ContactSet, StateStep};
use crate::StepError;
use crate::step::reduction::sum;
use crate::step::state::ContactState;

/// The difference of the forces, as a share of friction, that no one doubts.
const CLOSE: f64 = 1e-8;
/// The tolerances by which a velocity may be off at a vertex.
const DOUBTS: f64 = 4.0;

impl<const C: usize> ContactSet<C> {
    /// Begins a step from the states and velocities of the last one, with the normal stress of the new time.
    pub(crate) fn begin(
        &mut self,
        step: StateStep,
        time: f64,
        from: &[ContactState<C>],
        velocity: &[SVector<f64, C>],
    ) -> Result<(), StepError> {
        for (contact, from) in self.contacts.iter_mut().zip(from) {
            contact.set_time(time)?;
            for k in 0..contact.rates.len() {
                contact.rates[k] = contact.slip_rate(k, velocity);
            }
            for changes in &mut contact.changes {
                changes.fill(0.0);
            }
            let from = Beginning {
                states: &from.states,
                rates: &contact.rates,
                normal_stress: [&from.normal_stress, &contact.normal_stress],
            };
            let begun = contact.interface.begin(step, from);
            begun.map_err(|unloaded| contact.unloaded(unloaded))?;
        }
        Ok(())
    }

    /// Takes back what the normal stress has made of states since `old`, and the normal stress itself: stages of
    /// one step are combined where it is the same.
    pub(crate) fn unload(
        &self,
        now: &mut [ContactState<C>],
        old: &[ContactState<C>],
    ) -> Result<(), StepError> {
        let states = now.iter_mut().zip(old);
        for (contact, (now, old)) in self.contacts.iter().zip(states) {
            if !contact.interface.follows_normal_stress() {
                continue;
            }
            for (k, state) in now.states.iter_mut().enumerate() {
                let back = [now.normal_stress[k], old.normal_stress[k]];
                let moved = contact.interface.moved(k, *state, back);
                (*state, _) = moved.map_err(|unloaded| contact.unloaded(unloaded))?;
            }
            now.normal_stress.copy_from_slice(&old.normal_stress);
        }
        Ok(())
    }

    /// Begins every search near these velocities.
    pub(crate) fn aim(&mut self, velocity: &[SVector<f64, C>]) {
        for contact in &mut self.contacts {
            for k in 0..contact.rates.len() {
                contact.rates[k] = contact.slip_rate(k, velocity);
            }
            contact.interface.aim(&contact.rates);
        }
    }

    /// Lets the states follow the slip rates, or freezes those in use again.
    pub(crate) fn eliminate(&mut self, eliminated: bool) {
        for contact in &mut self.contacts {
            contact.interface.eliminate(eliminated);
        }
    }

    /// The states that belong to these velocities; returns the square of how far they lie from those in use, in `L2`
    /// of the contacts.
    pub(crate) fn propose(&mut self, velocity: &[SVector<f64, C>]) -> Result<f64, StepError> {
        for contact in &mut self.contacts {
            for k in 0..contact.rates.len() {
                contact.rates[k] = contact.slip_rate(k, velocity);
            }
            contact.changes.swap(0, 1);
            let [_, changes] = &mut contact.changes;
            if changes.is_empty() {
                continue;
            }
            let proposed = contact.interface.propose(&contact.rates, changes);
            proposed.map_err(|stuck| StepError::State {
                vertex: contact.part.vertices[stuck.place],
                slip_rate: stuck.slip_rate,
                source: stuck.source,
            })?;
        }
        Ok(sum(self
            .weighted_changes()
            .map(|(w, [_, now])| w * now * now)))
    }

    /// Moves the states in use towards those proposed.
    pub(crate) fn relax(&mut self, relaxation: f64) {
        for contact in &mut self.contacts {
            contact.interface.relax(relaxation);
        }
    }

    /// `d'.(d - d')` and `|d - d'|^2` of the last two changes proposed, `d` the latest, in `L2`.
    pub(crate) fn secant_products(&self) -> [f64; 2] {
        let difference = |[before, now]: [f64; 2]| now - before;
        let along = sum(self
            .weighted_changes()
            .map(|(w, d)| w * d[0] * difference(d)));
        let square = sum(self
            .weighted_changes()
            .map(|(w, d)| w * difference(d) * difference(d)));
        [along, square]
    }

    /// The area of each vertex with a state, and its last two changes.
    fn weighted_changes(&self) -> impl Iterator<Item = (f64, [f64; 2])> {
        self.contacts.iter().flat_map(|contact| {
            let [before, now] = &contact.changes;
            (contact.part.weights.iter())
                .zip(before.iter().zip(now))
                .map(|(&weight, (&before, &now))| (weight, [before, now]))
        })
    }

    /// The number of vertices of contacts at which friction, its state following, weakens with the slip rate; the states
    /// in use are those that belong to these velocities.
    pub(crate) fn weakening(&self, velocity: &[SVector<f64, C>]) -> usize {
        let contacts = self.contacts.iter();
        contacts
            .filter(|contact| contact.interface.may_weaken())
            .map(|contact| {
                let places = 0..contact.part.vertices.len();
                places
                    .filter(|&k| {
                        let rate = contact.slip_rate(k, velocity);
                        contact.normal_stress[k] > 0.0 && contact.interface.weakens(k, rate)
                    })
                    .count()
            })
            .sum()
    }

    /// Writes what is in use at the end of a step.
    pub(crate) fn accept(&self, into: &mut [ContactState<C>]) {
        for (contact, into) in self.contacts.iter().zip(into) {
            for (k, state) in into.states.iter_mut().enumerate() {
                *state = contact.interface.state(k);
            }
            into.normal_stress.copy_from_slice(&contact.normal_stress);
        }
    }

    /// Whether friction balances `left` at the frictional vertex number `k`, for a slip rate and a state that are
    /// known up to what an error of the velocity by `doubt` makes of them, and up to a force `slack`.
    pub(crate) fn is_balanced(
        &self,
        k: usize,
        velocity: &SVector<f64, C>,
        left: &SVector<f64, C>,
        (doubt, slack): (f64, f64),
    ) -> bool {
        let slip = self.slip_velocity(k, velocity);
        let rate = modulus(&slip);
        let pull = modulus(&self.slip_velocity(k, left));
        let strength = self.friction(k, rate);
        // The usual case, by one evaluation.
        if (pull - strength).abs() <= CLOSE * strength.abs() + slack {
            return true;
        }
        let doubt = DOUBTS * (doubt + f64::EPSILON * rate);
        let [low, high] = [(rate - doubt).max(0.0), rate + doubt];
        // A law without a closed form may jump where slip begins; that is no lag.
        let lag = self.lag(k, [low.max(0.5 * high), high]);
        let weakest = self.friction(k, low) - lag - slack;
        let strongest = self.friction(k, high) + lag + slack;
        pull <= strongest && (pull >= weakest || rate <= doubt)
    }

    /// By how much friction at a frictional vertex changes with the states that belong to two slip rates.
    fn lag(&self, k: usize, rates: [f64; 2]) -> f64 {
        self.shares_of(k)
            .map(|(contact, place)| {
                let interface = &contact.interface;
                let Some([slow, fast]) = interface.proposals(place, rates) else {
                    return 0.0;
                };
                let at = |rate: f64, state: f64| interface.response(place, rate, state).coefficient;
                let change = |rate: f64| (at(rate, fast) - at(rate, slow)).abs();
                let normal = contact.part.weights[place] * contact.normal_stress[place];
                normal * change(rates[0]).max(change(rates[1]))
            })
            .sum()
    }

    /// Freezes the states of an accepted step.
    pub(crate) fn use_states(&mut self, states: &[ContactState<C>]) {
        for (contact, from) in self.contacts.iter_mut().zip(states) {
            for (k, &state) in from.states.iter().enumerate() {
                contact.interface.set_state(k, state);
            }
        }
    }

    /// Puts the normal stresses of an accepted step in force.
    pub(crate) fn set_normal_stress(&mut self, states: &[ContactState<C>]) {
        for (contact, state) in self.contacts.iter_mut().zip(states) {
            contact.set_normal_stress(&state.normal_stress);
        }
    }

    /// Adds what contacts exert beside friction.
    pub(crate) fn add_tractions(&self, with_shear: bool, load: &mut [SVector<f64, C>]) {
        for contact in &self.contacts {
            contact.add_tractions(with_shear, load);
        }
    }
}

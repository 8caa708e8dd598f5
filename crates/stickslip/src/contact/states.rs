//! The states of all contacts during a step.

use nalgebra::SVector;

use super::ContactSet;
use crate::laws::StateStep;
use crate::sums::sum;
use crate::{ContactState, StepError, StepState};

impl<const C: usize> ContactSet<C> {
    /// Begins a step from the states of the last one and its velocities, with the normal stress of the new time.
    pub(crate) fn begin(
        &mut self,
        step: StateStep,
        time: f64,
        from: &StepState<C>,
        velocity: impl Fn(usize) -> SVector<f64, C> + Sync,
    ) -> Result<(), StepError> {
        self.take_normal_stresses(time, from);
        self.set_time(time)?;
        self.begin_states(step, &from.contacts, velocity)
    }

    /// Begins a step again, with other normal stresses from the deformation.
    pub(crate) fn begin_again(
        &mut self,
        step: StateStep,
        time: f64,
        from: &[ContactState<C>],
        velocity: impl Fn(usize) -> SVector<f64, C> + Sync,
    ) -> Result<(), StepError> {
        self.set_time(time)?;
        self.begin_states(step, from, velocity)
    }

    fn begin_states(
        &mut self,
        step: StateStep,
        from: &[ContactState<C>],
        velocity: impl Fn(usize) -> SVector<f64, C> + Sync,
    ) -> Result<(), StepError> {
        for (contact, from) in self.contacts.iter_mut().zip(from) {
            let rates = contact.rates_of(&velocity);
            for changes in contact.changes.iter_mut().flatten() {
                changes.fill(0.0);
            }
            let stress = [&*from.normal_stress, &*contact.normal_stress];
            let read = rates.as_deref().unwrap_or_default();
            let begun = (contact.trial).begin(step, (&from.states, read), stress);
            contact.rates = rates;
            begun.map_err(|vanished| contact.vanished(vanished, &from.normal_stress))?;
        }
        Ok(())
    }

    /// Reverts the effect of the normal stress on states since `old`, and the normal stress itself: stages of one step
    /// are combined at equal normal stress.
    pub(crate) fn unload(
        &self,
        now: &mut [ContactState<C>],
        old: &[ContactState<C>],
    ) -> Result<(), StepError> {
        let states = now.iter_mut().zip(old);
        for (contact, (now, old)) in self.contacts.iter().zip(states) {
            if !contact.trial.follows_normal_stress() {
                continue;
            }
            for (k, state) in now.states.iter_mut().enumerate() {
                let back = [now.normal_stress[k], old.normal_stress[k]];
                (*state, _) = contact.moved(k, *state, back)?;
            }
            now.normal_stress.copy_from_slice(&old.normal_stress);
        }
        Ok(())
    }

    /// Condenses the states into the velocity problem, or freezes those in use again.
    pub(crate) fn eliminate(&mut self, eliminated: bool) {
        for contact in &mut self.contacts {
            contact.trial.eliminate(eliminated);
        }
    }

    /// Proposes the states of these velocities; returns the square of their distance from those in use, in `L2` of the
    /// contacts.
    pub(crate) fn propose(&mut self, velocity: &[SVector<f64, C>]) -> Result<f64, StepError> {
        for contact in &mut self.contacts {
            contact.rates = contact.rates_of(|vertex| velocity[vertex]);
            let (Some(rates), Some(changes)) = (&contact.rates, &mut contact.changes) else {
                continue;
            };
            changes.swap(0, 1);
            let proposed = contact.trial.propose(rates, &mut changes[1]);
            proposed.map_err(|(k, refused)| contact.refused(k, refused))?;
        }
        Ok(sum(self
            .weighted_changes()
            .map(|(w, [_, now])| w * now * now)))
    }

    /// Moves the states in use towards the proposed ones.
    pub(crate) fn relax(&mut self, relaxation: f64) {
        for contact in &mut self.contacts {
            contact.trial.relax(relaxation);
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
            contact.changes.iter().flat_map(|[before, now]| {
                (contact.part.weights.iter())
                    .zip(before.iter().zip(now))
                    .map(|(&weight, (&before, &now))| (weight, [before, now]))
            })
        })
    }

    /// Writes the quantities in use at the end of a step.
    pub(crate) fn accept(&self, into: &mut [ContactState<C>]) {
        self.accept_fields(into);
        for (contact, into) in self.contacts.iter().zip(into) {
            for (k, state) in into.states.iter_mut().enumerate() {
                *state = contact.trial.state(k);
            }
            into.normal_stress.copy_from_slice(&contact.normal_stress);
            if let Some(body) = contact
                .body
                .as_ref()
                .filter(|own| !own.unrelaxed.is_empty())
            {
                into.relaxed_stress.copy_from_slice(&body.trial);
                into.body_stress.copy_from_slice(&body.unrelaxed);
            }
        }
    }

    /// Freezes the states of an accepted step, under the normal stresses of a time \[s\].
    pub(crate) fn use_states(&mut self, time: f64, state: &StepState<C>) -> Result<(), StepError> {
        self.hold_fields(state);
        self.take_normal_stresses(time, state);
        self.set_time(time)?;
        for (contact, from) in self.contacts.iter_mut().zip(&state.contacts) {
            for (k, &state) in from.states.iter().enumerate() {
                contact.trial.states_mut()[k] = state;
            }
        }
        Ok(())
    }

    /// Adds the tractions of contacts beside friction, with the normal stresses in force.
    pub(crate) fn add_tractions(&self, load: &mut [SVector<f64, C>]) {
        for contact in &self.contacts {
            contact.add_tractions(|k| contact.total_normal_stress(k), true, load);
        }
    }

    /// The same on a body of so many vertices, if all contacts are bilateral, so that normal stresses do not load the
    /// body; else empty.
    pub(crate) fn constant_tractions(&self, size: usize) -> Vec<SVector<f64, C>> {
        let mut contacts = self.contacts.iter();
        if !contacts.all(|contact| contact.bilateral && contact.opening.is_none()) {
            return Vec::new();
        }
        let mut tractions = vec![SVector::zeros(); size];
        self.add_tractions(&mut tractions);
        tractions
    }

    /// The same with the normal stresses of an accepted step.
    pub(crate) fn add_tractions_of(
        &self,
        states: &[ContactState<C>],
        load: &mut [SVector<f64, C>],
    ) {
        for (contact, state) in self.contacts.iter().zip(states) {
            contact.add_tractions(|k| state.total_normal_stress(k), true, load);
            contact.add_reactions(state.exerted_stress(), load);
        }
    }
}

//! The states of contacts at a stage.

use crate::contact::{ContactSet, DiscreteContact};
use crate::{ContactState, StepError, StepState};

/// The state under the normal stress in force, from that of an accepted step, and its derivative in the latter.
#[inline]
pub(super) fn moved<const C: usize>(
    (contact, accepted): (&DiscreteContact<C>, &[f64]),
    k: usize,
    state: f64,
) -> Result<(f64, f64), StepError> {
    contact.moved(k, state, [accepted[k], contact.normal_stress[k]])
}

/// The contacts with the first numbers of their states in the list of all states.
pub(super) fn numbered<'a, const C: usize>(
    contacts: &'a ContactSet<C>,
    state: &'a StepState<C>,
) -> impl Iterator<Item = (&'a DiscreteContact<C>, &'a ContactState<C>, usize)> {
    let mut first = 0;
    let contacts = contacts.contacts.iter().zip(&state.contacts);
    contacts.map(move |(contact, at)| {
        let begin = first;
        first += at.states.len();
        (contact, at, begin)
    })
}

/// Freezes the states of a stage, stored as under the normal stresses of an accepted step: in this form they are independent
/// of the normal stress. Where they follow it, `moved_by` is the derivative of the state in force in the one stored.
pub(super) fn freeze<const C: usize>(
    contacts: &mut ContactSet<C>,
    accepted: &StepState<C>,
    states: &[f64],
    moved_by: &mut [f64],
) -> Result<(), StepError> {
    let mut first = 0;
    for (contact, at) in contacts.contacts.iter_mut().zip(&accepted.contacts) {
        let range = first..first + at.states.len();
        first = range.end;
        if contact.trial.follows_normal_stress() {
            for (k, n) in range.enumerate() {
                let (state, by) = moved((contact, &at.normal_stress), k, states[n])?;
                contact.trial.states_mut()[k] = state;
                moved_by[n] = by;
            }
        } else {
            let states = &states[range];
            contact.trial.states_mut()[..states.len()].copy_from_slice(states);
        }
    }
    Ok(())
}

//! The fields of contacts during a step.

use nalgebra::SVector;
use stickslip_friction::modulus;

use super::{Balanced, Place};
use crate::contact::{ContactSet, DiscreteContact};
use crate::{ContactState, StepError, StepState};

impl<const C: usize> DiscreteContact<C> {
    /// Shows the fields slip rates, with the states in use or those of an accepted step and its time.
    pub(super) fn show_fields(
        &mut self,
        rate: impl Fn(&Self, usize) -> f64,
        from: Option<(&ContactState<C>, f64)>,
    ) {
        // Fields without sources look at nothing.
        let fed = self.fields.as_ref().is_some_and(|fields| fields.are_fed());
        let Some(mut fields) = self.fields.take_if(|_| fed) else {
            return;
        };
        let laws = self.trial.laws();
        for k in 0..self.part.vertices.len() {
            let rate = rate(self, k);
            let (state, stress, coefficient) = match from {
                None => {
                    let (coefficient, _) = self.trial.coefficient_and_rate_slope(k, rate);
                    let state = if self.trial.has_state() {
                        self.trial.state(k)
                    } else {
                        0.0
                    };
                    (state, self.normal_stress[k], coefficient)
                }
                Some((from, time)) => {
                    let state = from.states.get(k).copied().unwrap_or_default();
                    let coefficient = self.response_at(time, k, rate, state).coefficient;
                    (state, from.normal_stress[k], coefficient)
                }
            };
            let shown = &mut fields.shown;
            shown.slip_rate[k] = rate;
            shown.normal_stress[k] = stress;
            shown.friction[k] = self.cohesion(k) + coefficient * stress;
            shown.state_rate[k] = if self.trial.has_state() {
                laws.evolution(k, rate, state)
            } else {
                0.0
            };
        }
        self.fields = Some(fields);
    }

    /// Shows the fields slip rates with the friction that balances what viscosity leaves of the forces.
    pub(super) fn show_balanced(
        &mut self,
        (velocity, evolutions): (&[SVector<f64, C>], &[f64]),
        at: Balanced<'_, C>,
    ) {
        let fed = self.fields.as_ref().is_some_and(|fields| fields.are_fed());
        let Some(mut fields) = self.fields.take_if(|_| fed) else {
            return;
        };
        let shown = &mut fields.shown;
        shown.normal_stress.copy_from_slice(&self.normal_stress);
        for (k, &vertex) in self.part.vertices.iter().enumerate() {
            let rate = modulus(&velocity[vertex]);
            shown.slip_rate[k] = rate;
            let (area, borne) = (
                self.part.weights[k],
                modulus(&at.forces[vertex]) - at.resistance[k] * rate,
            );
            // A copy without an area bears nothing.
            shown.friction[k] = if area > 0.0 { borne / area } else { 0.0 };
        }
        if self.trial.follows_normal_stress() {
            // Those of a stage are as under the normal stress of its start.
            let at = [&shown.slip_rate[..], self.trial.states()];
            self.trial.laws().evolutions(0, at, &mut shown.state_rate);
        } else if self.trial.has_state() {
            shown.state_rate.copy_from_slice(evolutions);
        }
        self.fields = Some(fields);
    }

    /// The pore pressure in force at vertex number `k` \[Pa\]; 0 without fields.
    pub(crate) fn pore_pressure(&self, k: usize) -> f64 {
        (self.fields.as_ref()).map_or(0.0, |fields| fields.pressure[k])
    }
}

impl<const C: usize> ContactSet<C> {
    /// Whether any contact has fields.
    pub(crate) fn have_fields(&self) -> bool {
        self.contacts.iter().any(|contact| contact.fields.is_some())
    }

    /// Puts the pore pressures of a state in force.
    pub(crate) fn hold_fields(&mut self, from: &StepState<C>) {
        for (contact, from) in self.contacts.iter_mut().zip(&from.contacts) {
            if let Some(fields) = &mut contact.fields {
                fields.hold(&from.fields);
            }
        }
    }

    /// Begins a step of the fields by `dt` from a state, and puts the pore pressures of sources as at its start in force.
    pub(crate) fn begin_fields(&mut self, from: &StepState<C>, dt: f64) -> Result<(), StepError> {
        self.hold_fields(from);
        for (contact, at) in self.contacts.iter_mut().zip(&from.contacts) {
            let now = Some((at, from.clock.time()));
            contact.show_fields(|own, k| own.slip_rate(k, &from.velocity), now);
            if let Some(fields) = &mut contact.fields {
                fields.dt = dt;
                fields.start.clone_from(&at.fields);
                fields.find_sources(from.clock.time(), Place::Start);
                fields.find_sources(from.clock.time(), Place::End);
                fields.advance_from_start()?;
            }
        }
        Ok(())
    }

    /// Advances the fields with the sources of these velocities at the end of the step.
    pub(crate) fn end_fields(
        &mut self,
        time: f64,
        velocity: &[SVector<f64, C>],
    ) -> Result<(), StepError> {
        for contact in &mut self.contacts {
            contact.show_fields(|own, k| own.slip_rate(k, velocity), None);
            if let Some(fields) = &mut contact.fields {
                fields.find_sources(time, Place::End);
                fields.advance_from_start()?;
            }
        }
        Ok(())
    }

    /// Writes memories and pressures of the end of a step.
    pub(crate) fn accept_fields(&self, into: &mut [ContactState<C>]) {
        for (contact, into) in self.contacts.iter().zip(into) {
            let Some(fields) = &contact.fields else {
                continue;
            };
            for (memory, field) in into.fields.iter_mut().zip(&fields.fields) {
                memory.copy_from_slice(&field.memory);
            }
            into.pore_pressure.copy_from_slice(&fields.pressure);
            into.excess_pressure.copy_from_slice(&fields.excess);
        }
    }

    /// Exchanges the memories of the last two states of an explicit method for those of its last stage; none is copied.
    pub(crate) fn turn_memories(&mut self, last: &mut StepState<C>, now: &mut StepState<C>) {
        let states = last.contacts.iter_mut().zip(&mut now.contacts);
        for (contact, (last, now)) in self.contacts.iter_mut().zip(states) {
            let Some(fields) = &mut contact.fields else {
                continue;
            };
            std::mem::swap(&mut last.fields, &mut now.fields);
            for (field, memory) in fields.fields.iter_mut().zip(&mut now.fields) {
                std::mem::swap(&mut field.memory, memory);
            }
            now.pore_pressure.copy_from_slice(&fields.pressure);
            now.excess_pressure.copy_from_slice(&fields.excess);
        }
    }

    /// The number of vertices at the least normal stress of their contact, or opened by pore pressure.
    pub(crate) fn at_least_normal_stress(&self) -> usize {
        let contacts = self.contacts.iter();
        let counts = contacts.map(|contact| match (contact.strength.least, &contact.fields) {
            (Some(least), _) => count(&contact.normal_stress, |stress| stress <= least),
            (None, Some(fields)) => count(&fields.excess, |excess| excess > 0.0),
            (None, None) => 0,
        });
        counts.sum()
    }

    /// The number of vertices at the largest normal stress of their contact.
    pub(crate) fn at_largest_normal_stress(&self) -> usize {
        let limited = self
            .contacts
            .iter()
            .filter_map(|contact| Some((contact, contact.strength.largest?)));
        let counts = limited
            .map(|(contact, largest)| count(&contact.normal_stress, |stress| stress >= largest));
        counts.sum()
    }
}

fn count(values: &[f64], counts: impl Fn(f64) -> bool) -> usize {
    values.iter().filter(|&&value| counts(value)).count()
}

//! The fields of contacts at the stages of an explicit method.

use nalgebra::SVector;

use super::{Balanced, Field, Fields, Place};
use crate::contact::ContactSet;
use crate::{StepError, StepState};

impl<const C: usize> ContactSet<C> {
    /// Finds the sources of a stage of an explicit method, with its states in use, from velocities and the rates of all
    /// states. `balanced` tells the balance of the contact with this number, if it is one for all of its vertices.
    pub(crate) fn find_stage_sources<'a>(
        &mut self,
        (stage, stages): (usize, usize),
        time: f64,
        (velocity, mut evolutions): (&[SVector<f64, C>], &[f64]),
        balanced: impl Fn(usize) -> Option<Balanced<'a, C>>,
    ) {
        for (number, contact) in self.contacts.iter_mut().enumerate() {
            let (own, others) = evolutions.split_at(contact.state_count());
            evolutions = others;
            match balanced(number) {
                Some(balanced) => contact.show_balanced((velocity, own), balanced),
                None => contact.show_fields(|own, k| own.slip_rate(k, velocity), None),
            }
            if let Some(fields) = &mut contact.fields {
                for field in &mut fields.fields {
                    if field.stages.is_empty() {
                        field.stages = vec![field.sources[0].clone(); stages];
                    }
                }
                fields.find_sources(time, Place::Stage(stage));
            }
        }
    }

    /// Makes the sources of the last stage those of the first.
    pub(crate) fn turn_stage_sources(&mut self) {
        for fields in self
            .contacts
            .iter_mut()
            .filter_map(|own| own.fields.as_mut())
        {
            for field in &mut fields.fields {
                let last = field.stages.len().saturating_sub(1);
                field.stages.swap(0, last);
            }
        }
    }

    /// Advances the fields from a state to the next stage of a step of `dt`, with the source there that the `weights` of
    /// the stages before make: linear in time, and exact for sources that are. The memories are those of the stage at
    /// the last one, which ends the step.
    ///
    /// ```text
    /// s* = s_0 + (2/c) sum of a_j (s_j - s_0)
    /// ```
    pub(crate) fn advance_to_stage(
        &mut self,
        from: &StepState<C>,
        weights: &[f64],
        nodes: &[f64],
        dt: f64,
    ) -> Result<(), StepError> {
        let (stage, node) = (weights.len(), nodes[weights.len()]);
        for (contact, from) in self.contacts.iter_mut().zip(&from.contacts) {
            let Some(fields) = &mut contact.fields else {
                continue;
            };
            if stage == 1 {
                fields.find_known(&from.fields, &nodes[1..], dt)?;
            }
            for field in &mut fields.fields {
                field.combine(weights, 2.0 / node);
            }
            if stage + 1 == nodes.len() {
                fields.advance(&from.fields, node * dt)?;
            } else {
                fields.find_pressure(&from.fields, node * dt, stage - 1)?;
            }
        }
        Ok(())
    }

    /// Adds the error of the pore pressure in a step between two states, with its sign, to the change of the normal stress at
    /// each vertex of the body.
    ///
    /// It has two parts: that of the embedded method, by its `difference` of weights, and that of a source which curves
    /// while the memory relaxes. The linear source has the integral of the step, and so ends by `d = s* - s` beside the
    /// true one; a curvature `b` makes `d = -b dt^2/3` and an error `A b dt^4/36` of the memory, half of what relaxes from
    /// a source that goes from `-d` to `d`. A field whose advance is not exact adds its own.
    pub(crate) fn add_pressure_error(
        &mut self,
        [difference, last]: [&[f64]; 2],
        [from, to]: [&StepState<C>; 2],
        change: &mut [f64],
    ) {
        let (dt, ends) = (to.last_step, from.contacts.iter().zip(&to.contacts));
        for (contact, (from, to)) in self.contacts.iter_mut().zip(ends) {
            let Some(fields) = &mut contact.fields else {
                continue;
            };
            let Fields {
                fields,
                pressure,
                off,
                ..
            } = &mut **fields;
            off.fill(0.0);
            let memories = from.fields.iter().zip(&to.fields);
            for (field, (start, memory)) in fields.iter_mut().zip(memories) {
                let [begin, end] = &field.sources;
                (field.law).error(start, [begin, end], dt, memory, off);
                // A field without sources has no other error.
                if begin.is_empty() {
                    field.law.pressure(memory, off);
                    continue;
                }
                field.add_error(difference, last);
                let [begin, end] = &field.sources;
                let missed = &mut field.missed;
                missed.resize(memory.len(), 0.0);
                let found = (field.law).pressure_after(start, [begin, end], dt, off, missed);
                if found.is_err() {
                    field.law.pressure(memory, off);
                }
            }
            for (k, &vertex) in contact.part.vertices.iter().enumerate() {
                change[vertex] -= off[k] - pressure[k];
            }
        }
    }
}

impl Fields {
    /// Advances the fields without sources to the end of a step, with their pressures at the nodes of its later stages.
    fn find_known(&mut self, from: &[Vec<f64>], nodes: &[f64], dt: f64) -> Result<(), StepError> {
        let count = self.pressure.len();
        for (number, (field, start)) in self.fields.iter_mut().zip(from).enumerate() {
            if !field.sources[0].is_empty() {
                continue;
            }
            if field.known.is_empty() {
                field.known = vec![vec![0.0; count]; nodes.len()];
            }
            for pressure in &mut field.known {
                pressure.fill(0.0);
            }
            let (known, memory) = (&mut field.known, &mut field.memory);
            (field.law)
                .pressures_within(start, dt, nodes, known, memory)
                .map_err(|source| StepError::Field {
                    field: number,
                    source,
                })?;
        }
        Ok(())
    }
}

impl Field {
    /// Adds to the sources of the step those of its error.
    fn add_error(&mut self, difference: &[f64], last: &[f64]) {
        let [begin, end] = &mut self.sources;
        let [first, .., true_end] = &self.stages[..] else {
            return;
        };
        let [curved, off] = &mut self.sums;
        add_up(last, &self.stages, curved);
        add_up(difference, &self.stages, off);
        for (n, (begin, end)) in begin.iter_mut().zip(end).enumerate() {
            let curved = first[n] + 2.0 * curved[n] - true_end[n];
            *begin -= 0.5 * curved;
            *end += 2.0 * off[n] + 0.5 * curved;
        }
    }

    /// Sets the sources of the step to that of the first stage and one that the stages make.
    fn combine(&mut self, weights: &[f64], factor: f64) {
        let [begin, end] = &mut self.sources;
        let Some(first) = self.stages.first() else {
            return;
        };
        begin.copy_from_slice(first);
        add_up(weights, &self.stages, end);
        for (end, first) in end.iter_mut().zip(first) {
            *end = first + factor * *end;
        }
    }
}

/// The sum of the differences of sources from those of the first stage, with these weights.
fn add_up(weights: &[f64], stages: &[Vec<f64>], sum: &mut [f64]) {
    sum.fill(0.0);
    let Some(first) = stages.first() else {
        return;
    };
    for (weight, stage) in weights.iter().zip(stages) {
        for ((sum, own), first) in sum.iter_mut().zip(stage).zip(first) {
            *sum += weight * (own - first);
        }
    }
}

//! The fields of a contact during a step.

use std::sync::Arc;

use super::{ContactSet, DiscreteContact};
use crate::fields::{FaultField, FaultRates, FieldSizes};
use crate::{ContactState, SceneError, StepError, StepState};

/// The fields of a contact, with their pressure in force.
#[derive(Clone)]
pub(crate) struct Fields {
    fields: Vec<Field>,
    /// The pore pressure in force, of all fields \[Pa\].
    pub(crate) pressure: Vec<f64>,
    /// The time from the start of the step to its end \[s\].
    dt: f64,
    shown: Shown,
    /// The pressure with an error.
    off: Vec<f64>,
}

/// A field, with the numbers of a step.
#[derive(Clone)]
struct Field {
    law: Arc<dyn FaultField>,
    start: Vec<f64>,
    memory: Vec<f64>,
    /// The sources at the start, and at the end.
    sources: [Vec<f64>; 2],
    /// Those of the stages of an explicit method; empty before its first step.
    stages: Vec<Vec<f64>>,
    /// A memory of zeros, and one of an error.
    rest: Vec<f64>,
    missed: Vec<f64>,
}

/// What the contact shows its fields, one number per vertex.
#[derive(Clone)]
struct Shown {
    slip_rate: Vec<f64>,
    friction: Vec<f64>,
    state_rate: Vec<f64>,
    normal_stress: Vec<f64>,
}

/// Which of the sources of a field.
#[derive(Clone, Copy)]
enum Place {
    Start,
    End,
    Stage(usize),
}

impl Fields {
    /// The memory for fields of a contact with `count` vertices; none without any.
    pub(super) fn new(
        laws: &[Arc<dyn FaultField>],
        count: usize,
    ) -> Result<Option<Box<Self>>, SceneError> {
        if laws.is_empty() {
            return Ok(None);
        }
        let zeros = || vec![0.0; count];
        let mut fields = Vec::new();
        for law in laws {
            let FieldSizes {
                vertices,
                memory,
                sources,
            } = law.sizes();
            if vertices != count {
                return Err(SceneError::Length {
                    what: "field on a contact",
                    expected: count,
                    found: vertices,
                });
            }
            for (place, &value) in memory.iter().enumerate() {
                crate::checks::finite("initial memory of a field", place, value)?;
            }
            fields.push(Field {
                law: Arc::clone(law),
                start: memory.clone(),
                rest: vec![0.0; memory.len()],
                missed: memory.clone(),
                memory,
                sources: [vec![0.0; sources], vec![0.0; sources]],
                stages: Vec::new(),
            });
        }
        let mut fields = Self {
            fields,
            pressure: zeros(),
            off: zeros(),
            dt: 0.0,
            shown: Shown {
                slip_rate: zeros(),
                friction: zeros(),
                state_rate: zeros(),
                normal_stress: zeros(),
            },
        };
        fields.press();
        Ok(Some(Box::new(fields)))
    }

    /// The memory of each field.
    pub(crate) fn memories(&self) -> Vec<Vec<f64>> {
        self.fields
            .iter()
            .map(|field| field.memory.clone())
            .collect()
    }

    /// Puts the pressure of the memories in force.
    fn press(&mut self) {
        self.pressure.fill(0.0);
        for field in &self.fields {
            field.law.pressure(&field.memory, &mut self.pressure);
        }
    }

    /// Takes the memories of a state, and puts their pressure in force.
    fn hold(&mut self, memories: &[Vec<f64>]) {
        for (field, memory) in self.fields.iter_mut().zip(memories) {
            field.start.copy_from_slice(memory);
            field.memory.copy_from_slice(memory);
        }
        self.press();
    }

    /// Finds the sources by what is shown.
    fn find_sources(&mut self, time: f64, place: Place) {
        let Shown {
            slip_rate,
            friction,
            state_rate,
            normal_stress,
        } = &self.shown;
        let at = FaultRates {
            time,
            slip_rate,
            friction,
            state_rate,
            normal_stress,
        };
        for field in &mut self.fields {
            let source = match place {
                Place::Start => &mut field.sources[0],
                Place::End => &mut field.sources[1],
                Place::Stage(stage) => &mut field.stages[stage],
            };
            field.law.source(&at, &field.memory, source);
        }
    }

    /// Advances the memories from the start of the step by `dt`, with the sources of both ends.
    fn advance(&mut self, dt: f64) -> Result<(), StepError> {
        for (number, field) in self.fields.iter_mut().enumerate() {
            let Field {
                law,
                start,
                memory,
                sources: [begin, end],
                ..
            } = field;
            law.advance(start, [begin, end], dt, memory)
                .map_err(|source| StepError::Field {
                    field: number,
                    source,
                })?;
        }
        self.press();
        Ok(())
    }
}

impl<const C: usize> DiscreteContact<C> {
    /// Shows the fields slip rates, with the states in use or those of an accepted step and its time.
    fn show_fields(
        &mut self,
        rate: impl Fn(&Self, usize) -> f64,
        from: Option<(&ContactState<C>, f64)>,
    ) {
        let Some(mut fields) = self.fields.take() else {
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
                fields.find_sources(from.clock.time(), Place::Start);
                fields.find_sources(from.clock.time(), Place::End);
                fields.advance(dt)?;
            }
        }
        Ok(())
    }

    /// Advances the fields with the sources of these velocities at the end of the step.
    pub(crate) fn end_fields(
        &mut self,
        time: f64,
        velocity: &[nalgebra::SVector<f64, C>],
    ) -> Result<(), StepError> {
        for contact in &mut self.contacts {
            contact.show_fields(|own, k| own.slip_rate(k, velocity), None);
            if let Some(fields) = &mut contact.fields {
                fields.find_sources(time, Place::End);
                fields.advance(fields.dt)?;
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
        }
    }

    /// Finds the sources of a stage of an explicit method, with its states in use.
    pub(crate) fn find_stage_sources(
        &mut self,
        (stage, stages): (usize, usize),
        time: f64,
        velocity: &[nalgebra::SVector<f64, C>],
    ) {
        for contact in &mut self.contacts {
            contact.show_fields(|own, k| own.slip_rate(k, velocity), None);
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

    /// Advances the fields from a state to a stage at `node` of a step of `dt`, with the source there that the `weights`
    /// of the stages before make: linear in time, and exact for sources that are.
    ///
    /// ```text
    /// s* = s_0 + (2/c) sum of a_j (s_j - s_0)
    /// ```
    pub(crate) fn advance_to_stage(
        &mut self,
        from: &StepState<C>,
        weights: &[f64],
        (node, dt): (f64, f64),
    ) -> Result<(), StepError> {
        for (contact, from) in self.contacts.iter_mut().zip(&from.contacts) {
            let Some(fields) = &mut contact.fields else {
                continue;
            };
            for (field, memory) in fields.fields.iter_mut().zip(&from.fields) {
                field.start.copy_from_slice(memory);
                field.combine(weights, 2.0 / node);
            }
            fields.advance(node * dt)?;
        }
        Ok(())
    }

    /// Adds the error of the pore pressure, with its sign, to the change of the normal stress at each vertex of the body;
    /// the memories are those of the end of the step.
    ///
    /// It has two parts: that of the embedded method, by its `difference` of weights, and that of a source which curves
    /// while the memory relaxes. The linear source has the integral of the step, and so ends by `d = s* - s` beside the
    /// true one; a curvature `b` makes `d = -b dt^2/3` and an error `A b dt^4/36` of the memory, half of what relaxes from
    /// a source that goes from `-d` to `d`.
    pub(crate) fn add_pressure_error(
        &mut self,
        [difference, last]: [&[f64]; 2],
        dt: f64,
        change: &mut [f64],
    ) {
        for contact in &mut self.contacts {
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
            for field in fields {
                field.find_error(difference, last);
                let sources = [&field.sources[0][..], &field.sources[1][..]];
                let advanced = (field.law).advance(&field.rest, sources, dt, &mut field.missed);
                for (missed, memory) in field.missed.iter_mut().zip(&field.memory) {
                    *missed += memory;
                }
                // A field without sources has no error.
                let errs = advanced.is_ok() && !field.sources[0].is_empty();
                let memory = if errs { &field.missed } else { &field.memory };
                field.law.pressure(memory, off);
            }
            for (k, &vertex) in contact.part.vertices.iter().enumerate() {
                change[vertex] -= off[k] - pressure[k];
            }
        }
    }
}

impl Field {
    /// Sets the sources of the step to those of its error.
    fn find_error(&mut self, difference: &[f64], last: &[f64]) {
        let [begin, end] = &mut self.sources;
        let [first, .., true_end] = &self.stages[..] else {
            return;
        };
        let stages = &self.stages;
        let sum = |weights: &[f64], n: usize| -> f64 {
            let terms = weights.iter().zip(stages);
            terms
                .map(|(weight, stage)| weight * (stage[n] - first[n]))
                .sum()
        };
        for (n, (begin, end)) in begin.iter_mut().zip(end).enumerate() {
            let curved = first[n] + 2.0 * sum(last, n) - true_end[n];
            *begin = -0.5 * curved;
            *end = 2.0 * sum(difference, n) + 0.5 * curved;
        }
    }

    /// Sets the sources of the step to that of the first stage and one that the stages make.
    fn combine(&mut self, weights: &[f64], factor: f64) {
        let [begin, end] = &mut self.sources;
        let Some(first) = self.stages.first() else {
            return;
        };
        begin.copy_from_slice(first);
        for (n, end) in end.iter_mut().enumerate() {
            let terms = weights.iter().zip(&self.stages);
            let sum: f64 = terms
                .map(|(weight, stage)| weight * (stage[n] - first[n]))
                .sum();
            *end = first[n] + factor * sum;
        }
    }
}

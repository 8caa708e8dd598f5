//! The fields of a contact: memories, sources, and the pressure in force.

#[cfg(feature = "checkpoint")]
mod describe;
mod in_steps;
mod stages;

use std::sync::Arc;

use nalgebra::SVector;

use crate::fields::{FaultField, FaultRates, FieldSizes};
use crate::{SceneError, StepError};

/// The fields of a contact, with their pressure in force.
#[derive(Clone)]
pub(crate) struct Fields {
    fields: Vec<Field>,
    /// The memories at the start of an implicit step; empty before the first.
    start: Vec<Vec<f64>>,
    /// The pore pressure in force, of all fields \[Pa\].
    pub(crate) pressure: Vec<f64>,
    /// The pressure beyond the normal stress, or beyond what leaves the least one, taken up by the opening \[Pa\].
    pub(crate) excess: Vec<f64>,
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
    memory: Vec<f64>,
    /// The sources at the start, and at the end.
    sources: [Vec<f64>; 2],
    /// The sources of the stages of an explicit method; empty before its first step.
    stages: Vec<Vec<f64>>,
    /// The pressure at the stages of an explicit method, of a field without sources.
    known: Vec<Vec<f64>>,
    /// Sums over the stages.
    sums: [Vec<f64>; 2],
    /// The memory of other sources, for the error of an explicit step.
    missed: Vec<f64>,
}

/// The quantities that a contact shows its fields, one number per vertex.
#[derive(Clone)]
struct Shown {
    slip_rate: Vec<f64>,
    friction: Vec<f64>,
    state_rate: Vec<f64>,
    normal_stress: Vec<f64>,
}

/// The balance of a contact whose vertices slide in all their components, each by itself.
#[derive(Clone, Copy)]
pub(crate) struct Balanced<'a, const C: usize> {
    /// The forces on the vertices of the body \[N\].
    pub(crate) forces: &'a [SVector<f64, C>],
    /// The viscous resistance of each vertex of the contact [N s/m].
    pub(crate) resistance: &'a [f64],
}

/// The place of a source of a field.
#[derive(Clone, Copy)]
enum Place {
    Start,
    End,
    Stage(usize),
}

impl Fields {
    /// The memory for fields of a contact with `count` vertices; none without any.
    pub(in crate::contact) fn new(
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
                missed: Vec::new(),
                memory,
                sources: [vec![0.0; sources], vec![0.0; sources]],
                stages: Vec::new(),
                known: Vec::new(),
                sums: [vec![0.0; sources], vec![0.0; sources]],
            });
        }
        let mut fields = Self {
            fields,
            start: Vec::new(),
            pressure: zeros(),
            excess: zeros(),
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

    /// The times at which what is known of the fields jumps \[s\].
    pub(crate) fn stops(&self) -> impl Iterator<Item = f64> {
        self.fields.iter().flat_map(|field| field.law.stops())
    }

    /// Whether slip feeds any of the fields.
    pub(crate) fn are_fed(&self) -> bool {
        self.fields.iter().any(|field| !field.sources[0].is_empty())
    }

    /// Each field with its law.
    pub(crate) fn laws(&self) -> impl Iterator<Item = &dyn FaultField> {
        self.fields.iter().map(|field| &*field.law)
    }

    /// Takes the memories of a state, and puts their pressure in force.
    fn hold(&mut self, memories: &[Vec<f64>]) {
        for (field, memory) in self.fields.iter_mut().zip(memories) {
            field.memory.copy_from_slice(memory);
        }
        self.press();
    }

    /// Advances the memories from the start of an implicit step to its end.
    fn advance_from_start(&mut self) -> Result<(), StepError> {
        let start = std::mem::take(&mut self.start);
        let advanced = self.advance(&start, self.dt);
        self.start = start;
        advanced
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

    /// Puts the pressure of a stage after `dt` in force, with the sources of both ends; the memories of fields with sources
    /// hold what these read.
    fn find_pressure(&mut self, from: &[Vec<f64>], dt: f64, stage: usize) -> Result<(), StepError> {
        self.pressure.fill(0.0);
        for (number, (field, start)) in self.fields.iter_mut().zip(from).enumerate() {
            if let Some(known) = field.known.get(stage) {
                for (pressure, known) in self.pressure.iter_mut().zip(known) {
                    *pressure += known;
                }
                continue;
            }
            let Field {
                law,
                memory,
                sources: [begin, end],
                ..
            } = field;
            law.pressure_after(start, [begin, end], dt, &mut self.pressure, memory)
                .map_err(|source| StepError::Field {
                    field: number,
                    source,
                })?;
        }
        Ok(())
    }

    /// Advances the memories from those of the start of the step by `dt`, with the sources of both ends.
    fn advance(&mut self, from: &[Vec<f64>], dt: f64) -> Result<(), StepError> {
        for (number, (field, start)) in self.fields.iter_mut().zip(from).enumerate() {
            // Known ones of an explicit step have advanced with its first stage.
            if !field.known.is_empty() {
                continue;
            }
            let Field {
                law,
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

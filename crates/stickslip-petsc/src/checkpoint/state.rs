//! The state of a step, in parts that belong to vertices, and what belongs to none.

use nalgebra::SVector;
use serde::{Deserialize, Serialize};
use stickslip::StepState;
use stickslip::integrate::{Clock, ContactState, ControlState, StepReport};

use super::table::words;
use crate::World;
use crate::copies::Place;

/// The data that are equal in all processes.
#[derive(Debug, Serialize, Deserialize)]
pub(super) struct Globals {
    clock: Clock,
    last_step: f64,
    coupling: [f64; 4],
    control: ControlState,
    report: StepReport,
}

impl Globals {
    pub(super) fn of<const C: usize>(state: &StepState<C>) -> Self {
        Self {
            clock: state.clock,
            last_step: state.last_step,
            coupling: state.coupling,
            control: state.control,
            report: state.report,
        }
    }

    pub(super) fn put<const C: usize>(&self, state: &mut StepState<C>) {
        state.clock = self.clock;
        state.last_step = self.last_step;
        state.coupling = self.coupling;
        state.control = self.control;
        state.report = self.report;
    }
}

/// The fields of a body and of a contact, in the order of their numbers at a vertex.
const BODY: [&str; 4] = [
    "displacements",
    "velocities",
    "accelerations",
    "algorithmic numbers",
];
const CONTACT: [&str; 8] = [
    "states",
    "normal stresses",
    "slips",
    "earlier normal stresses",
    "relaxed normal stresses",
    "normal stresses of the body",
    "origins",
    "earlier velocities",
];

/// The fields of a set of vertices that this process owns.
pub(super) struct Owned {
    /// The words of the places of vertices.
    pub(super) places: Vec<u64>,
    count: usize,
    names: &'static [&'static str],
    /// Each field by its numbers, vertex after vertex; empty without one.
    fields: Vec<Vec<f64>>,
}

impl Owned {
    pub(super) fn of_body<const D: usize, const C: usize>(
        places: &[Place<D>],
        state: &StepState<C>,
    ) -> Self {
        let vectors = [
            &state.displacement,
            &state.velocity,
            &state.acceleration,
            &state.algorithmic,
        ];
        Self {
            places: words(places),
            count: places.len(),
            names: &BODY,
            fields: vectors.map(|field| flat(field)).into(),
        }
    }

    pub(super) fn of_contact<const D: usize, const C: usize>(
        places: &[Place<D>],
        state: &ContactState<C>,
    ) -> Self {
        let scalars = [
            &state.states,
            &state.normal_stress,
            &state.slip,
            &state.earlier_normal_stress,
            &state.relaxed_stress,
            &state.body_stress,
        ];
        let vectors = [&state.origin, &state.earlier];
        let fields = scalars.into_iter().cloned();
        Self {
            places: words(places),
            count: places.len(),
            names: &CONTACT,
            fields: fields.chain(vectors.map(|field| flat(field))).collect(),
        }
    }

    /// The number of vertices.
    pub(super) fn len(&self) -> usize {
        self.count
    }

    /// The names of the fields.
    pub(super) fn names(&self) -> &'static [&'static str] {
        self.names
    }

    /// The numbers per vertex of each field, also where another process has all of them.
    pub(super) fn widths(&self, world: World) -> Vec<usize> {
        let here = |field: &Vec<f64>| field.len().checked_div(self.count).unwrap_or(0);
        (self.fields.iter())
            .map(|field| world.largest(here(field) as f64) as usize)
            .collect()
    }

    /// All fields of the first vertex, then of the next.
    pub(super) fn rows(&self, widths: &[usize]) -> Vec<f64> {
        let mut rows = Vec::with_capacity(self.count * widths.iter().sum::<usize>());
        for k in 0..self.count {
            for (field, &width) in self.fields.iter().zip(widths) {
                rows.extend(&field[width * k..width * (k + 1)]);
            }
        }
        rows
    }

    /// Takes fields from rows of those widths.
    pub(super) fn take(&mut self, rows: &[f64], widths: &[usize]) {
        let mut rest = rows;
        for k in 0..self.count {
            for (field, &width) in self.fields.iter_mut().zip(widths) {
                let (numbers, after) = rest.split_at(width);
                field[width * k..width * (k + 1)].copy_from_slice(numbers);
                rest = after;
            }
        }
    }
}

/// Puts the fields of the body and of its contacts into a state of as many numbers.
pub(super) fn put<const C: usize>(owned: &[Owned], state: &mut StepState<C>) {
    let mut sets = owned.iter();
    if let Some(body) = sets.next() {
        let vectors = [
            &mut state.displacement,
            &mut state.velocity,
            &mut state.acceleration,
            &mut state.algorithmic,
        ];
        for (to, from) in vectors.into_iter().zip(&body.fields) {
            put_vectors(from, to);
        }
    }
    for (to, from) in state.contacts.iter_mut().zip(sets) {
        let scalars = [
            &mut to.states,
            &mut to.normal_stress,
            &mut to.slip,
            &mut to.earlier_normal_stress,
            &mut to.relaxed_stress,
            &mut to.body_stress,
        ];
        let count = scalars.len();
        for (to, from) in scalars.into_iter().zip(&from.fields) {
            to.copy_from_slice(from);
        }
        let vectors = [&mut to.origin, &mut to.earlier];
        for (to, from) in vectors.into_iter().zip(&from.fields[count..]) {
            put_vectors(from, to);
        }
    }
}

fn flat<const C: usize>(field: &[SVector<f64, C>]) -> Vec<f64> {
    field.iter().flatten().copied().collect()
}

fn put_vectors<const C: usize>(from: &[f64], to: &mut [SVector<f64, C>]) {
    for (to, from) in to.iter_mut().zip(from.chunks_exact(C)) {
        to.copy_from_slice(from);
    }
}

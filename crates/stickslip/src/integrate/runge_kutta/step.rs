//! One step: slopes at the stages and their weighted sums.

use stickslip_friction::modulus;
use stickslip_solvers::Operator;

use super::balance::{moved, numbered};
use super::tableau::{ERROR, NODES, STAGES, WEIGHTS};
use super::{Motion, RungeKutta};
use crate::step::Span;
use crate::{StepError, StepFailure, StepReport, StepState};

impl<const C: usize> Motion<C> {
    /// Copies the unknowns from the start of a step.
    pub(super) fn copy_from(&mut self, from: &StepState<C>) {
        self.displacement.copy_from_slice(&from.displacement);
        let mut rest = self.states.as_mut_slice();
        for contact in &from.contacts {
            let (states, others) = rest.split_at_mut(contact.states.len());
            states.copy_from_slice(&contact.states);
            rest = others;
        }
    }

    /// Sets the unknowns to `from` plus the step times the weighted slopes of the previous stages.
    ///
    /// The loop is over vertices: sums of fields would save a fault a twentieth of a step, and cost a single vertex as
    /// much.
    fn follow(&mut self, from: &StepState<C>, slopes: &[Self], weights: &[f64], dt: f64) {
        for (i, (to, from)) in (self.displacement.iter_mut().zip(&from.displacement)).enumerate() {
            *to = *from;
            for (weight, slope) in weights.iter().zip(slopes) {
                *to += slope.displacement[i] * (weight * dt);
            }
        }
        let states = from.contacts.iter().flat_map(|contact| &contact.states);
        for (i, (to, from)) in self.states.iter_mut().zip(states).enumerate() {
            *to = *from;
            for (weight, slope) in weights.iter().zip(slopes) {
                *to += slope.states[i] * (weight * dt);
            }
        }
    }

    /// Sets the difference of a step from the embedded method.
    fn differ(&mut self, slopes: &[Self], dt: f64) {
        for (i, to) in self.displacement.iter_mut().enumerate() {
            to.fill(0.0);
            for (weight, slope) in ERROR.iter().zip(slopes) {
                *to += slope.displacement[i] * (weight * dt);
            }
        }
        for (i, to) in self.states.iter_mut().enumerate() {
            *to = 0.0;
            for (weight, slope) in ERROR.iter().zip(slopes) {
                *to += slope.states[i] * (weight * dt);
            }
        }
    }
}

impl<Op: Operator<C>, const C: usize> RungeKutta<Op, C> {
    /// Takes one step; stores the differences of displacement and state from the method of order 4.
    pub(super) fn advance(&mut self, dt: f64) -> Result<(), StepFailure> {
        let next = self.now.clock.after(dt);
        let advanced = self.try_to_advance(dt);
        advanced.map_err(|cause| StepFailure::of(&next, cause))
    }

    fn try_to_advance(&mut self, dt: f64) -> Result<(), StepError> {
        let span = Span::new(&self.now.clock, dt, &self.stops)?;
        let next = span.next;
        if std::mem::take(&mut self.accepted) {
            self.slopes.swap(0, STAGES - 1);
            self.elastic.accept();
        }
        if let Some(time) = span.from_right {
            self.stage.copy_from(&self.now);
            self.evaluate(0, time)?;
            (self.elastic).of_first_rates(&self.scene.stiffness, &self.slopes[0].displacement);
        }
        for stage in 1..STAGES {
            let weights = &WEIGHTS[stage][..stage];
            (self.stage).follow(&self.now, &self.slopes[..stage], weights, dt);
            if stage == 1 {
                self.elastic.at_second_stage(dt);
            } else {
                (self.elastic).at(stage, &self.scene.stiffness, &self.stage.displacement);
            }
            self.evaluate(stage, span.at(NODES[stage]))?;
        }
        let rates = &self.slopes[STAGES - 1].displacement;
        (self.elastic).of_last_rates(&self.scene.stiffness, rates);
        self.error.differ(&self.slopes, dt);
        let last = &mut self.slopes[STAGES - 1];
        for (contact, accepted, first) in numbered(&self.contacts, &self.now) {
            if !self.follows || !contact.trial.follows_normal_stress() {
                continue;
            }
            for k in 0..accepted.states.len() {
                let state = &mut self.stage.states[first + k];
                let (to, moved_by) = moved((contact, &accepted.normal_stress), k, *state)?;
                *state = to;
                last.states[first + k] *= moved_by;
                self.error.states[first + k] *= moved_by;
            }
        }
        self.last.copy_from(&self.now);
        let mut states = self.stage.states.iter();
        for (at, contact) in self.now.contacts.iter_mut().zip(&self.contacts.contacts) {
            for (k, &vertex) in contact.part.vertices.iter().enumerate() {
                let moved = self.stage.displacement[vertex] - self.now.displacement[vertex];
                at.slip[k] += modulus(&contact.tangential(k, &moved));
            }
            for (state, to) in at.states.iter_mut().zip(&mut states) {
                *state = *to;
            }
            at.normal_stress.copy_from_slice(&contact.normal_stress);
        }
        self.now.clock = next;
        self.now.last_step = dt;
        (self.now.displacement).copy_from_slice(&self.stage.displacement);
        (self.now.velocity).copy_from_slice(&last.displacement);
        self.now.report = StepReport {
            coupling_iterations: STAGES - 1,
            solver_iterations: STAGES - 1,
            ..StepReport::default()
        };
        self.balanced = Some(next);
        self.accepted = true;
        self.seen.show(&self.now);
        Ok(())
    }
}

//! One step: slopes at the stages and their weighted sums.

use stickslip_friction::modulus;

use super::RungeKutta;
use super::contacts::{moved, numbered};
use super::tableau::{NODES, STAGES, WEIGHTS};
use super::threads::on_shares;
use crate::step::Span;
use crate::{Clock, StepError, StepFailure, StepReport};

impl<const C: usize> RungeKutta<C> {
    /// Takes one step; stores the differences of displacement and state from the method of order 4.
    /// With an `estimated` error that limits the step, stability does not.
    pub(super) fn advance(&mut self, dt: f64, estimated: bool) -> Result<(), StepFailure> {
        let next = self.now.clock.after(dt);
        let advanced = self.try_to_advance(dt, estimated);
        advanced.map_err(|cause| {
            let failure = StepFailure::of(&next, cause);
            failure.placed(|vertex| self.snapshot().place_of(vertex))
        })
    }

    fn try_to_advance(&mut self, dt: f64, estimated: bool) -> Result<(), StepError> {
        let span = Span::new(&self.now.clock, dt, &self.scene.stops)?;
        if std::mem::take(&mut self.accepted) {
            self.stages.slopes.swap(0, STAGES - 1);
            self.elastic.accept();
            self.scene.contacts.turn_stage_sources();
            self.find_rates();
        }
        if let Some(time) = span.from_right {
            self.find_first_slopes(time)?;
        }
        self.find_soft_cells(dt);
        if !estimated {
            self.check_stability(dt)?;
        }
        for stage in 1..STAGES {
            self.find_stage(stage, &span, dt)?;
        }
        let rates = &self.stages.slopes[STAGES - 1].displacement;
        (self.elastic).of_last_rates(self.matrices.stiffness(), rates);
        let displacements = !self.stages.clamped.is_empty() || self.soft.are_any();
        (self.stages.error).differ(&self.stages.slopes, dt, displacements);
        self.differ_soft_cells(dt);
        self.put_in_force()?;
        self.accept(span.next, dt);
        Ok(())
    }

    /// The slopes at the start of a step, by its state alone, with its elastic forces known.
    pub(super) fn find_first_slopes(&mut self, time: f64) -> Result<(), StepError> {
        self.stages.motion.copy_from(&self.now);
        self.scene.contacts.hold_fields(&self.now);
        self.evaluate(0, time)?;
        self.find_field_sources(0, time);
        self.find_rates();
        self.remember_soft_cells();
        let rates = &self.stages.slopes[0].displacement;
        (self.elastic).of_first_rates(self.matrices.stiffness(), rates);
        Ok(())
    }

    /// The slopes of a later stage.
    fn find_stage(&mut self, stage: usize, span: &Span, dt: f64) -> Result<(), StepError> {
        (self.stages.motion).follow(&self.now, &self.stages.slopes, stage, dt);
        self.displace_soft_cells(stage, dt);
        if stage == 1 {
            self.elastic.at_second_stage(dt);
        } else {
            let stiffness = self.matrices.stiffness();
            (self.elastic).at(stage, stiffness, &self.stages.motion.displacement);
        }
        let time = span.at(NODES[stage]);
        let weights = &WEIGHTS[stage][..stage];
        (self.scene.contacts).advance_to_stage(&self.now, weights, &NODES, dt)?;
        self.evaluate(stage, time)?;
        self.couple_soft_cells(stage, time, dt)?;
        self.find_field_sources(stage, time);
        Ok(())
    }

    /// Puts the states of the last stage under the normal stress in force there, with their rates and errors.
    fn put_in_force(&mut self) -> Result<(), StepError> {
        let stages = &mut self.stages;
        for (contact, accepted, first) in numbered(&self.scene.contacts, &self.now) {
            if !contact.trial.follows_normal_stress() {
                continue;
            }
            for k in 0..accepted.states.len() {
                let state = &mut stages.motion.states[first + k];
                let (to, moved_by) = moved((contact, &accepted.normal_stress), k, *state)?;
                *state = to;
                stages.slopes[STAGES - 1].states[first + k] *= moved_by;
                stages.error.states[first + k] *= moved_by;
            }
        }
        Ok(())
    }

    /// Accepts the last stage as the state of a time.
    fn accept(&mut self, next: Clock, dt: f64) {
        self.last.copy_all_but_memories(&self.now);
        (self.scene.contacts).turn_memories(&mut self.last, &mut self.now);
        let end = &self.stages.motion;
        let mut states = end.states.iter();
        let contacts = self.scene.contacts.contacts.iter();
        for (at, contact) in self.now.contacts.iter_mut().zip(contacts) {
            let (from, to) = (&self.now.displacement, &end.displacement);
            on_shares(&mut at.slip, &|first, slips| {
                for (k, slip) in (first..).zip(slips) {
                    let vertex = contact.part.vertices[k];
                    let moved = to[vertex] - from[vertex];
                    *slip += modulus(&contact.tangential(k, &moved));
                }
            });
            for (state, to) in at.states.iter_mut().zip(&mut states) {
                *state = *to;
            }
            at.normal_stress.copy_from_slice(&contact.normal_stress);
        }
        self.now.clock = next;
        self.now.last_step = dt;
        (self.now.displacement).copy_from_slice(&end.displacement);
        let rates = &self.stages.slopes[STAGES - 1].displacement;
        self.now.velocity.copy_from_slice(rates);
        self.now.report = StepReport {
            coupling_iterations: STAGES - 1,
            solver_iterations: STAGES - 1,
            at_least_normal_stress: self.scene.contacts.at_least_normal_stress(),
            at_largest_normal_stress: self.scene.contacts.at_largest_normal_stress(),
            ..StepReport::default()
        };
        self.drive.balanced = Some(next);
        self.accepted = true;
        self.scene.seen.show(&self.now);
    }

    /// Finds the sources of the fields on the contacts at a stage, from its slip rates.
    pub(super) fn find_field_sources(&mut self, stage: usize, time: f64) {
        if self.scene.contacts.have_fields() {
            let slope = &self.stages.slopes[stage];
            // The slip rate of a soft cell is the mean one of the step.
            let balances = !self.soft.are_any();
            let (scalar, forces) = (&self.local.scalar, &self.drive.forces);
            let balanced = |number: usize| {
                let own = scalar[number].as_ref().filter(|_| balances)?;
                Some(own.balanced(forces))
            };
            let rates = (&slope.displacement[..], &slope.states[..]);
            (self.scene.contacts).find_stage_sources((stage, STAGES), time, rates, balanced);
        }
    }
}

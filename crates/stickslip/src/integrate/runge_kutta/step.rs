//! One step: slopes at the stages and their weighted sums.

use std::ops::{AddAssign, Mul};

use stickslip_friction::modulus;

use super::balance::{moved, numbered};
use super::tableau::{ERROR, NODES, STAGES, WEIGHTS};
use super::threads::on_shares;
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
    fn follow(&mut self, from: &StepState<C>, slopes: &[Self; STAGES], stage: usize, dt: f64) {
        match stage {
            1 => self.add_slopes::<1>(from, slopes, dt),
            2 => self.add_slopes::<2>(from, slopes, dt),
            3 => self.add_slopes::<3>(from, slopes, dt),
            4 => self.add_slopes::<4>(from, slopes, dt),
            5 => self.add_slopes::<5>(from, slopes, dt),
            _ => self.add_slopes::<6>(from, slopes, dt),
        }
    }

    fn add_slopes<const N: usize>(
        &mut self,
        from: &StepState<C>,
        slopes: &[Self; STAGES],
        dt: f64,
    ) {
        let shares = std::array::from_fn(|k| WEIGHTS[N][k] * dt);
        let fields: [_; N] = std::array::from_fn(|k| slopes[k].displacement.as_slice());
        let start = Some(from.displacement.as_slice());
        sum_slopes(&mut self.displacement, start, fields, shares);
        let mut first = 0;
        for contact in &from.contacts {
            let range = first..first + contact.states.len();
            first = range.end;
            let fields: [_; N] = std::array::from_fn(|k| &slopes[k].states[range.clone()]);
            let start = Some(contact.states.as_slice());
            sum_slopes(&mut self.states[range], start, fields, shares);
        }
    }

    /// Sets the difference of a step from the embedded method, that of displacements if they are asked for.
    fn differ(&mut self, slopes: &[Self; STAGES], dt: f64, displacements: bool) {
        let shares = ERROR.map(|weight| weight * dt);
        if displacements {
            let fields = slopes.each_ref().map(|slope| slope.displacement.as_slice());
            sum_slopes(&mut self.displacement, None, fields, shares);
        }
        let fields = slopes.each_ref().map(|slope| slope.states.as_slice());
        sum_slopes(&mut self.states, None, fields, shares);
    }
}

/// `to = from + sum of shares times slopes`, in one pass; nothing for `from` is zero.
fn sum_slopes<T, const N: usize>(
    to: &mut [T],
    from: Option<&[T]>,
    slopes: [&[T]; N],
    shares: [f64; N],
) where
    T: Copy + Send + Sync + AddAssign + Mul<f64, Output = T>,
{
    on_shares(to, &|first, to| {
        let range = first..first + to.len();
        let slopes = slopes.map(|slope| &slope[range.clone()]);
        if let Some(from) = from {
            for (i, (to, from)) in to.iter_mut().zip(&from[range]).enumerate() {
                let mut sum = *from;
                for (slope, share) in slopes.iter().zip(shares) {
                    sum += slope[i] * share;
                }
                *to = sum;
            }
        } else {
            for (i, to) in to.iter_mut().enumerate() {
                let mut sum = slopes[0][i] * shares[0];
                for (slope, share) in slopes.iter().zip(shares).skip(1) {
                    sum += slope[i] * share;
                }
                *to = sum;
            }
        }
    });
}

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
        let span = Span::new(&self.now.clock, dt, &self.stops)?;
        let next = span.next;
        if std::mem::take(&mut self.accepted) {
            self.slopes.swap(0, STAGES - 1);
            self.elastic.accept();
            self.contacts.turn_stage_sources();
            self.find_rates();
        }
        if let Some(time) = span.from_right {
            self.stage.copy_from(&self.now);
            self.contacts.hold_fields(&self.now);
            self.evaluate(0, time)?;
            self.find_field_sources(0, time);
            self.find_rates();
            self.remember_soft_cells();
            (self.elastic).of_first_rates(self.matrices.stiffness(), &self.slopes[0].displacement);
        }
        self.find_soft_cells(dt);
        if !estimated {
            self.check_stability(dt)?;
        }
        for stage in 1..STAGES {
            (self.stage).follow(&self.now, &self.slopes, stage, dt);
            self.displace_soft_cells(stage, dt);
            if stage == 1 {
                self.elastic.at_second_stage(dt);
            } else {
                (self.elastic).at(stage, self.matrices.stiffness(), &self.stage.displacement);
            }
            let time = span.at(NODES[stage]);
            let weights = &WEIGHTS[stage][..stage];
            (self.contacts).advance_to_stage(&self.now, weights, (NODES[stage], dt))?;
            self.evaluate(stage, time)?;
            self.couple_soft_cells(stage, time, dt)?;
            self.find_field_sources(stage, time);
        }
        let rates = &self.slopes[STAGES - 1].displacement;
        (self.elastic).of_last_rates(self.matrices.stiffness(), rates);
        let displacements = !self.clamped.is_empty() || self.soft.are_any();
        self.error.differ(&self.slopes, dt, displacements);
        self.differ_soft_cells(dt);
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
            let (from, to) = (&self.now.displacement, &self.stage.displacement);
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
        self.contacts.accept_fields(&mut self.now.contacts);
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

    /// Finds the sources of the fields on the contacts at a stage, from its slip rates.
    pub(super) fn find_field_sources(&mut self, stage: usize, time: f64) {
        if self.contacts.have_fields() {
            let velocity = &self.slopes[stage].displacement;
            (self.contacts).find_stage_sources((stage, STAGES), time, velocity);
        }
    }
}

//! Predictor and corrector of an update formula on the fields of a body.

use nalgebra::SVector;
use stickslip_friction::modulus;
use stickslip_solvers::{for_contact, for_parts};
use stickslip_time::UpdateFormula;

use super::prediction::predict;
use super::{Problem, Span, Workspace, check_finite};
use crate::laws::StateStep;
use crate::sums::agreed;
use crate::{StateUpdate, StepError, StepReport, StepState};

impl<const C: usize> Workspace<C> {
    /// Begins a step. At a stop it starts from the data on the right side, and from accelerations in balance with them.
    pub(super) fn begin(
        &mut self,
        p: &Problem<C>,
        from: &StepState<C>,
        start: &mut Option<Box<StepState<C>>>,
        span: &Span,
        instead_of: Option<StepReport>,
    ) -> Result<(), StepError> {
        self.balanced = None;
        if instead_of.is_none() {
            self.solver_iterations = 0;
        }
        self.end.report = instead_of.unwrap_or_default();
        self.end.report.damped = instead_of.is_some();
        self.impact = false;
        if let Some(time) = span.from_right {
            let start = copy(from, start);
            let prescribed = p.constraints.prescribe(time, &mut start.velocity);
            agreed(&p.ranks, prescribed)?;
            self.find_acceleration(p, start, (time, span.dt))?;
        }
        Ok(())
    }

    /// The start of a stage after another one: `from + lead (end - from)`.
    pub(super) fn lead(
        &mut self,
        from: &StepState<C>,
        start: &mut Option<Box<StepState<C>>>,
        lead: f64,
    ) -> Result<(), StepError> {
        let start = copy(&self.end, start);
        self.contacts.unload(&mut start.contacts, &from.contacts)?;
        start.lead(from, lead);
        Ok(())
    }

    /// Computes `r = l - M a^ - A u^`, prescribed velocities, and the initial states of the step.
    pub(super) fn predict(
        &mut self,
        p: &Problem<C>,
        start: &StepState<C>,
        formula: &UpdateFormula,
        (dt, update): (f64, StateUpdate),
        time: f64,
    ) -> Result<(), StepError> {
        let free = self.predict_free(p, start, (formula, time));
        if !free {
            predict(formula, start, &mut self.end);
        }
        let prescribed = p.constraints.prescribe(time, &mut self.end.velocity);
        agreed(&p.ranks, prescribed)?;
        let fixed = &p.constraints.fixed;
        // The mean velocity of both ends moves what is prescribed.
        let c_u = formula.displacement.new_velocity;
        for &vertex in &p.constraints.held {
            for c in (0..C).filter(|&c| fixed[vertex][c]) {
                let v = self.end.velocity[vertex][c];
                let moved = formula.prescribed.of(start.motion(vertex, c), v);
                self.end.displacement[vertex][c] = moved - c_u * v;
            }
        }
        let inertia = p.matrices.has_mass();
        let step = StateStep::new(dt, update, formula, inertia);
        let begun = (self.contacts).begin(step, time, start, |vertex| {
            SVector::from_fn(|c, _| step.taken_over(formula, start.motion(vertex, c), inertia))
        });
        agreed(&p.ranks, begun)?;
        self.contacts.prescribe(fixed, &self.end.velocity);
        let accelerates = formula.acceleration.new_velocity > 0.0;
        if accelerates && c_u == 0.0 {
            self.impact |= self.contacts.land(&mut self.end.displacement);
        }
        let position = !accelerates || formula.is_implicit_euler();
        let predicted = (&self.end.displacement[..], c_u);
        (self.contacts).bound_gaps(predicted, &start.velocity, position);
        if free {
            self.solve_free(p, start, formula, (dt, time));
            if self.free.solved {
                return Ok(());
            }
        }
        p.loads.fill(time, &mut self.load, &mut self.scratch);
        self.contacts.add_tractions(&mut self.load);
        self.subtract_elastic(p, start, dt);
        if let Some(mass) = p.matrices.mass() {
            mass.multiply_add(-1.0, &self.end.acceleration, &mut self.load);
        }
        self.subtract_lagged(p, start, dt);
        let finite = check_finite("load", &self.load);
        agreed(
            &p.ranks,
            finite.map_err(|error| self.first_term(p, time, error)),
        )
    }

    /// The error of the first term of a load that is not finite.
    #[cold]
    fn first_term(&mut self, p: &Problem<C>, time: f64, error: StepError) -> StepError {
        let StepError::Data { vertex, value, .. } = error else {
            return error;
        };
        let (end, contacts) = (&self.end, &self.contacts);
        let (load, scratch) = (&mut self.load, &mut self.scratch);
        let mut terms = || {
            check_finite("displacement", &end.displacement)?;
            check_finite("acceleration", &end.acceleration)?;
            p.loads.fill(time, load, scratch);
            check_finite("load", load)?;
            contacts.add_tractions(load);
            check_finite("traction of contacts", load)
        };
        let what = "elastic, inertial and viscous force";
        let left = StepError::Data {
            what,
            vertex,
            value,
        };
        terms().err().unwrap_or(left)
    }

    /// `u`, `a`, slip and states of the new time, from its velocity.
    pub(super) fn correct(&mut self, start: &StepState<C>, formula: &UpdateFormula, dt: f64) {
        let end = &mut self.end;
        for i in 0..end.algorithmic.len() {
            for c in 0..C {
                let (from, v) = (start.motion(i, c), end.velocity[i][c]);
                end.algorithmic[i][c] = formula.algorithmic.of(from, v);
            }
        }
        let c_u = formula.displacement.new_velocity;
        // In an explicit scheme the displacement is known.
        if c_u != 0.0 {
            add_multiple(&mut end.displacement, c_u, &end.velocity);
        }
        let c_a = formula.acceleration.new_velocity;
        if self.free.solved {
            let (free, velocity) = (&self.free, &end.velocity);
            let acceleration = &mut end.acceleration[..];
            for_parts(0..acceleration.len(), acceleration, &|part, a| {
                for other in free.others_in(part.clone()) {
                    a[other.vertex - part.start] += velocity[other.vertex] * c_a;
                }
            });
        } else {
            add_multiple(&mut end.acceleration, c_a, &end.velocity);
        }
        self.contacts
            .close_gaps(end, formula.acceleration.new_velocity > 0.0);
        self.contacts.accept(&mut end.contacts);
        end.report.at_least_normal_stress = self.contacts.at_least_normal_stress();
        end.report.at_largest_normal_stress = self.contacts.at_largest_normal_stress();
        add_slip(&self.contacts, start, end);
        let contacts = self.contacts.contacts.iter().zip(&mut end.contacts);
        for ((contact, now), old) in contacts.zip(&start.contacts) {
            if contact.reacts() {
                now.earlier_normal_stress
                    .copy_from_slice(&old.normal_stress);
            }
            let (earlier, vertices) = (&mut now.earlier[..], &contact.part.vertices);
            for_contact(earlier.len(), earlier, &|places, earlier| {
                for (earlier, &vertex) in earlier.iter_mut().zip(&vertices[places]) {
                    *earlier = start.velocity[vertex];
                }
            });
        }
        end.last_step = dt;
    }

    /// Ends a step: sets its time, and for `several` stages the slip from its beginning to its end.
    pub(super) fn finish(&mut self, from: &StepState<C>, span: &Span, several: bool) {
        let end = &mut self.end;
        if several {
            add_slip(&self.contacts, from, end);
        }
        for (now, from) in end.contacts.iter_mut().zip(&from.contacts) {
            now.origin.copy_from_slice(&from.origin);
        }
        if end.report.damped {
            end.last_step = span.dt;
        }
        end.clock = span.next;
        end.control = from.control;
        end.report.solver_iterations += self.solver_iterations;
    }
}

impl<const C: usize> Workspace<C> {
    /// Finds the accelerations after an impact anew: those of the step hold its impulse.
    pub(super) fn rebalance(
        &mut self,
        p: &Problem<C>,
        memory: &mut Option<Box<StepState<C>>>,
        (time, dt): (f64, f64),
    ) -> Result<(), StepError> {
        let end = copy(&self.end, memory);
        self.find_acceleration(p, end, (time, dt))?;
        self.end.acceleration.copy_from_slice(&end.acceleration);
        self.end.algorithmic.copy_from_slice(&end.algorithmic);
        Ok(())
    }
}

/// A copy, in memory that is allocated on first use.
fn copy<'a, const C: usize>(
    from: &StepState<C>,
    memory: &'a mut Option<Box<StepState<C>>>,
) -> &'a mut StepState<C> {
    match memory {
        Some(copy) => copy.copy_from(from),
        None => *memory = Some(Box::new(from.clone())),
    }
    memory.get_or_insert_with(|| Box::new(from.clone()))
}

/// `to += factor v`; nothing of an empty field.
fn add_multiple<const C: usize>(to: &mut [SVector<f64, C>], factor: f64, v: &[SVector<f64, C>]) {
    for_parts(0..to.len(), to, &|part, to| {
        for (to, v) in to.iter_mut().zip(&v[part]) {
            *to += v * factor;
        }
    });
}

/// Adds the distance from the displacement of `start` to that of `end` to the slip.
fn add_slip<const C: usize>(
    contacts: &crate::contact::ContactSet<C>,
    start: &StepState<C>,
    end: &mut StepState<C>,
) {
    let displacement = &end.displacement;
    let states = end.contacts.iter_mut().zip(&start.contacts);
    for (contact, (now, before)) in contacts.contacts.iter().zip(states) {
        let slip = &mut now.slip[..];
        for_contact(slip.len(), slip, &|places, slip| {
            for (slip, k) in slip.iter_mut().zip(places) {
                let vertex = contact.part.vertices[k];
                let moved = displacement[vertex] - start.displacement[vertex];
                *slip = before.slip[k] + modulus(&contact.tangential(k, &moved));
            }
        });
    }
}

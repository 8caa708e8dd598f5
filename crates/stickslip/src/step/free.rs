//! Vertices without friction in explicit steps: force, velocity and acceleration in one pass over memory.

use nalgebra::SVector;
use stickslip_solvers::{for_contact, for_parts};
use stickslip_time::UpdateFormula;

use super::free_pass::Pass;
use super::local_steps::weights_after;
use super::prediction::{predict_part, predicted_acceleration};
use super::{Problem, Workspace};
use crate::StepState;

impl<const C: usize> Workspace<C> {
    /// `u^` and `a^`, if the step can solve for free vertices by itself: their velocity needs no copy of the last one. Idle
    /// vertices have theirs already, and their `r`.
    ///
    /// Contacts that open measure their tolerance by the velocity of the whole body before they move, and reactions by its
    /// forces: with these the velocity problem is that of all vertices.
    pub(super) fn predict_free(
        &mut self,
        p: &Problem<C>,
        start: &StepState<C>,
        (formula, time): (&UpdateFormula, f64),
    ) -> bool {
        self.free.solved = false;
        let explicit = !self.operators.implicit && formula.displacement.new_velocity == 0.0;
        let lags = self.lags() && p.matrices.relaxation().is_none();
        let asked = self.contacts.can_open() || self.reactions.is_some();
        let stored = self.end.algorithmic.is_empty() && !self.end.acceleration.is_empty();
        if !explicit || lags || asked || !stored {
            return false;
        }
        let Self {
            end,
            load,
            free,
            operators,
            ..
        } = self;
        let Some((pass, others)) = Pass::new(p, operators, start, (formula, time)) else {
            return false;
        };
        free.take_others(others);
        let others = &*free;
        let fields = (
            (&mut end.displacement[..], &mut end.velocity[..]),
            (&mut end.acceleration[..], &mut load[..]),
        );
        for_parts(0..start.displacement.len(), fields, &|part,
                                                         (
            (u, v),
            (a, load),
        )| {
            predict_part(formula, start, part.clone(), [u, a]);
            for run in pass.runs(part.clone()).filter(|run| run.idle) {
                let own = run.within(part.start);
                pass.begin(&run, &mut load[own.clone()]);
                pass.finish(
                    &run,
                    [&mut load[own.clone()], &mut v[own.clone()], &mut a[own]],
                );
            }
            for other in others.others_in(part.clone()) {
                let place = other.vertex - part.start;
                v[place] = start.velocity[other.vertex];
                a[place] = predicted_acceleration(formula, start, other.vertex);
            }
        });
        free.solved = pass.is_finite();
        true
    }

    /// Part by part of the body: `r = l - A u^ - M a^`, and at free vertices `v = B^-1 r`, `a = a^ + c_a v`.
    ///
    /// If a value is not finite, nothing of it stays, and the step finds out which by the way of all bodies.
    pub(super) fn solve_free(
        &mut self,
        p: &Problem<C>,
        start: &StepState<C>,
        formula: &UpdateFormula,
        (dt, time): (f64, f64),
    ) {
        self.fill_load(p, time);
        let share = self.relaxation_share(p, dt);
        let Self {
            end,
            load,
            mean_velocity,
            free,
            operators,
            ..
        } = self;
        let (displacement, velocity, acceleration) = (
            &end.displacement[..],
            &mut end.velocity[..],
            &mut end.acceleration[..],
        );
        let count = free.others.len();
        for_contact(count, &mut free.others[..], &|_, others| {
            for other in others {
                other.load = load[other.vertex];
                other.velocity = velocity[other.vertex];
                other.acceleration = acceleration[other.vertex];
            }
        });
        let pass = Pass::new(p, operators, start, (formula, time));
        let parts = pass.zip(p.matrices.stiffness().by_parts());
        let solved = parts.is_some_and(|((pass, _), product)| {
            let others = &*free;
            let begin = |first: usize, load: &mut [SVector<f64, C>]| {
                let part = first..first + load.len();
                for run in pass.runs(part.clone()).filter(|run| !run.idle) {
                    pass.begin(&run, &mut load[run.within(first)]);
                }
                for other in others.others_in(part) {
                    load[other.vertex - first] = other.load;
                }
            };
            let finish = |first: usize, [load, v, a]: [&mut [SVector<f64, C>]; 3]| {
                let part = first..first + load.len();
                for run in pass.runs(part.clone()) {
                    let own = run.within(first);
                    if !run.idle {
                        pass.finish(
                            &run,
                            [&mut load[own.clone()], &mut v[own.clone()], &mut a[own]],
                        );
                        continue;
                    }
                    for other in others.others_in(run.vertices.clone()) {
                        load[other.vertex - first] -=
                            pass.inertia(other.vertex, &other.acceleration);
                    }
                }
                for other in others.others_in(part) {
                    v[other.vertex - first] = other.velocity;
                    a[other.vertex - first] = other.acceleration;
                }
            };
            let seen = seen(displacement, start, mean_velocity, share);
            let fields = [&mut load[..], &mut *velocity, &mut *acceleration];
            let weights = weights_after(start.clock.step() + 1);
            product.multiply_add_by_parts(&weights, -1.0, seen, fields, &begin, &finish);
            pass.is_finite()
        });
        free.solved &= solved;
        if !free.solved {
            for vertex in free.ranges(velocity.len()).flatten() {
                velocity[vertex] = start.velocity[vertex];
                acceleration[vertex] = predicted_acceleration(formula, start, vertex);
            }
        }
    }

    /// The load without the forces of the body: of all vertices if functions fill fields, else of those that are not free.
    fn fill_load(&mut self, p: &Problem<C>, time: f64) {
        if p.loads.fill_fields() {
            p.loads.fill(time, &mut self.load, &mut self.scratch);
        } else {
            let (load, others) = (&mut self.load[..], &self.free);
            for_parts(0..load.len(), load, &|part, load| {
                let others = others.others_in(part.clone());
                for other in others {
                    load[other.vertex - part.start] = p.loads.constant_at(other.vertex);
                }
                for (vertex, force) in p.loads.scaled_in(time, part.clone()) {
                    if others
                        .binary_search_by_key(&vertex, |other| other.vertex)
                        .is_ok()
                    {
                        load[vertex - part.start] += force;
                    }
                }
            });
        }
        self.contacts.add_tractions(&mut self.load);
    }
}

/// The displacement whose elastic force is that of the body and of viscosities of a relaxation time, which is the `share`th part
/// of the step.
pub(super) fn seen<'a, const C: usize>(
    displacement: &'a [SVector<f64, C>],
    start: &StepState<C>,
    memory: &'a mut [SVector<f64, C>],
    share: Option<f64>,
) -> &'a [SVector<f64, C>] {
    let Some(share) = share else {
        return displacement;
    };
    for_parts(0..memory.len(), &mut *memory, &|part, seen| {
        let ends = displacement[part.clone()]
            .iter()
            .zip(&start.displacement[part]);
        for (seen, (new, old)) in seen.iter_mut().zip(ends) {
            *seen = new + (new - old) * share;
        }
    });
    memory
}

//! Slip rates in balance with the forces of a stage.

use nalgebra::SVector;
use stickslip_solvers::Potentials;

use super::RungeKutta;
use super::tableau::STAGES;
use super::threads::on_shares;
use crate::contact::{ContactSet, DiscreteContact};
use crate::{ContactState, StepError, StepState};

/// The state under the normal stress in force, from that of an accepted step, and its derivative in the latter.
#[inline]
pub(super) fn moved<const C: usize>(
    (contact, accepted): (&DiscreteContact<C>, &[f64]),
    k: usize,
    state: f64,
) -> Result<(f64, f64), StepError> {
    contact.moved(k, state, [accepted[k], contact.normal_stress[k]])
}

/// The contacts with the ranges of their states in the list of all states.
pub(super) fn numbered<'a, const C: usize>(
    contacts: &'a ContactSet<C>,
    state: &'a StepState<C>,
) -> impl Iterator<Item = (&'a DiscreteContact<C>, &'a ContactState<C>, usize)> {
    let mut first = 0;
    let contacts = contacts.contacts.iter().zip(&state.contacts);
    contacts.map(move |(contact, at)| {
        let begin = first;
        first += at.states.len();
        (contact, at, begin)
    })
}

impl<const C: usize> RungeKutta<C> {
    /// The slopes of a stage at a time, with its elastic forces known. An error names what is not finite first.
    pub(super) fn evaluate(&mut self, stage: usize, time: f64) -> Result<(), StepError> {
        let evaluated = self.find_slopes(stage, time);
        evaluated.map_err(|error| self.source_of(stage, time, error))
    }

    /// The slopes of a stage. States are stored as under the normal stress at
    /// the beginning of the step; in this form they are independent of the normal stress.
    pub(super) fn find_slopes(&mut self, stage: usize, time: f64) -> Result<(), StepError> {
        self.balanced = None;
        let slope = &mut self.slopes[stage];
        (self.contacts).set_normal_stress(time, &self.stage.displacement)?;
        // Many cells have their states from the stage; contacts need those of the ends of a step.
        let inside = self.many_cells.is_some() && 0 < stage && stage < STAGES - 1;
        let inside = inside && !self.contacts.have_fields();
        let contacts = &mut self.contacts.contacts[..];
        let contacts = if inside { &mut contacts[..0] } else { contacts };
        let mut first = 0;
        for (contact, at) in contacts.iter_mut().zip(&self.now.contacts) {
            let end = first + at.states.len();
            let states = &self.stage.states[first..end];
            if self.follows && contact.trial.follows_normal_stress() {
                for (k, &unmoved) in states.iter().enumerate() {
                    let (state, moved_by) = moved((contact, &at.normal_stress), k, unmoved)?;
                    contact.trial.set_state(k, state);
                    slope.states[first + k] = moved_by;
                }
            } else {
                for (k, &state) in states.iter().enumerate() {
                    contact.trial.set_state(k, state);
                }
            }
            first = end;
        }
        self.loads.fill(time, &mut self.drive, &mut self.scratch);
        let elastic = &self.elastic.at_stages[stage];
        if self.tractions.is_empty() {
            self.contacts.add_tractions(&mut self.drive);
            for (drive, elastic) in self.drive.iter_mut().zip(elastic) {
                *drive -= elastic;
            }
        } else {
            let tractions = &self.tractions;
            on_shares(&mut self.drive, &|first, drive| {
                let tractions = tractions[first..].iter().zip(&elastic[first..]);
                for (drive, (traction, elastic)) in drive.iter_mut().zip(tractions) {
                    *drive = *drive + traction - elastic;
                }
            });
        }
        let velocity = &mut slope.displacement;
        let prescribed = !self.constraints.held.is_empty();
        if prescribed {
            velocity.fill(SVector::zeros());
            self.constraints.prescribe(time, velocity)?;
            self.contacts.prescribe(&self.constraints.fixed, velocity);
        }
        let viscosity = self.matrices.viscosity();
        // What is left to the free components of a vertex, its velocity being that of the prescribed ones.
        let left = |vertex: usize, held: &SVector<f64, C>| {
            let mut force = self.drive[vertex];
            if prescribed {
                if let Some(viscosity) = viscosity {
                    force -= viscosity.diagonal_block(vertex) * held;
                }
                for c in (0..C).filter(|&c| self.constraints.fixed[vertex][c]) {
                    force[c] = 0.0;
                }
            }
            force
        };
        if let Some(many_cells) = &mut self.many_cells {
            let (contacts, states) = (&self.contacts.contacts, &self.stage.states);
            let rates = (velocity.as_mut_slice(), slope.states.as_mut_slice());
            let balanced = many_cells.rates(contacts, &self.drive, states, rates);
            return balanced.map_err(|(vertex, values)| failed(vertex, time, values));
        }
        for (k, (&vertex, damping)) in self.contacts.vertices.iter().zip(&self.damping).enumerate()
        {
            let own = &mut velocity[vertex];
            if prescribed {
                let force = left(vertex, own);
                *own += self.contacts.minimize(k, damping, &force);
            } else {
                *own = self.contacts.minimize(k, damping, &self.drive[vertex]);
            }
        }
        for (vertex, inverse) in &self.smooth {
            let own = &mut velocity[*vertex];
            let free = inverse * left(*vertex, own);
            *own = if prescribed { *own + free } else { free };
            let speed = own.norm();
            if !speed.is_finite() {
                return Err(failed(*vertex, time, [speed, 0.0, 0.0]));
            }
        }
        for (contact, at, first) in numbered(&self.contacts, &self.now) {
            let follows = self.follows && contact.trial.follows_normal_stress();
            let has_state = !at.states.is_empty();
            for (k, &vertex) in contact.part.vertices.iter().enumerate() {
                let slip_rate = contact.slip_rate(k, velocity);
                let state = if has_state && !follows {
                    self.stage.states[first + k]
                } else {
                    contact.trial.state(k)
                };
                let evolution = contact.trial.laws().evolution(k, slip_rate, state);
                // A maximum with zero, as in Tresca's law, forgets what is not a number.
                let given = self.drive[vertex].sum() + contact.normal_stress[k];
                if !(given.is_finite() && slip_rate.is_finite() && evolution.is_finite()) {
                    return Err(failed(vertex, time, [slip_rate, state, evolution]));
                }
                if has_state {
                    let rate = &mut slope.states[first + k];
                    *rate = if follows {
                        evolution / *rate
                    } else {
                        evolution
                    };
                }
            }
        }
        Ok(())
    }
}

fn failed(vertex: usize, time: f64, [slip_rate, state, evolution]: [f64; 3]) -> StepError {
    StepError::Stage {
        vertex,
        time,
        slip_rate,
        state,
        evolution,
    }
}

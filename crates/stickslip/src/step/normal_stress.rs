//! Forces of a step without an energy: normal stresses that come from the deformation, and skew forces.

use nalgebra::SVector;
use stickslip_time::UpdateFormula;

use super::reactions::{Bearing, Reactions};
use super::{Problem, Workspace};
use crate::laws::StateStep;
use crate::numerics::NUMERICS;
use crate::sums::{agreed, largest, sum};
use crate::{StateUpdate, StepError, StepState};

impl<const C: usize> Workspace<C> {
    /// Solves for rate and state of the new time, and for the normal stresses that follow from them: with these frozen,
    /// again and again, by Anderson's acceleration of the fixed-point iteration.
    pub(super) fn couple_with_reactions(
        &mut self,
        p: &Problem<C>,
        start: &StepState<C>,
        formula: &UpdateFormula,
        (dt, update, time): (f64, StateUpdate, f64),
        single: bool,
    ) -> Result<(), StepError> {
        let Some(mut reactions) = self.reactions.take() else {
            return self.couple(p, start, dt, single);
        };
        let step = StateStep::new(dt, update, formula, p.matrices.has_mass());
        let solved = self.iterate(p, start, (formula, step, time), single, &mut reactions);
        self.again = false;
        self.reactions = Some(reactions);
        solved
    }

    fn iterate(
        &mut self,
        p: &Problem<C>,
        start: &StepState<C>,
        (formula, step, time): (&UpdateFormula, StateStep, f64),
        single: bool,
        reactions: &mut Reactions<C>,
    ) -> Result<(), StepError> {
        let (dt, inertia) = (step.dt, p.matrices.has_mass());
        reactions.anderson.begin();
        let growth = dt / start.last_step;
        let reacts = reactions.bearing.is_some() && reactions.displacement.is_none();
        let extrapolates = single && growth.is_finite() && reacts;
        if extrapolates {
            (self.contacts).extrapolate_normal_stresses(&start.contacts, growth);
        }
        let c_u = formula.displacement.new_velocity;
        let stresses = reactions.stresses;
        if let Some(skew) = &mut reactions.skew {
            skew.begin(&self.load);
            let forces = &mut reactions.iterate[stresses..];
            skew.find(&*p.matrices, (c_u, &self.end.velocity), forces);
            skew.apply(forces, &mut self.load);
        }
        // Explicit displacements leave the fields alone: the pressure of sources as at the start differs by dt^2 from theirs.
        let once = c_u == 0.0 && reactions.bearing.is_none() && reactions.skew.is_none();
        let mut iterations = 0;
        loop {
            self.again = iterations > 0;
            if self.again || extrapolates {
                let begun = (self.contacts).begin_again(step, time, &start.contacts, |vertex| {
                    SVector::from_fn(|c, _| {
                        step.taken_over(formula, start.motion(vertex, c), inertia)
                    })
                });
                agreed(&p.ranks, begun)?;
            }
            self.couple(p, start, dt, single)?;
            iterations += 1;
            self.react(p, reactions, start, (formula, step, time))?;
            let mut error = self.operators.scale(self.contacts.missing_forces());
            if let Some(skew) = &mut reactions.skew {
                let exact = &mut reactions.image[stresses..];
                skew.find(&*p.matrices, (c_u, &self.end.velocity), exact);
                error += self.scale_of_forces(p, (&reactions.iterate[stresses..], exact));
            }
            // That of the strengths of this iterate: the first can have none.
            if once || error <= self.tolerance(&p.method) {
                break;
            }
            if iterations == NUMERICS.evaluations || !error.is_finite() {
                return Err(self.not_contracting(p, reactions, iterations, dt));
            }
            let Reactions {
                anderson,
                weights,
                iterate,
                image,
                skew,
                ..
            } = reactions;
            anderson.advance(&p.ranks, weights, iterate, image);
            self.contacts.try_normal_stresses(iterate);
            if let Some(skew) = skew {
                skew.apply(&iterate[stresses..], &mut self.load);
            }
        }
        // Within the tolerance those of the iterate, and those of the accepted rates where friction is zero, too.
        self.contacts.accept_reactions(&reactions.image);
        if let Some(skew) = &reactions.skew {
            skew.apply(&reactions.image[stresses..], &mut self.load);
        }
        let contraction = reactions.anderson.contraction(&p.ranks, &reactions.weights);
        self.end.report.reaction_iterations += iterations;
        self.end.report.contraction = self.end.report.contraction.max(contraction);
        if contraction >= 1.0 {
            return Err(self.not_contracting(p, reactions, iterations, dt));
        }
        let checked = (self.contacts).check_tension(|vertex| self.rounding_of_forces(p, vertex));
        agreed(&p.ranks, checked)
    }

    /// The rounding of the force at a vertex \[N\], before the displacement follows from the velocity.
    fn rounding_of_forces(&self, p: &Problem<C>, vertex: usize) -> f64 {
        let size = |field: &[SVector<f64, C>]| largest(field.iter().map(SVector::amax));
        let end = &self.end;
        let inertia = p.matrices.mass().map_or(0.0, |mass| {
            mass.diagonal_block(vertex).diagonal().max() * size(&end.acceleration)
        });
        let stiffness = p
            .matrices
            .stiffness()
            .diagonal_block(vertex)
            .diagonal()
            .max();
        let step = self
            .operators
            .step()
            .diagonal_block(vertex)
            .diagonal()
            .max();
        let sum = inertia + stiffness * size(&end.displacement) + step * size(&end.velocity);
        NUMERICS.rounding * sum
    }

    /// Computes the normal stresses of the velocity, with their delay if they have one, and how much friction each vertex
    /// misses by the difference.
    fn react(
        &mut self,
        p: &Problem<C>,
        reactions: &mut Reactions<C>,
        start: &StepState<C>,
        (formula, step, time): (&UpdateFormula, StateStep, f64),
    ) -> Result<(), StepError> {
        if let Some(displacement) = &mut reactions.displacement {
            let c_u = formula.displacement.new_velocity;
            let predicted = self.end.displacement.iter().zip(&self.end.velocity);
            for (u, (predicted, v)) in displacement.iter_mut().zip(predicted) {
                *u = predicted + v * c_u;
            }
            let ended = self.contacts.end_fields(time, &self.end.velocity);
            agreed(&p.ranks, ended)?;
            self.contacts.follow(time, displacement);
        }
        let products = match &mut reactions.bearing {
            None => &[][..],
            Some(Bearing { vertices, products }) => {
                (self.operators.step()).products_at(vertices, &self.end.velocity, products);
                products
            }
        };
        self.compare(products, (&mut reactions.iterate, &mut reactions.image));
        self.find_missing_forces(&mut reactions.image, start, step);
        Ok(())
    }

    /// Writes the normal stresses in trial, and those of the velocity.
    fn compare(
        &mut self,
        products: &[SVector<f64, C>],
        (iterate, image): (&mut [f64], &mut [f64]),
    ) {
        let change = self.contacts.change();
        let (mut first, mut borne) = (0, 0);
        for contact in &self.contacts.contacts {
            let Some(body) = &contact.body else {
                continue;
            };
            for (k, &vertex) in contact.part.vertices.iter().enumerate() {
                let stress = if !contact.reacts() {
                    let change = change.get(vertex).copied().unwrap_or_default();
                    body.beside[k] + change - contact.pore_pressure(k)
                } else if contact.is_open(k, &self.end.velocity[vertex]) {
                    0.0
                } else {
                    let unbalanced = self.load[vertex] - products[borne + k];
                    body.beside[k] + contact.reaction(k, &unbalanced) - contact.pore_pressure(k)
                };
                (iterate[first + k], image[first + k]) = (body.trial[k], stress);
            }
            first += body.trial.len();
            if contact.reacts() {
                borne += body.trial.len();
            }
        }
        self.contacts.share_pressure(image);
    }

    /// Delays normal stresses that have a delay, and finds the friction that each vertex misses with those in trial.
    fn find_missing_forces(
        &mut self,
        mut images: &mut [f64],
        start: &StepState<C>,
        step: StateStep,
    ) {
        for (contact, from) in self.contacts.contacts.iter_mut().zip(&start.contacts) {
            let Some(mut body) = contact.body.take() else {
                continue;
            };
            let (stresses, others) = images.split_at_mut(body.trial.len());
            for (k, stress) in stresses.iter_mut().enumerate() {
                let rate = contact.slip_rate(k, &self.end.velocity);
                if let Some(unrelaxed) = body.unrelaxed.get_mut(k) {
                    *unrelaxed = *stress;
                    let rates = [contact.slip_rate(k, &start.velocity), rate];
                    let vertex = contact.part.vertices[k];
                    if !contact.is_open(k, &self.end.velocity[vertex]) {
                        *stress = contact.relax_stress(k, step, from, *stress, rates);
                    }
                }
                let (coefficient, _) = contact.trial.coefficient_and_rate_slope(k, rate);
                let missing =
                    contact.strength.borne(*stress) - contact.strength.borne(body.trial[k]);
                body.missing[k] = missing.abs() * contact.part.weights[k] * coefficient;
            }
            images = others;
            contact.body = Some(body);
        }
    }

    /// The error at the vertex that misses the largest force, from the process that has it.
    fn not_contracting(
        &self,
        p: &Problem<C>,
        reactions: &Reactions<C>,
        iterations: usize,
        dt: f64,
    ) -> StepError {
        let places = (self.contacts.contacts.iter())
            .filter_map(|contact| Some((contact, contact.body.as_ref()?)))
            .flat_map(|(contact, body)| contact.part.vertices.iter().zip(&body.missing));
        let contraction = reactions.anderson.contraction(&p.ranks, &reactions.weights);
        let own = largest(places.clone().map(|(_, &missing)| missing));
        let of_all = p.ranks.largest(own);
        if own < of_all {
            return StepError::Elsewhere;
        }
        let worst = places.max_by(|(_, a), (_, b)| a.total_cmp(b));
        StepError::NotContracting {
            vertex: worst.map_or(0, |(&vertex, _)| vertex),
            contraction,
            iterations,
            dt,
        }
    }

    /// The velocity that an error of the forces makes, in the norm of the operators.
    pub(super) fn scale_of_forces(&self, p: &Problem<C>, (forces, exact): (&[f64], &[f64])) -> f64 {
        let pairs = forces.chunks_exact(C).zip(exact.chunks_exact(C));
        let squares = pairs.enumerate().map(|(i, (forces, exact))| {
            let free = (0..C).filter(|&c| !p.constraints.fixed[i][c]);
            let square = free.map(|c| (forces[c] - exact[c]).powi(2)).sum::<f64>();
            square / self.operators.step().diagonal_block(i).diagonal().max()
        });
        (sum(squares) / self.contacts.vertices.len().max(1) as f64).sqrt()
    }
}

//! Rate from state and state from rate, on the fields of a simulation.

use nalgebra::SVector;
use stickslip_tnnmg::{Energy, NonsmoothSolver, Operator, Stopping};

use super::operators::Operators;
use super::reduction::{agreed, sum};
use super::{StepMaps, StepState, Trial};
use crate::StepError;
use crate::contact::ContactSet;

/// The parts of a simulation that coupling moves, and those it reads.
pub(super) struct VelocityProblem<'a, Op, const C: usize> {
    pub(super) operators: &'a Operators<Op>,
    pub(super) solver: &'a mut dyn NonsmoothSolver<Op, C>,
    pub(super) contacts: &'a mut ContactSet<C>,
    pub(super) fixed: &'a [[bool; C]],
    /// The last accepted step.
    pub(super) from: &'a StepState<C>,
    /// This step over the last; 0 if there was none.
    pub(super) growth: f64,
    pub(super) trial: &'a mut Trial<C>,
    /// Whether the change of the velocity is one of this step.
    pub(super) changed: bool,
    /// The operator is that of the last step, and likely that of the next: to prepare for measuring changes pays.
    pub(super) recurs: bool,
    pub(super) passages: Passages,
}

/// How far a solver that takes the load of a step once has gone, see [`stickslip_tnnmg::FrictionalSolver`].
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Passages {
    /// The load is condensed.
    loaded: bool,
    /// Frictional vertices have moved since the body followed them.
    behind: bool,
}

/// Below this share of the velocity's norm rounding decides, whatever the tolerance.
const RELATIVE_TOLERANCE: f64 = 1e-14;
/// The share of the forces at a vertex that rounding may leave, many times over.
const ROUNDING: f64 = 1e-11;
/// The roundings of a velocity that the forces at its vertex see, through the stiffness of the step there.
const ROUNDINGS: f64 = 16.0;
/// The shares of the norm of a velocity, and of the norm that its vertices would have one by one, below which a change
/// is what rounding leaves of an iteration.
const RATE_ROUNDING: f64 = 1e-12;
const VERTEX_ROUNDING: f64 = 1e-13;
/// The roundings of friction that a rate sees.
const FRICTION_ROUNDINGS: f64 = 4.0;
/// Above what a solver needs that is made for the problem: 8113 multigrid cycles were seen on nearly incompressible cells.
const MAX_ITERATIONS: usize = 20_000;

impl<Op: Operator<C>, const C: usize> VelocityProblem<'_, Op, C> {
    /// Solves the velocity problem as it stands. Where the solver takes the load of a step once, only the frictional
    /// vertices move, and [`follow`](Self::follow) is due before anything else of the velocity is read.
    pub(super) fn solve(&mut self, tolerance: f64) -> Result<(), StepError> {
        self.load(false)?;
        let energy = energy(self.operators, &self.trial.load, self.contacts, self.fixed);
        let stopping = Stopping {
            norm: self.operators.norm(),
            tolerance,
            relative: RELATIVE_TOLERANCE,
            equivalence: self.operators.equivalence,
            max_iterations: MAX_ITERATIONS,
        };
        let velocity = &mut self.trial.velocity;
        let report = match self.solver.frictional() {
            None => self.solver.minimize(&energy, &stopping, velocity)?,
            Some(frictional) => {
                self.passages.behind = true;
                frictional.minimize_condensed(&energy, &stopping, velocity)?
            }
        };
        self.trial.solver_iterations += report.work();
        Ok(())
    }

    /// Has the load condensed, where the solver does it once a step; if changes are to be `measured`, it may prepare for
    /// that.
    fn load(&mut self, measured: bool) -> Result<(), StepError> {
        let Some(frictional) = self.solver.frictional() else {
            return Ok(());
        };
        let energy = energy(self.operators, &self.trial.load, self.contacts, self.fixed);
        if !self.passages.loaded {
            frictional.condense(&energy, &self.trial.velocity)?;
            self.passages.loaded = true;
        }
        if measured && self.recurs {
            frictional.measure(&energy, self.operators.norm());
        }
        Ok(())
    }

    /// The body follows its frictional vertices, if it has not yet.
    pub(super) fn follow(&mut self) -> Result<(), StepError> {
        if let (true, Some(frictional)) = (self.passages.behind, self.solver.frictional()) {
            frictional.extend(&mut self.trial.velocity)?;
            self.passages.behind = false;
        }
        Ok(())
    }

    /// Shows velocity and change of the vertices that a velocity problem moves.
    fn for_moving(&mut self, f: impl Fn(&mut SVector<f64, C>, &mut SVector<f64, C>)) {
        let (velocity, change) = (&mut self.trial.velocity, &mut self.trial.change);
        if self.solver.frictional().is_some() {
            for &vertex in &self.contacts.vertices {
                f(&mut velocity[vertex], &mut change[vertex]);
            }
        } else {
            for (velocity, change) in velocity.iter_mut().zip(change) {
                f(velocity, change);
            }
        }
    }

    /// Back to the last accepted velocity, where it is an unknown.
    fn restart(&mut self) {
        let velocities = self.trial.velocity.iter_mut().zip(&self.from.velocity);
        for ((velocity, from), fixed) in velocities.zip(self.fixed) {
            for c in (0..C).filter(|&c| !fixed[c]) {
                velocity[c] = from[c];
            }
        }
        self.passages.behind = false;
    }
}

/// The energy of a velocity problem.
fn energy<'a, Op, const C: usize>(
    operators: &'a Operators<Op>,
    load: &'a [SVector<f64, C>],
    contacts: &'a ContactSet<C>,
    fixed: &'a [[bool; C]],
) -> Energy<'a, Op, C> {
    Energy {
        operator: &operators.step,
        load,
        potentials: contacts,
        vertices: &contacts.vertices,
        fixed,
    }
}

impl<Op: Operator<C>, const C: usize> StepMaps for VelocityProblem<'_, Op, C> {
    fn propose_states(&mut self) -> Result<f64, StepError> {
        let proposed = self.contacts.propose(&self.trial.velocity);
        let square = agreed(&self.operators.step, proposed)?;
        Ok(self.operators.step.total(square).sqrt())
    }

    fn secant_factor(&self) -> f64 {
        let products = self.contacts.secant_products();
        let [along, square] = products.map(|product| self.operators.step.total(product));
        -along / square
    }

    fn relax_states(&mut self, relaxation: f64) {
        self.contacts.relax(relaxation);
    }

    fn solve_rates(&mut self, lead: f64, tolerance: f64) -> Result<f64, StepError> {
        // Before the first problem of a step there is no last change.
        let lead = if self.changed { lead } else { 0.0 };
        self.changed = true;
        self.load(true)?;
        self.for_moving(|velocity, change| {
            let previous = *velocity;
            *velocity += *change * lead;
            *change = previous;
        });
        self.solve(tolerance)?;
        self.for_moving(|velocity, change| *change = *velocity - *change);
        let (norm, change) = (self.operators.norm(), &self.trial.change);
        match self.solver.frictional() {
            None => Ok(norm.norm(change)),
            Some(frictional) => {
                let energy = energy(self.operators, &self.trial.load, self.contacts, self.fixed);
                Ok(frictional.change_norm(&energy, norm, change)?)
            }
        }
    }

    fn solve_once(&mut self, tolerance: f64) -> Result<(), StepError> {
        self.solve(tolerance)
    }

    fn is_balanced(&mut self, tolerance: f64) -> Result<bool, StepError> {
        self.follow()?;
        let (velocity, step) = (&self.trial.velocity, &self.operators.step);
        let products = &mut self.trial.products;
        step.products_at(&self.contacts.vertices, velocity, products);
        let mut vertices = self.contacts.vertices.iter().enumerate();
        let balanced = vertices.all(|(k, &vertex)| {
            let (load, product) = (self.trial.load[vertex], products[k]);
            let mut left = load - product;
            for c in (0..C).filter(|&c| self.fixed[vertex][c]) {
                left[c] = 0.0;
            }
            let terms = load.amax() + product.amax();
            let norm = self
                .operators
                .norm()
                .diagonal_block(vertex)
                .diagonal()
                .max();
            let rounding = ROUNDINGS * f64::EPSILON * velocity[vertex].amax();
            let doubt = rounding.max(tolerance / norm.sqrt());
            let resistance = step.diagonal_block(vertex).diagonal().max();
            let slack = ROUNDING * terms + resistance * doubt;
            (self.contacts).is_balanced(k, &velocity[vertex], &left, (doubt, slack))
        });
        Ok(step.all(balanced))
    }

    fn rate_rounding(&mut self) -> Result<f64, StepError> {
        // A size is asked for: where the last step left the body is near enough.
        let (norm, velocity) = (self.operators.norm(), &self.trial.velocity);
        // What moves a stiff body as a whole has a small norm, and the rounding errors of its vertices a large one.
        let squares = velocity.iter().enumerate().map(|(i, v)| {
            let diagonal = norm.diagonal_block(i).diagonal();
            diagonal.dot(&v.component_mul(v))
        });
        let whole = RATE_ROUNDING * norm.norm(velocity);
        let vertices = VERTEX_ROUNDING * norm.total(sum(squares)).sqrt();
        // Where friction hardly grows with the rate, many rates have the same friction but for its rounding.
        let frictional = self.contacts.vertices.iter().enumerate();
        let squares = frictional.map(|(k, &vertex)| {
            let largest = |operator: &Op| operator.diagonal_block(vertex).diagonal().max();
            let resistance = largest(&self.operators.step);
            let rounding = self.contacts.rate_rounding(k, velocity, resistance);
            largest(norm) * rounding.powi(2)
        });
        let frictional = FRICTION_ROUNDINGS * norm.total(sum(squares)).sqrt();
        Ok(whole.max(vertices).max(frictional))
    }

    fn extrapolate_rates(&mut self) {
        let contacts = self.contacts.contacts.iter().zip(&self.from.contacts);
        for (contact, old) in contacts {
            for (&vertex, earlier) in contact.part.vertices.iter().zip(&old.earlier) {
                let from = &self.from.velocity[vertex];
                for c in (0..C).filter(|&c| !self.fixed[vertex][c]) {
                    self.trial.velocity[vertex][c] = lead(earlier[c], from[c], self.growth);
                }
            }
        }
    }

    fn solve_coupled(&mut self, tolerance: f64) -> Result<(), StepError> {
        self.contacts.eliminate(true);
        let solved = self.solve(tolerance).and_then(|()| self.follow());
        self.contacts.eliminate(false);
        if solved.is_err() {
            self.restart();
        }
        solved
    }

    fn weakening(&self) -> usize {
        let here = self.contacts.weakening(&self.trial.velocity);
        self.operators.step.total(here as f64) as usize
    }

    fn memory(&mut self) -> &mut [f64; 4] {
        &mut self.trial.memory
    }
}

/// Where a component of the rate leads, `growth` times as far on as from `earlier` to `from`: straight on where it
/// grows; where it falls, by its share, so that it neither stops nor turns.
fn lead(earlier: f64, from: f64, growth: f64) -> f64 {
    let ratio = earlier / from;
    if growth > 0.0 && ratio > 1.0 {
        from / (1.0 + growth * (ratio - 1.0))
    } else {
        from + (from - earlier) * growth
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rates_lead_straight_up_and_never_through_rest() {
        assert_eq!(lead(1.0, 3.0, 2.0), 7.0);
        assert_eq!(lead(-1.0, -3.0, 2.0), -7.0);
        assert_eq!(lead(4.0, 2.0, 1.0), 1.0);
        assert_eq!(lead(-4.0, -2.0, 2.0), -2.0 / 3.0);
        // The slip turned or stopped already.
        assert_eq!(lead(1.0, -1.0, 1.0), -3.0);
        assert_eq!(lead(1.0, 0.0, 1.0), 0.0);
        assert_eq!(lead(1.0, f64::from_bits(1), 1e9), 0.0);
        assert_eq!(lead(0.0, 0.0, 1.0), 0.0);
        // No step yet.
        assert_eq!(lead(7.0, 0.0, 0.0), 0.0);
        assert_eq!(lead(7.0, 2.0, 0.0), 2.0);
    }

    /// Its error is of the order of a straight line's.
    #[test]
    fn a_rate_that_falls_leads_to_second_order() {
        let error = |dt: f64| {
            let rate = |t: f64| (-t).exp() + 1.0;
            (lead(rate(-dt), rate(0.0), 0.5) - rate(0.5 * dt)).abs()
        };
        let order = (error(1e-3) / error(5e-4)).log2();
        assert!((order - 2.0).abs() < 1e-2, "{order}");
    }
}

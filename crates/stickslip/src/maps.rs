//! Rate from state and state from rate, on the fields of a simulation.

use nalgebra::SVector;
use stickslip_friction::FrictionLaw;
use stickslip_state::{StateLaw, StateVariable};
use stickslip_tnnmg::{Energy, NonsmoothSolver, Operator, Stopping};

use crate::simulation::Trial;
use crate::{InterfacePotential, StepError, StepMaps};

/// The parts of a simulation that one step moves, and those it reads.
pub(crate) struct Maps<'a, Op, L: FrictionLaw, S: StateLaw, const C: usize>
where
    L::State: From<S::State>,
{
    pub(crate) operator: &'a Op,
    pub(crate) norm: &'a Op,
    pub(crate) solver: &'a mut dyn NonsmoothSolver<Op, InterfacePotential<L, S>, C>,
    pub(crate) vertices: &'a [usize],
    pub(crate) weights: &'a [f64],
    pub(crate) fixed: &'a [[bool; C]],
    /// The velocity of the last accepted step.
    pub(crate) from: &'a [SVector<f64, C>],
    /// That of the frictional vertices one step earlier, and this step over the last.
    pub(crate) earlier: &'a [SVector<f64, C>],
    pub(crate) growth: f64,
    /// `d . N d <= equivalence d . B d`.
    pub(crate) equivalence: f64,
    pub(crate) trial: &'a mut Trial<L, S, C>,
}

impl<Op, L, S, const C: usize> Maps<'_, Op, L, S, C>
where
    Op: Operator<C>,
    L: FrictionLaw,
    S: StateLaw,
    L::State: From<S::State>,
{
    /// Solves the velocity problem for the state in use.
    pub(crate) fn solve(&mut self, tolerance: f64) -> Result<(), StepError> {
        let energy = Energy {
            operator: self.operator,
            load: &self.trial.load,
            potentials: &self.trial.potentials,
            vertices: self.vertices,
            fixed: self.fixed,
        };
        let stopping = Stopping {
            norm: self.norm,
            tolerance,
            relative: RELATIVE_TOLERANCE,
            equivalence: self.equivalence,
            max_iterations: MAX_ITERATIONS,
        };
        let report = self
            .solver
            .minimize(&energy, &stopping, &mut self.trial.velocity)?;
        self.trial.solver_iterations += report.work();
        Ok(())
    }

    fn eliminate(&mut self, eliminated: bool) {
        for potential in &mut self.trial.potentials {
            potential.law.eliminated = eliminated;
        }
    }

    /// Back to the last accepted velocity, where it is an unknown.
    fn restart(&mut self) {
        for ((velocity, from), fixed) in self
            .trial
            .velocity
            .iter_mut()
            .zip(self.from)
            .zip(self.fixed)
        {
            for c in (0..C).filter(|&c| !fixed[c]) {
                velocity[c] = from[c];
            }
        }
    }
}

/// Below this share of the velocity's norm rounding decides, whatever the tolerance.
const RELATIVE_TOLERANCE: f64 = 1e-14;
/// A change of the velocity below this share of its norm is none: what rounding leaves of an iteration
/// with solvers that meet [`RELATIVE_TOLERANCE`].
const ROUNDING: f64 = 1e-12;
/// The velocity problems of a step that are usually enough.
const PATIENCE: usize = 8;
/// Far above what any solver needs that converges.
pub(crate) const MAX_ITERATIONS: usize = 100_000;

impl<Op, L, S, const C: usize> StepMaps for Maps<'_, Op, L, S, C>
where
    Op: Operator<C>,
    L: FrictionLaw,
    S: StateLaw,
    L::State: From<S::State>,
{
    fn propose_states(&mut self) -> Result<f64, StepError> {
        let mut square = 0.0;
        for (k, &vertex) in self.vertices.iter().enumerate() {
            let slip_rate = self.trial.velocity[vertex].norm();
            let law = &self.trial.potentials[k].law;
            let proposed = law
                .start
                .advance(&law.evolution, slip_rate)
                .map_err(|source| StepError::State {
                    vertex,
                    slip_rate,
                    source,
                })?;
            let change = proposed.value() - law.state.value();
            square += self.weights[k] * change * change;
            self.trial.proposed[k] = proposed;
            let differences = &mut self.trial.differences[k];
            *differences = [differences[1], change];
        }
        self.trial.state_changes = [self.trial.state_changes[1], square.sqrt()];
        Ok(square.sqrt())
    }

    fn secant_factor(&self) -> f64 {
        let (mut along, mut square) = (0.0, 0.0);
        for (&[before, now], weight) in self.trial.differences.iter().zip(self.weights) {
            along += weight * before * (now - before);
            square += weight * (now - before) * (now - before);
        }
        -along / square
    }

    fn relax_states(&mut self, relaxation: f64) {
        for (k, proposed) in self.trial.proposed.iter().enumerate() {
            let state = &mut self.trial.potentials[k].law.state;
            // The whole way must not pass through a rounded difference.
            *state = if relaxation == 1.0 {
                *proposed
            } else {
                let from = state.value();
                S::State::from_value(from + relaxation * (proposed.value() - from))
            };
        }
    }

    fn solve_rates(&mut self, tolerance: f64) -> Result<f64, StepError> {
        let trial = &mut *self.trial;
        trial.solves += 1;
        // From the third problem on, what is left is about a geometric series: the next change
        // follows from the last one and the ratio of the changes of the state.
        let ratio = match trial.state_changes {
            [before, now] if trial.solves > 2 && now < before => now / before,
            _ => 0.0,
        };
        for (velocity, change) in trial.velocity.iter_mut().zip(&mut trial.change) {
            let previous = *velocity;
            *velocity += *change * ratio;
            *change = previous;
        }
        self.solve(tolerance)?;
        for (change, velocity) in self.trial.change.iter_mut().zip(&self.trial.velocity) {
            *change = velocity - *change;
        }
        let change = self.norm.norm(&self.trial.change);
        // Only a step that takes its time pays for knowing its rounding errors.
        let rounded = self.trial.solves > PATIENCE
            && change <= ROUNDING * self.norm.norm(&self.trial.velocity);
        Ok(if rounded { 0.0 } else { change })
    }

    fn extrapolate_rates(&mut self) {
        for (&vertex, earlier) in self.vertices.iter().zip(self.earlier) {
            let from = &self.from[vertex];
            for c in (0..C).filter(|&c| !self.fixed[vertex][c]) {
                self.trial.velocity[vertex][c] = from[c] + (from[c] - earlier[c]) * self.growth;
            }
        }
    }

    fn solve_once(&mut self, tolerance: f64) -> Result<(), StepError> {
        self.solve(tolerance)
    }

    fn solve_coupled(&mut self, tolerance: f64) -> Result<usize, StepError> {
        self.eliminate(true);
        let solved = self.solve(tolerance);
        let mut weakening = 0;
        if solved.is_ok() {
            for (&vertex, potential) in self.vertices.iter().zip(&self.trial.potentials) {
                let slip_rate = self.trial.velocity[vertex].norm();
                weakening += usize::from(potential.law.coefficient_slope(slip_rate, ()) < 0.0);
            }
        } else {
            self.restart();
        }
        self.eliminate(false);
        solved.map(|()| weakening)
    }
}

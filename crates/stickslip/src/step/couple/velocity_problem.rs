//! The maps of rate and state on the fields of a simulation.

use nalgebra::SVector;

use super::{CouplingReport, StepMaps, sealed};
use crate::body::{Boundary, Goal};
use crate::contact::ContactSet;
use crate::numerics::NUMERICS;
use crate::step::uniqueness::refusal;
use crate::step::{Problem, Workspace};
use crate::sums::agreed;
use crate::{StepError, StepState};

/// The velocity and the states of a step, which a coupling changes, and the data that it reads.
struct VelocityProblem<'a, const C: usize> {
    p: &'a Problem<C>,
    w: &'a mut Workspace<C>,
    /// The start of the stage.
    start: &'a StepState<C>,
    /// The ratio of this step to the last; 0 if there was none.
    growth: f64,
    /// Whether the change of the velocity is one of this step.
    changed: bool,
    /// Whether a problem has been solved since the velocity was the last accepted one.
    moved: bool,
    /// The operator is that of the last step, and probably that of the next: the preparation for measured changes pays.
    recurs: bool,
    passages: Passages,
}

impl<const C: usize> Workspace<C> {
    /// Solves for rate and state of the new time, from a start. Rates are extrapolated only in a `single` stage.
    pub(in crate::step) fn couple(
        &mut self,
        p: &Problem<C>,
        start: &StepState<C>,
        dt: f64,
        single: bool,
    ) -> Result<(), StepError> {
        self.end.coupling = start.coupling;
        let tolerance = self.tolerance(&p.method);
        let (last, compared, again) = (start.last_step, self.compared, self.again);
        let mut problem = VelocityProblem {
            p,
            start,
            // A stage starts where the one before points to.
            growth: if last > 0.0 && single { dt / last } else { 0.0 },
            w: self,
            changed: false,
            moved: false,
            recurs: !compared && (last == dt || last == 0.0),
            passages: Passages {
                // Skew forces are loads.
                loaded: again && p.matrices.symmetric_part().is_none(),
                behind: false,
            },
        };
        let coupled = if problem.w.contacts.have_state() {
            p.method.coupling.couple(&mut problem, tolerance)
        } else {
            problem.solve(tolerance).map(|()| CouplingReport {
                iterations: 1,
                fell_back: false,
            })
        };
        let coupled = coupled.and_then(|report| problem.follow().map(|()| report));
        let report = coupled.map_err(|cause| refusal(p, self, start, dt, cause))?;
        self.end.report.coupling_iterations += report.iterations;
        self.end.report.fell_back |= report.fell_back;
        Ok(())
    }
}

/// The progress of a solver that condenses the load once per step, see [`stickslip_solvers::FrictionalSolver`].
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Passages {
    /// The load is condensed.
    loaded: bool,
    /// Frictional vertices have moved since the last update of the body.
    behind: bool,
}

impl<const C: usize> VelocityProblem<'_, C> {
    /// Solves the present velocity problem. A solver that condenses the load once per step moves only the frictional
    /// vertices; [`follow`](Self::follow) must then update the body before its velocity is read.
    fn solve(&mut self, tolerance: f64) -> Result<(), StepError> {
        self.load(false)?;
        let w = &mut *self.w;
        let goal = Goal {
            tolerance,
            relative: NUMERICS.relative,
            equivalence: w.operators.equivalence,
            max_iterations: NUMERICS.max_iterations,
        };
        let velocity = &mut w.end.velocity;
        let problem = boundary(self.p, &w.load, &w.contacts);
        self.passages.behind = true;
        self.moved = true;
        let body = &mut w.operators.body;
        let solved = match w.free.solved {
            true => body.minimize_others(&problem, goal, velocity),
            false => body.minimize(&problem, goal, velocity),
        };
        let report = agreed(&self.p.ranks, solved.map_err(Into::into))?;
        w.solver_iterations += report.work();
        Ok(())
    }

    /// Condenses the load, if the solver does so once per step; if changes are to be `measured`, the solver can prepare
    /// for that.
    fn load(&mut self, measured: bool) -> Result<(), StepError> {
        let w = &mut *self.w;
        let problem = boundary(self.p, &w.load, &w.contacts);
        if !self.passages.loaded {
            w.operators.body.condense(&problem, &w.end.velocity)?;
            self.passages.loaded = true;
        }
        if measured && self.recurs {
            w.operators.body.measure(&problem);
        }
        Ok(())
    }

    /// Updates the body for the motion of its frictional vertices, if necessary.
    fn follow(&mut self) -> Result<(), StepError> {
        if self.passages.behind {
            self.w.operators.body.extend(&mut self.w.end.velocity)?;
            self.passages.behind = false;
        }
        Ok(())
    }

    /// Applies a function to velocity and change at the vertices that a velocity problem moves.
    fn for_moving(&mut self, f: impl Fn(&mut SVector<f64, C>, &mut SVector<f64, C>)) {
        let (velocity, change) = (&mut self.w.end.velocity, &mut self.w.change);
        if self.w.free.solved {
            for vertex in self.w.free.others() {
                f(&mut velocity[vertex], &mut change[vertex]);
            }
        } else if self.w.operators.body.condenses() {
            for &vertex in &self.w.contacts.vertices {
                f(&mut velocity[vertex], &mut change[vertex]);
            }
        } else {
            for (velocity, change) in velocity.iter_mut().zip(change) {
                f(velocity, change);
            }
        }
    }

    /// Sets the change of free vertices by the next problem: from the last accepted velocity, if it is the first one, else zero.
    fn change_free(&mut self, first: bool) {
        let w = &mut *self.w;
        for part in w.free.ranges(w.change.len()) {
            if first {
                let ends = w.end.velocity[part.clone()]
                    .iter()
                    .zip(&self.start.velocity[part.clone()]);
                for (change, (new, old)) in w.change[part].iter_mut().zip(ends) {
                    *change = new - old;
                }
            } else {
                w.change[part].fill(SVector::zeros());
            }
        }
    }

    /// Resets the unknowns to the last accepted velocity.
    fn restart(&mut self) {
        self.moved = false;
        if self.w.free.solved {
            // The free vertices have the velocity of every solution.
            for vertex in self.w.free.others() {
                let from = &self.start.velocity[vertex];
                let fixed = &self.p.constraints.fixed[vertex];
                for c in (0..C).filter(|&c| !fixed[c]) {
                    self.w.end.velocity[vertex][c] = from[c];
                }
            }
            return;
        }
        let velocities = self.w.end.velocity.iter_mut().zip(&self.start.velocity);
        for ((velocity, from), fixed) in velocities.zip(&self.p.constraints.fixed) {
            for c in (0..C).filter(|&c| !fixed[c]) {
                velocity[c] = from[c];
            }
        }
        self.passages.behind = false;
    }
}

/// A velocity problem beside its matrix.
fn boundary<'a, const C: usize>(
    p: &'a Problem<C>,
    load: &'a [SVector<f64, C>],
    contacts: &'a ContactSet<C>,
) -> Boundary<'a, C> {
    Boundary {
        load,
        potentials: contacts,
        vertices: &contacts.vertices,
        fixed: &p.constraints.fixed,
    }
}

impl<const C: usize> sealed::Sealed for VelocityProblem<'_, C> {}

impl<const C: usize> StepMaps for VelocityProblem<'_, C> {
    fn propose_states(&mut self) -> Result<f64, StepError> {
        let proposed = self.w.contacts.propose(&self.w.end.velocity);
        let square = agreed(&self.p.ranks, proposed)?;
        Ok(self.p.ranks.sum(square).sqrt())
    }

    fn secant_factor(&self) -> f64 {
        let products = self.w.contacts.secant_products();
        let [along, square] = products.map(|product| self.p.ranks.sum(product));
        -along / square
    }

    fn relax_states(&mut self, relaxation: f64) {
        self.w.contacts.relax(relaxation);
    }

    fn solve_rates(&mut self, lead: f64, tolerance: f64) -> Result<f64, StepError> {
        // Before the first problem of a step there is no last change.
        let lead = if self.changed { lead } else { 0.0 };
        self.changed = true;
        self.load(true)?;
        if self.w.free.solved {
            self.change_free(!self.moved);
        }
        self.for_moving(|velocity, change| {
            let previous = *velocity;
            *velocity += *change * lead;
            *change = previous;
        });
        self.solve(tolerance)?;
        self.for_moving(|velocity, change| *change = *velocity - *change);
        let w = &mut *self.w;
        let problem = boundary(self.p, &w.load, &w.contacts);
        Ok(w.operators.body.change_norm(&problem, &w.change)?)
    }

    fn solve_once(&mut self, tolerance: f64) -> Result<(), StepError> {
        self.solve(tolerance)
    }

    fn rate_rounding(&mut self) -> Result<f64, StepError> {
        Ok(self.w.rounding(&self.p.ranks))
    }

    fn extrapolate_rates(&mut self) {
        if self.w.again {
            // The rates of the last normal stresses are nearer.
            return;
        }
        let contacts = self.w.contacts.contacts.iter().zip(&self.start.contacts);
        for (contact, old) in contacts {
            for (&vertex, earlier) in contact.part.vertices.iter().zip(&old.earlier) {
                let from = &self.start.velocity[vertex];
                for c in (0..C).filter(|&c| !self.p.constraints.fixed[vertex][c]) {
                    let led = from[c] + self.growth * (from[c] - earlier[c]);
                    // Friction stops a component before it turns.
                    let turns = led * from[c] < 0.0;
                    self.w.end.velocity[vertex][c] = if turns { 0.0 } else { led };
                }
            }
        }
    }

    fn solve_coupled(&mut self, tolerance: f64) -> Result<(), StepError> {
        self.w.contacts.eliminate(true);
        let solved = self.solve(tolerance).and_then(|()| self.follow());
        self.w.contacts.eliminate(false);
        if solved.is_err() {
            self.restart();
        }
        solved
    }

    fn memory(&mut self) -> &mut [f64; 4] {
        &mut self.w.end.coupling
    }
}

//! The nonsmooth Newton iteration on the condensed problem.

use nalgebra::SVector;
use stickslip_friction::ConvexPotential;

use crate::line_search::{Line, search};
use crate::progress::Progress;
use crate::{BlockMatrix, Energy, SolveError, SolveReport};

use super::boundary::Boundary;

/// The share of the tolerance that an estimated error must keep to.
const SAFETY: f64 = 0.3;

/// The ratio of successive errors, squared, up to which a factor serves for another step.
const REUSE: f64 = 0.01;

/// When the iteration is finished.
pub(super) struct Goal {
    pub(super) tolerance: f64,
    /// The caller's bound of the square of the stopping norm by that of the energy's.
    pub(super) equivalence: f64,
    /// A field that is as exact as its rounding errors allow is good enough.
    pub(super) rounding: bool,
    pub(super) max_iterations: usize,
}

/// How one step went: the square of the estimated error it leaves, and of the step itself.
struct Step {
    left: f64,
    taken: f64,
    /// It was neither shortened nor bent, and led to where the potentials are smooth.
    whole: bool,
}

impl<const C: usize> Boundary<C> {
    /// Moves `y` to the minimiser; `norm` measures a change of `y` in the stopping norm.
    pub(super) fn minimize<P: ConvexPotential<C>>(
        &mut self,
        schur: &[f64],
        energy: &Energy<'_, BlockMatrix<C>, P, C>,
        ratio: f64,
        goal: &Goal,
        norm: &mut dyn FnMut(&[SVector<f64, C>]) -> f64,
    ) -> Result<SolveReport, SolveError> {
        let potentials = energy.potentials;
        let mut iteration = 0;
        let mut change = f64::INFINITY;
        let mut before = f64::INFINITY;
        let mut progress = Progress::new();
        self.balance(schur);
        while iteration < goal.max_iterations {
            iteration += 1;
            self.start.copy_from_slice(&self.y);
            self.sweep(schur, potentials);
            self.truncate(schur, potentials, ratio);
            self.factorize(schur).map_err(|k| SolveError::NotConvex {
                vertex: energy.vertices[k],
                iteration,
            })?;
            let mut square = self.aim();
            loop {
                let step = self.step(schur, energy, square);
                if !(step.left + step.taken).is_finite() {
                    let change = step.taken.sqrt();
                    return Err(SolveError::NotFinite { iteration, change });
                }
                square = step.left;
                let ahead = self.sweep_ahead(schur, potentials);
                let shrinking = step.left <= 0.25 * step.taken;
                // A chord step with the ratio q leaves 1/(1 - q) of what the next one would take.
                let next = if shrinking {
                    4.0 * step.left
                } else {
                    step.left.max(step.taken)
                };
                change = (goal.equivalence.min(f64::MAX) * (next + ahead)).sqrt();
                if step.whole && goal.equivalence.is_infinite() && change > 0.0 {
                    let safety = (next + ahead) / (step.left + ahead);
                    change = safety.sqrt() * norm(&self.direction);
                }
                if step.whole && change <= SAFETY * goal.tolerance {
                    return Ok(report(iteration, change));
                }
                // Far from the rounding errors a step is far shorter than the one before.
                let stalled = !shrinking || step.taken > 0.25 * before;
                before = step.taken;
                if step.whole && stalled && goal.rounding && self.is_rounded(schur) {
                    return Ok(report(iteration, norm(&self.direction)));
                }
                let reusable = step.whole && step.left <= REUSE * step.taken;
                if !reusable || ahead > step.left || iteration == goal.max_iterations {
                    break;
                }
                self.drop_truncated();
                iteration += 1;
            }
            // Where kinks are never left behind, as in a body at rest, only the change tells.
            let moved = self.moved(schur, goal, norm);
            if moved <= goal.tolerance {
                return Ok(report(iteration, moved));
            }
            if !progress.goes_on(moved, goal.tolerance) {
                break;
            }
        }
        Err(SolveError::NotConverged {
            iterations: iteration,
            change,
            tolerance: goal.tolerance,
        })
    }

    /// By how much `y` changed since the start of the iteration.
    fn moved(
        &mut self,
        schur: &[f64],
        goal: &Goal,
        norm: &mut dyn FnMut(&[SVector<f64, C>]) -> f64,
    ) -> f64 {
        for ((direction, y), start) in self.direction.iter_mut().zip(&self.y).zip(&self.start) {
            *direction = y - start;
        }
        if goal.equivalence.is_finite() {
            (goal.equivalence * self.energy_square(schur)).sqrt()
        } else {
            norm(&self.direction)
        }
    }

    /// Follows the direction, of square `square`, and aims anew with the same factor.
    fn step<P: ConvexPotential<C>>(
        &mut self,
        schur: &[f64],
        energy: &Energy<'_, BlockMatrix<C>, P, C>,
        square: f64,
    ) -> Step {
        let (mut decrease, mut curvature) = (square, square);
        let projected = self.project(energy.potentials);
        if projected {
            (decrease, curvature) = self.slopes(schur);
        }
        // Nearly always the whole step is taken: its slope comes from the gradients needed next.
        let ahead = self.differentiate(energy.potentials, 1.0);
        let slope = curvature - decrease + ahead.bend;
        let along_boundary = Energy {
            vertices: &self.places,
            ..*energy
        };
        let line = Line {
            energy: &along_boundary,
            from: &self.y,
            along: &self.direction,
            decrease,
            curvature,
            gradients: &self.gradients,
            hessians: &self.hessians,
        };
        let length = search(&line, ahead.smooth.then_some((slope, ahead.noise)));
        let smooth = if length == 1.0 {
            ahead.smooth
        } else {
            self.differentiate(energy.potentials, length).smooth
        };
        std::mem::swap(&mut self.gradients, &mut self.gradients_ahead);
        for (y, d) in self.y.iter_mut().zip(&self.direction) {
            *y += d * length;
        }
        self.balance(schur);
        let left = self.aim();
        Step {
            left,
            taken: curvature * length * length,
            whole: !projected && smooth && (length == 1.0 || square == 0.0),
        }
    }
}

fn report(iterations: usize, error: f64) -> SolveReport {
    SolveReport {
        iterations,
        cycles: 0,
        error,
    }
}

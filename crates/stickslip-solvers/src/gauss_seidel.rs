//! Nonlinear block Gauss-Seidel: slow, simple, globally convergent.

mod acceleration;

use nalgebra::{SMatrix, SVector};

use stickslip_core::compiled;

use crate::block::invert_all;
use crate::parts::inside;
use crate::progress::Progress;
use crate::sweep::Sweep;
use crate::{BlockMatrix, Energy, Matrix, NonsmoothSolver, SolveError, SolveReport, Stopping};
use acceleration::Acceleration;

/// The number of sweeps over which the ratio of successive changes is averaged: of plain ones, and of accelerated ones,
/// whose changes fluctuate.
const WINDOW: usize = 4;
const WIDE: usize = 10;

/// The ratio from which sweeps are accelerated, which makes an iteration five times as long.
const SLOW: f64 = 0.9;

/// The share of the tolerance for the estimate: the smoothest part of an error, the last to decay, may be far slower
/// than the observed ratio.
const SAFETY: f64 = 1e-2;

/// Enough sweeps for any body of this solver, plus those per vertex: static plane bodies, the slowest, were solved to
/// rounding with 51 to 100. More are needed by nearly incompressible or stretched bodies.
const SWEEPS: usize = 1000;
const SWEEPS_A_VERTEX: usize = 100;

/// The number of sweeps over which stall detection judges progress.
const WATCHED: usize = 250;

/// Nonlinear block Gauss-Seidel: sweeps over the vertices, each local problem solved exactly.
///
/// With successive changes of the ratio `q`, averaged over four sweeps, the remaining error is about `q/(1 - q)` times
/// the last change; the solver compares it with the tolerance. If `q` is above 0.9, sweeps are accelerated: an
/// iteration is a forward and a backward sweep, followed by a minimisation over the plane of their change and the step
/// before; `q` is then that of the largest of ten changes. The number of iterations grows with the vertices across the
/// body, and not with the square. Nearly incompressible bodies (Poisson's ratio 0.4999) with thousands of plain sweeps
/// were solved by some 300. If [`Stopping::relative`] is positive, forces at the level of their rounding errors end the
/// iteration, too. The solver is an oracle for [`Tnnmg`](crate::Tnnmg) on small meshes.
///
/// Stall detection gives up a problem that needs more than 1000 iterations and 100 per vertex, before
/// [`Stopping::max_iterations`]. Use another solver for it.
#[derive(Debug, Clone, Default)]
pub struct BlockGaussSeidel<const C: usize> {
    sweep: Sweep<C>,
    inverses: Vec<SMatrix<f64, C, C>>,
    change: Vec<SVector<f64, C>>,
    change_back: Vec<SVector<f64, C>>,
    acceleration: Acceleration<C>,
}

impl<const C: usize> BlockGaussSeidel<C> {
    /// A solver without an operator so far.
    pub fn new() -> Self {
        Self::default()
    }
}

impl<const C: usize> NonsmoothSolver<BlockMatrix<C>, C> for BlockGaussSeidel<C> {
    fn boxed_clone(&self) -> Box<dyn NonsmoothSolver<BlockMatrix<C>, C>> {
        Box::new(self.clone())
    }

    fn prepare(&mut self, energy: &Energy<'_, BlockMatrix<C>, C>) -> Result<(), SolveError> {
        let size = energy.operator.rows();
        for change in [&mut self.change, &mut self.change_back] {
            change.resize(size, SVector::zeros());
        }
        self.acceleration.resize(size, energy.vertices.len());
        self.sweep.prepare(energy)?;
        invert_all(energy.operator, energy.fixed, &mut self.inverses)
    }

    fn minimize(
        &mut self,
        energy: &Energy<'_, BlockMatrix<C>, C>,
        stopping: &Stopping<'_, BlockMatrix<C>>,
        v: &mut [SVector<f64, C>],
    ) -> Result<SolveReport, SolveError> {
        self.sweep.check(energy, stopping.norm, v)?;
        inside(v.len(), || self.iterate(energy, stopping, v))
    }

    fn into_object(self) -> Box<dyn NonsmoothSolver<BlockMatrix<C>, C>> {
        object(self)
    }
}

compiled! {
    fn object<C>(solver: BlockGaussSeidel<C>) -> Box<dyn NonsmoothSolver<BlockMatrix<C>, C>> {
        Box::new(solver)
    }
}

impl<const C: usize> BlockGaussSeidel<C> {
    fn iterate(
        &mut self,
        energy: &Energy<'_, BlockMatrix<C>, C>,
        stopping: &Stopping<'_, BlockMatrix<C>>,
        v: &mut [SVector<f64, C>],
    ) -> Result<SolveReport, SolveError> {
        let relative = stopping.relative * stopping.norm.norm(v);
        let mut tolerance = stopping.tolerance.max(relative);
        let mut pace = StallDetection::default();
        let mut change = f64::INFINITY;
        let enough = SWEEPS + SWEEPS_A_VERTEX * energy.operator.rows();
        let max_iterations = stopping.max_iterations.min(enough);
        let mut progress = Progress::new(WATCHED, enough as f64 / WATCHED as f64);
        let (mut iteration, mut slow) = (0, false);
        while iteration < max_iterations {
            iteration += 1;
            let blocks = (energy, Some(&*self.inverses));
            self.sweep.forward(blocks, v, &mut self.change);
            if slow {
                self.sweep.backward(blocks, v, &mut self.change_back);
                for (change, back) in self.change.iter_mut().zip(&self.change_back) {
                    *change += back;
                }
                let scale = |k| self.sweep.scale(k);
                (self.acceleration).advance(energy, scale, v, &mut self.change);
            }
            change = stopping.norm.norm(&self.change);
            if !change.is_finite() {
                return Err(SolveError::NotFinite { iteration, change });
            }
            tolerance = tolerance.max(stopping.relative * change);
            let (largest, ratio) = pace.take(change, slow);
            let error = largest * ratio / (1.0 - ratio);
            let converged = (0.0..=SAFETY * tolerance).contains(&error);
            // A plain sweep contracts until rounding is all that is left of the change. Accelerated ones pause, and what
            // rounding does to soft directions may be far above the tolerance.
            let settled = !slow && change <= tolerance;
            let rounded = || stopping.relative > 0.0 && self.sweep.is_rounded(energy, v);
            let exhausted = ratio >= 1.0 && (settled || rounded());
            // The fast parts of an error go first: sweeps to come are no better than the last ones.
            // No change is small enough for sweeps that do not contract.
            let small_enough = SAFETY * tolerance * (ratio.recip() - 1.0).max(0.0);
            let goes_on = progress.goes_on(change, small_enough);
            let stalled = slow && !goes_on && change <= tolerance;
            if converged || exhausted || stalled || change == 0.0 {
                return Ok(SolveReport {
                    iterations: iteration,
                    cycles: 0,
                    error: if converged { error } else { change },
                });
            }
            if !goes_on {
                break;
            }
            if !slow && ratio > SLOW {
                slow = true;
                pace = StallDetection::default();
                self.acceleration.begin();
            }
        }
        Err(SolveError::NotConverged {
            iterations: iteration,
            change,
            tolerance: stopping.tolerance,
        })
    }
}

/// The changes of the last sweeps, the latest last.
#[derive(Debug, Clone)]
struct StallDetection {
    changes: [f64; 2 * WIDE],
    count: usize,
}

impl Default for StallDetection {
    fn default() -> Self {
        Self {
            changes: [f64::INFINITY; 2 * WIDE],
            count: 0,
        }
    }
}

impl StallDetection {
    /// Adds a change. Returns the largest of the last ones and their decay per sweep; before there are enough changes
    /// neither number counts.
    fn take(&mut self, change: f64, accelerated: bool) -> (f64, f64) {
        self.changes.rotate_left(1);
        self.changes[2 * WIDE - 1] = change;
        self.count += 1;
        if !accelerated {
            let oldest = self.changes[2 * WIDE - 1 - WINDOW];
            let ratio = (change / oldest).powf(1.0 / WINDOW as f64);
            let known = self.count > WINDOW;
            return (change, if known { ratio } else { f64::NAN });
        }
        let largest = |changes: &[f64]| changes.iter().copied().fold(0.0, f64::max);
        let (before, now) = self.changes.split_at(WIDE);
        let (before, now) = (largest(before), largest(now));
        let known = self.count >= 2 * WIDE;
        let ratio = (now / before).powf(1.0 / WIDE as f64);
        (now, if known { ratio } else { f64::NAN })
    }
}

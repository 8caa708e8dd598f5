//! Nonlinear block Gauss-Seidel: slow, simple, globally convergent.

use nalgebra::SVector;

use crate::parts::inside;
use crate::progress::Progress;
use crate::sweep::Sweep;
use crate::{BlockMatrix, Energy, NonsmoothSolver, Operator, SolveError, SolveReport, Stopping};

/// The number of sweeps over which the ratio of successive changes is averaged.
const WINDOW: usize = 4;

/// The share of the tolerance that the estimate must keep to: the smoothest part of an error, which
/// is the last to go, may be far slower than the ratio seen.
const SAFETY: f64 = 1e-2;

/// The sweeps that are enough for any body this solver is for, and those more for each of its vertices: static plane
/// bodies, the slowest, were solved to rounding with 51 to 100. What takes more is nearly incompressible or stretched.
const SWEEPS: usize = 1000;
const SWEEPS_A_VERTEX: usize = 100;

/// The sweeps over which progress is judged.
const WATCHED: usize = 250;

/// Sweeps over the vertices, each local problem solved exactly, until the error is small.
///
/// The number of sweeps grows with the square of the number of vertices across the body: an oracle
/// for [`Tnnmg`](crate::Tnnmg) on small meshes. With successive changes of the ratio `q`, averaged
/// over four sweeps, the error left is about `q/(1 - q)` times the last change; that is what is
/// compared with the tolerance. A problem that needs more than 1000 sweeps and 100 for each vertex is given up
/// as soon as that shows, and before [`Stopping::max_iterations`]: another solver is the one for it.
#[derive(Debug, Clone, Default)]
pub struct BlockGaussSeidel<const C: usize> {
    sweep: Sweep<C>,
    change: Vec<SVector<f64, C>>,
}

impl<const C: usize> BlockGaussSeidel<C> {
    /// A solver that has not yet seen an operator.
    pub fn new() -> Self {
        Self::default()
    }
}

impl<const C: usize> NonsmoothSolver<BlockMatrix<C>, C> for BlockGaussSeidel<C> {
    fn prepare(&mut self, energy: &Energy<'_, BlockMatrix<C>, C>) -> Result<(), SolveError> {
        self.change.resize(energy.operator.rows(), SVector::zeros());
        self.sweep.prepare(energy)
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
        let mut changes = [f64::INFINITY; WINDOW];
        let mut change = f64::INFINITY;
        let enough = SWEEPS + SWEEPS_A_VERTEX * energy.operator.rows();
        let max_iterations = stopping.max_iterations.min(enough);
        let mut progress = Progress::new(WATCHED, enough as f64 / WATCHED as f64);
        let mut iteration = 0;
        while iteration < max_iterations {
            iteration += 1;
            self.sweep.forward(energy, v, &mut self.change);
            change = stopping.norm.norm(&self.change);
            if !change.is_finite() {
                return Err(SolveError::NotFinite { iteration, change });
            }
            tolerance = tolerance.max(stopping.relative * change);
            let oldest = std::mem::replace(&mut changes[iteration % WINDOW], change);
            let ratio = (change / oldest).powf(1.0 / WINDOW as f64);
            let error = change * ratio / (1.0 - ratio);
            let converged = iteration > WINDOW && (0.0..=SAFETY * tolerance).contains(&error);
            // A sweep contracts until rounding is all that is left of the change.
            let exhausted = change <= tolerance && ratio >= 1.0;
            if converged || exhausted || change == 0.0 {
                return Ok(SolveReport {
                    iterations: iteration,
                    cycles: 0,
                    error: if converged { error } else { change },
                });
            }
            // The fast parts of an error go first: sweeps to come are no better than the last ones.
            let small_enough = SAFETY * tolerance * (ratio.recip() - 1.0);
            if !progress.goes_on(change, small_enough) {
                break;
            }
        }
        Err(SolveError::NotConverged {
            iterations: iteration,
            change,
            tolerance: stopping.tolerance,
        })
    }
}

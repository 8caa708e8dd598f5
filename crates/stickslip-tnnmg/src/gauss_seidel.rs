//! Nonlinear block Gauss-Seidel: slow, simple, globally convergent.

use nalgebra::SVector;
use stickslip_friction::ConvexPotential;

use crate::sweep::Sweep;
use crate::{BlockMatrix, Energy, NonsmoothSolver, Operator, SolveError, SolveReport, Stopping};

/// Sweeps over the vertices, each local problem solved exactly, until the error is small.
///
/// The number of sweeps grows with the square of the number of vertices across the body: an oracle
/// for [`Tnnmg`](crate::Tnnmg) on small meshes. With successive changes of the ratio `q`, the error
/// left is about `q/(1 - q)` times the last change; that is what is compared with the tolerance.
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

impl<P: ConvexPotential<C>, const C: usize> NonsmoothSolver<BlockMatrix<C>, P, C>
    for BlockGaussSeidel<C>
{
    fn prepare(&mut self, energy: &Energy<'_, BlockMatrix<C>, P, C>) -> Result<(), SolveError> {
        self.change.resize(energy.operator.rows(), SVector::zeros());
        self.sweep.prepare(energy)
    }

    fn minimize(
        &mut self,
        energy: &Energy<'_, BlockMatrix<C>, P, C>,
        stopping: &Stopping<'_, BlockMatrix<C>>,
        v: &mut [SVector<f64, C>],
    ) -> Result<SolveReport, SolveError> {
        let relative = stopping.relative * stopping.norm.norm(v);
        let mut goal = stopping.tolerance.max(relative);
        let mut previous = f64::INFINITY;
        let mut change = f64::INFINITY;
        for iteration in 1..=stopping.max_iterations {
            for (change, v) in self.change.iter_mut().zip(&*v) {
                *change = -v;
            }
            self.sweep.forward(energy, v);
            for (change, v) in self.change.iter_mut().zip(&*v) {
                *change += v;
            }
            change = stopping.norm.norm(&self.change);
            if !change.is_finite() {
                return Err(SolveError::NotFinite { iteration, change });
            }
            goal = goal.max(stopping.relative * change);
            let ratio = change / previous;
            let error = if change == 0.0 {
                0.0
            } else {
                change * ratio / (1.0 - ratio)
            };
            // Within the first sweeps the ratio is that of the rough part of the error.
            if change == 0.0 || (iteration > 2 && (0.0..=goal).contains(&error)) {
                return Ok(SolveReport {
                    iterations: iteration,
                    cycles: 0,
                    error,
                });
            }
            previous = change;
        }
        Err(SolveError::NotConverged {
            iterations: stopping.max_iterations,
            change,
            tolerance: stopping.tolerance,
        })
    }
}

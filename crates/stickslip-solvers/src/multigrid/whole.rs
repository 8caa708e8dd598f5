//! A factor of the finest level that replaces slowly converging cycles.
//!
//! Cycles are slow for nearly incompressible bodies and stretched cells. On a small level they then cost more than a
//! factor, whatever the number of truncated vertices. The choice depends on the problem alone: each minimisation starts
//! with cycles, and a restarted run takes the same steps.

use nalgebra::SVector;

use super::coarse::CoarseSolver;
use super::level::Level;
use crate::BlockMatrix;

/// Cycles between two tests of the convergence rate of a linear problem.
pub(crate) const LOOK: usize = 4;
/// The least cost of a factor with its solves, in cycles: that for a matrix of few entries.
const LEAST: f64 = 12.0;
/// Operations of a factor, per entry of the matrix, that cost one cycle.
const A_CYCLE: f64 = 12.0;
/// Largest number of unknowns of a level with a factor, before its fill is known.
const UNKNOWNS: usize = 20_000;

/// The factor, and whether it replaces cycles.
#[derive(Debug, Default)]
pub(super) struct Whole<const C: usize> {
    /// The solver and its cost in cycles.
    solver: Option<(CoarseSolver<C>, f64)>,
    pub(super) in_use: bool,
}

impl<const C: usize> Whole<C> {
    /// Replaces so many cycles by a factor of the level, if it costs less; allocates at the first call.
    pub(super) fn replace_cycles(
        &mut self,
        ahead: f64,
        level: &mut Level<C>,
        operator: &BlockMatrix<C>,
    ) -> bool {
        let unknowns = C * level.size();
        if !(ahead > LEAST && unknowns <= UNKNOWNS) {
            return false;
        }
        level.keep_matrix(operator);
        if self.solver.is_none() {
            let solver = CoarseSolver::analyse(operator).ok();
            self.solver = solver.map(|solver| {
                // The square of a column's mean length for each column.
                let operations = (solver.entries() as f64).powi(2) / unknowns as f64;
                let entries = (C * C * operator.nnz()) as f64;
                (solver, LEAST.max(operations / entries / A_CYCLE))
            });
        }
        if self.solver.as_ref().is_some_and(|&(_, cost)| ahead > cost) {
            self.factorize(level);
        }
        self.in_use
    }

    /// Factorises the current level; cycles return if rounding has made it indefinite.
    pub(super) fn factorize(&mut self, level: &Level<C>) {
        let parts = self.solver.as_mut().zip(level.matrix.as_ref());
        self.in_use = parts.is_some_and(|((solver, _), matrix)| solver.factorize(matrix).is_ok());
    }

    pub(super) fn solve(
        &mut self,
        level: &Level<C>,
        residual: &[SVector<f64, C>],
        correction: &mut [SVector<f64, C>],
    ) {
        if let Some((solver, _)) = &mut self.solver {
            solver.solve(residual, &level.dropped, correction);
        }
    }
}

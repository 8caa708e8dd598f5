//! A factor of the finest level, in the place of cycles that hardly converge.
//!
//! Cycles get slow where a body is nearly incompressible or its cells are stretched. On a small level they then cost
//! more than a factor does, however many vertices friction has truncated. Which of them a linear problem gets follows
//! from the problem alone: each minimisation starts with cycles, so that a run that is taken up again takes the same
//! steps.

use nalgebra::SVector;

use super::coarse::CoarseSolver;
use super::level::Level;

/// Cycles between two looks at the pace of a linear problem.
pub(crate) const LOOK: usize = 4;
/// A factor with its solves costs as many cycles at least: one of a matrix of few entries.
const LEAST: f64 = 12.0;
/// Operations of a factor, for each entry of the matrix, that cost a cycle.
const A_CYCLE: f64 = 12.0;
/// Unknowns of a level that may have a factor, before anything is known of its fill.
const UNKNOWNS: usize = 20_000;

/// The factor, and whether it takes the place of cycles.
#[derive(Debug, Default)]
pub(super) struct Whole<const C: usize> {
    /// Beside it the number of cycles that it costs.
    solver: Option<(CoarseSolver<C>, f64)>,
    pub(super) in_use: bool,
}

impl<const C: usize> Whole<C> {
    /// Puts a factor of the level in the place of so many cycles, if it costs less; takes memory the first time.
    pub(super) fn replace_cycles(&mut self, ahead: f64, level: &Level<C>) -> bool {
        let matrix = &level.matrix;
        let unknowns = C * matrix.rows();
        if !(ahead > LEAST && unknowns <= UNKNOWNS) {
            return false;
        }
        if self.solver.is_none() {
            let solver = CoarseSolver::analyse(matrix).ok();
            self.solver = solver.map(|solver| {
                // The square of a column's mean length for each column.
                let operations = (solver.entries() as f64).powi(2) / unknowns as f64;
                let entries = (C * C * matrix.nnz()) as f64;
                (solver, LEAST.max(operations / entries / A_CYCLE))
            });
        }
        if self.solver.as_ref().is_some_and(|&(_, cost)| ahead > cost) {
            self.factorize(level);
        }
        self.in_use
    }

    /// A factor of the level as it has become; cycles again where rounding has left it indefinite.
    pub(super) fn factorize(&mut self, level: &Level<C>) {
        let solver = self.solver.as_mut();
        self.in_use = solver.is_some_and(|(solver, _)| solver.factorize(&level.matrix).is_ok());
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

//! Placeholder for a solver that cannot be cloned.

use nalgebra::SVector;

use crate::{Energy, LinearSolver, NonsmoothSolver, SolveError, SolveReport, Stopping};

/// Refuses every problem.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Uncloned;

impl<Op, const C: usize> NonsmoothSolver<Op, C> for Uncloned {
    fn prepare(&mut self, _energy: &Energy<'_, Op, C>) -> Result<(), SolveError> {
        Err(SolveError::NotCloned)
    }

    fn minimize(
        &mut self,
        _energy: &Energy<'_, Op, C>,
        _stopping: &Stopping<'_, Op>,
        _v: &mut [SVector<f64, C>],
    ) -> Result<SolveReport, SolveError> {
        Err(SolveError::NotCloned)
    }
}

impl<Op: ?Sized, const C: usize> LinearSolver<Op, C> for Uncloned {
    fn prepare(&mut self, _operator: &Op, _fixed: &[[bool; C]]) -> Result<(), SolveError> {
        Err(SolveError::NotCloned)
    }

    fn solve(
        &mut self,
        _operator: &Op,
        _load: &[SVector<f64, C>],
        _x: &mut [SVector<f64, C>],
    ) -> Result<(), SolveError> {
        Err(SolveError::NotCloned)
    }
}

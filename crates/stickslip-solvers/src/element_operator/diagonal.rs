//! The solver of explicit steps.

use nalgebra::SVector;
use stickslip_core::compiled;

use super::ElementOperator;
use crate::{BlockMatrix, Diagonal, Energy, NonsmoothSolver, SolveError, SolveReport, Stopping};

/// The problem with the matrix of an explicit step, which has no term by elements.
fn by_matrix<'a, const C: usize>(
    energy: &Energy<'a, ElementOperator<C>, C>,
) -> Result<Energy<'a, BlockMatrix<C>, C>, SolveError> {
    let operator = energy.operator.matrix();
    Ok(Energy {
        operator: operator.ok_or(SolveError::NotDiagonal { vertex: 0 })?,
        load: energy.load,
        potentials: energy.potentials,
        vertices: energy.vertices,
        fixed: energy.fixed,
    })
}

impl<const C: usize> NonsmoothSolver<ElementOperator<C>, C> for Diagonal<C> {
    fn prepare(&mut self, energy: &Energy<'_, ElementOperator<C>, C>) -> Result<(), SolveError> {
        NonsmoothSolver::<BlockMatrix<C>, C>::prepare(self, &by_matrix(energy)?)
    }

    fn minimize(
        &mut self,
        energy: &Energy<'_, ElementOperator<C>, C>,
        stopping: &Stopping<'_, ElementOperator<C>>,
        v: &mut [SVector<f64, C>],
    ) -> Result<SolveReport, SolveError> {
        let norm = stopping.norm.matrix();
        let stopping = Stopping {
            norm: norm.ok_or(SolveError::NotDiagonal { vertex: 0 })?,
            tolerance: stopping.tolerance,
            relative: stopping.relative,
            equivalence: stopping.equivalence,
            max_iterations: stopping.max_iterations,
        };
        NonsmoothSolver::<BlockMatrix<C>, C>::minimize(self, &by_matrix(energy)?, &stopping, v)
    }

    fn boxed_clone(&self) -> Box<dyn NonsmoothSolver<ElementOperator<C>, C>> {
        Box::new(self.clone())
    }

    fn into_object(self) -> Box<dyn NonsmoothSolver<ElementOperator<C>, C>> {
        object(self)
    }
}

compiled! {
    fn object<C>(solver: Diagonal<C>) -> Box<dyn NonsmoothSolver<ElementOperator<C>, C>> {
        Box::new(solver)
    }
}

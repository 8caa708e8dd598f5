//! The solver of explicit steps.

use nalgebra::SVector;
use stickslip_core::compiled;

use super::ElementOperator;
use crate::{
    BlockMatrix, Diagonal, Energy, FreeVertices, NonsmoothSolver, SolveError, SolveReport, Stopping,
};

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
        solve(self, energy, stopping, v, true)
    }

    fn free_vertices(&mut self) -> Option<&mut dyn FreeVertices<ElementOperator<C>, C>> {
        Some(self)
    }

    fn is_definite_with(&mut self, slopes: &[f64]) -> Option<bool> {
        Some(self.is_definite(slopes))
    }

    fn boxed_clone(&self) -> Box<dyn NonsmoothSolver<ElementOperator<C>, C>> {
        Box::new(self.clone())
    }

    fn into_object(self) -> Box<dyn NonsmoothSolver<ElementOperator<C>, C>> {
        object(self)
    }
}

impl<const C: usize> FreeVertices<ElementOperator<C>, C> for Diagonal<C> {
    fn compliances(&self) -> &[SVector<f64, C>] {
        self.inverses()
    }

    fn others(&self) -> &[usize] {
        Self::others(self)
    }

    fn minimize_others(
        &mut self,
        energy: &Energy<'_, ElementOperator<C>, C>,
        stopping: &Stopping<'_, ElementOperator<C>>,
        v: &mut [SVector<f64, C>],
    ) -> Result<SolveReport, SolveError> {
        solve(self, energy, stopping, v, false)
    }
}

/// The minimiser at all vertices, or at those that are not free.
fn solve<const C: usize>(
    solver: &mut Diagonal<C>,
    energy: &Energy<'_, ElementOperator<C>, C>,
    stopping: &Stopping<'_, ElementOperator<C>>,
    v: &mut [SVector<f64, C>],
    all: bool,
) -> Result<SolveReport, SolveError> {
    let norm = stopping.norm.matrix();
    let norm = norm.ok_or(SolveError::NotDiagonal { vertex: 0 })?;
    solver.solve(&by_matrix(energy)?, norm, v, all)
}

compiled! {
    fn object<C>(solver: Diagonal<C>) -> Box<dyn NonsmoothSolver<ElementOperator<C>, C>> {
        Box::new(solver)
    }
}

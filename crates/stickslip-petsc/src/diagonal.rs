//! The solver of explicit steps in several processes.

use nalgebra::SVector;
use stickslip::solvers::{Energy, SolveError, SolveReport, Stopping};
use stickslip::{BlockMatrix, Diagonal, Matrix, NonsmoothSolver};

use crate::{DistributedElements, DistributedMatrix};

/// The solver of [explicit steps](stickslip::CentralDifferences) of a [`DistributedElements`] or a [`DistributedMatrix`] with
/// a lumped mass: [`Diagonal`] for the vertices of each process.
///
/// The matrix of such a step couples nothing but the two sides of a fault, which one process has. A solution sends no
/// message.
#[derive(Debug, Clone, Default)]
pub struct DistributedDiagonal<const C: usize> {
    own: Diagonal<C>,
    /// The rows of the prepared matrix.
    rows: Option<BlockMatrix<C>>,
}

impl<const C: usize> DistributedDiagonal<C> {
    /// A solver without an operator so far.
    pub fn new() -> Self {
        Self::default()
    }

    fn prepare_for<Op>(
        &mut self,
        energy: &Energy<'_, Op, C>,
        matrix: Option<&DistributedMatrix<C>>,
    ) -> Result<(), SolveError> {
        let matrix = matrix.ok_or(SolveError::NotDiagonal { vertex: 0 })?;
        let rows = self.rows.insert(rows(matrix)?);
        self.own.prepare(&on(energy, rows))
    }

    fn solve<Op>(
        &mut self,
        energy: &Energy<'_, Op, C>,
        tolerance: &Stopping<'_, Op>,
        v: &mut [SVector<f64, C>],
    ) -> Result<SolveReport, SolveError> {
        let rows = self.rows.as_ref();
        let rows = rows.ok_or(SolveError::NotDiagonal { vertex: 0 })?;
        let stopping = Stopping {
            norm: rows,
            tolerance: tolerance.tolerance,
            relative: tolerance.relative,
            equivalence: tolerance.equivalence,
            max_iterations: tolerance.max_iterations,
        };
        self.own.minimize(&on(energy, rows), &stopping, v)
    }
}

/// A problem with a matrix of the rows of this process.
fn on<'a, Op, const C: usize>(
    energy: &Energy<'a, Op, C>,
    operator: &'a BlockMatrix<C>,
) -> Energy<'a, BlockMatrix<C>, C> {
    Energy {
        operator,
        load: energy.load,
        potentials: energy.potentials,
        vertices: energy.vertices,
        fixed: energy.fixed,
    }
}

/// The rows of this process, which couple no vertex of another one.
fn rows<const C: usize>(matrix: &DistributedMatrix<C>) -> Result<BlockMatrix<C>, SolveError> {
    let size = matrix.vertex_count();
    for vertex in 0..size {
        if matrix.row(vertex).any(|(column, _)| column >= size) {
            return Err(SolveError::NotDiagonal { vertex });
        }
    }
    let starts = matrix.starts.to_vec();
    let (columns, values) = (matrix.columns.to_vec(), matrix.values.clone());
    Ok(BlockMatrix::new((size, size), starts, columns, values))
}

impl<const C: usize> NonsmoothSolver<DistributedElements<C>, C> for DistributedDiagonal<C> {
    fn prepare(
        &mut self,
        energy: &Energy<'_, DistributedElements<C>, C>,
    ) -> Result<(), SolveError> {
        let operator = energy.operator;
        self.prepare_for(energy, operator.matrix())
    }

    fn minimize(
        &mut self,
        energy: &Energy<'_, DistributedElements<C>, C>,
        stopping: &Stopping<'_, DistributedElements<C>>,
        v: &mut [SVector<f64, C>],
    ) -> Result<SolveReport, SolveError> {
        self.solve(energy, stopping, v)
    }

    fn is_definite_with(&mut self, slopes: &[f64]) -> Option<bool> {
        NonsmoothSolver::<BlockMatrix<C>, C>::is_definite_with(&mut self.own, slopes)
    }

    fn boxed_clone(&self) -> Box<dyn NonsmoothSolver<DistributedElements<C>, C>> {
        Box::new(self.clone())
    }
}

impl<const C: usize> NonsmoothSolver<DistributedMatrix<C>, C> for DistributedDiagonal<C> {
    fn prepare(&mut self, energy: &Energy<'_, DistributedMatrix<C>, C>) -> Result<(), SolveError> {
        let operator = energy.operator;
        self.prepare_for(energy, Some(operator))
    }

    fn minimize(
        &mut self,
        energy: &Energy<'_, DistributedMatrix<C>, C>,
        stopping: &Stopping<'_, DistributedMatrix<C>>,
        v: &mut [SVector<f64, C>],
    ) -> Result<SolveReport, SolveError> {
        self.solve(energy, stopping, v)
    }

    fn is_definite_with(&mut self, slopes: &[f64]) -> Option<bool> {
        NonsmoothSolver::<BlockMatrix<C>, C>::is_definite_with(&mut self.own, slopes)
    }

    fn boxed_clone(&self) -> Box<dyn NonsmoothSolver<DistributedMatrix<C>, C>> {
        Box::new(self.clone())
    }
}

//! The exact solve on the coarsest level, without allocation after the symbolic analysis.

use nalgebra::SVector;

use crate::cholesky::Factored;
use crate::{BlockMatrix, SolveError};

/// Symbolic and numeric factor of a matrix whose pattern does not change.
#[derive(Debug)]
pub(crate) struct CoarseSolver<const C: usize> {
    factored: Factored<C>,
}

impl<const C: usize> CoarseSolver<C> {
    /// Orders the unknowns, computes the pattern of the factor and allocates.
    pub(super) fn analyse(matrix: &BlockMatrix<C>) -> Result<Self, SolveError> {
        let free = vec![[false; C]; matrix.rows()];
        let factored = Factored::analyse(matrix, &free, usize::MAX).map_err(coarse)?;
        Ok(Self { factored })
    }

    /// The number of entries of the factor.
    pub(super) fn entries(&self) -> usize {
        self.factored.entries()
    }

    /// Numeric factorisation; an empty row stands for a dropped unknown.
    pub(super) fn factorize(&mut self, matrix: &BlockMatrix<C>) -> Result<(), SolveError> {
        self.factored.factorize(matrix).map_err(coarse)
    }

    /// The vertex of a pivot that rounding may have made: the body may be unsupported.
    pub(super) fn rounded_pivot(&self) -> Option<usize> {
        self.factored.rounded_pivot()
    }

    /// Solves for one right-hand side; dropped components of the solution are zero.
    pub(super) fn solve(
        &mut self,
        residual: &[SVector<f64, C>],
        dropped: &[[bool; C]],
        correction: &mut [SVector<f64, C>],
    ) {
        let Factored { layout, x, .. } = &mut self.factored;
        for (residual, positions) in residual.iter().zip(&layout.positions) {
            for c in 0..C {
                x[positions[c] as usize] = residual[c];
            }
        }
        self.factored.solve();
        self.factored.layout.scatter(&self.factored.x, correction);
        for (correction, dropped) in correction.iter_mut().zip(dropped) {
            for c in (0..C).filter(|&c| dropped[c]) {
                correction[c] = 0.0;
            }
        }
    }
}

/// The error of a factorisation, attributed to the coarse matrix.
fn coarse(mut error: SolveError) -> SolveError {
    match &mut error {
        SolveError::IndefiniteMatrix { what, .. } | SolveError::Analysis { what, .. } => {
            *what = "coarse matrix";
        }
        _ => {}
    }
    error
}

//! Conjugate gradients for any matrix.

use nalgebra::{SMatrix, SVector};

use crate::block::invert_all;
use crate::energy::expect;
use crate::field::{clear_masked, dot};
use crate::linear_solver::check_lengths;
use crate::{LinearSolver, Matrix, SolveError};

/// Conjugate gradients, preconditioned by the inverses of the diagonal blocks. They are exact after one iteration on a
/// diagonal operator such as a lumped mass, fast on any mass, and good enough for the stiffness of small bodies.
#[derive(Debug, Clone, Default)]
pub struct ConjugateGradients<const C: usize> {
    inverses: Vec<SMatrix<f64, C, C>>,
    diagonal: Vec<SVector<f64, C>>,
    fixed: Vec<[bool; C]>,
    residual: Vec<SVector<f64, C>>,
    preconditioned: Vec<SVector<f64, C>>,
    direction: Vec<SVector<f64, C>>,
    image: Vec<SVector<f64, C>>,
}

/// Relative accuracy: the share of the first residual, in the norm of the preconditioner, at the level of rounding.
const REDUCTION: f64 = 1e-15;
/// Largest number of iterations per unknown.
const PATIENCE: usize = 20;
/// The relative rounding error of the curvature of a rigid-body direction.
const ROUNDING: f64 = 64.0 * f64::EPSILON;
/// Largest number of successive iterations without progress.
const STALL: usize = 50;

impl<Op: Matrix<C> + ?Sized, const C: usize> LinearSolver<Op, C> for ConjugateGradients<C> {
    fn boxed_clone(&self) -> Box<dyn LinearSolver<Op, C>> {
        Box::new(self.clone())
    }

    fn prepare(&mut self, operator: &Op, fixed: &[[bool; C]]) -> Result<(), SolveError> {
        let size = operator.vertex_count();
        expect([(size, fixed.len())])?;
        invert_all(operator, fixed, &mut self.inverses)?;
        self.diagonal.clear();
        (self.diagonal).extend((0..size).map(|vertex| operator.diagonal_block(vertex).diagonal()));
        self.fixed.clear();
        self.fixed.extend_from_slice(fixed);
        for field in [
            &mut self.residual,
            &mut self.preconditioned,
            &mut self.direction,
            &mut self.image,
        ] {
            field.clear();
            field.resize(size, SVector::zeros());
        }
        Ok(())
    }

    fn solve(
        &mut self,
        operator: &Op,
        load: &[SVector<f64, C>],
        x: &mut [SVector<f64, C>],
    ) -> Result<(), SolveError> {
        check_lengths(self.inverses.len(), load, x)?;
        self.residual.copy_from_slice(load);
        operator.multiply_add(-1.0, x, &mut self.residual);
        let (mut first, mut best, mut since) = (f64::NAN, f64::INFINITY, 0);
        let (mut before, mut change) = (0.0, f64::INFINITY);
        let ranks = operator.ranks();
        let size = ranks.sum((C * x.len()) as f64);
        let limit = PATIENCE * (1 + size as usize);
        for iteration in 1..=limit {
            for (residual, fixed) in self.residual.iter_mut().zip(&self.fixed) {
                clear_masked(residual, fixed);
            }
            for ((preconditioned, inverse), residual) in (self.preconditioned.iter_mut())
                .zip(&self.inverses)
                .zip(&self.residual)
            {
                *preconditioned = inverse * residual;
            }
            let square = ranks.sum(dot(&self.residual, &self.preconditioned));
            if !square.is_finite() {
                let change = square;
                return Err(SolveError::NotFinite { iteration, change });
            }
            if iteration == 1 {
                first = square;
            }
            since = if square < best { 0 } else { since + 1 };
            best = best.min(square);
            change = square.max(0.0).sqrt();
            // Rounding alone keeps the residual from falling further.
            let rounded = since > STALL && best <= first * 1e-20;
            if square <= REDUCTION * REDUCTION * first || rounded {
                return Ok(());
            }
            let ratio = if iteration == 1 { 0.0 } else { square / before };
            before = square;
            for (direction, preconditioned) in self.direction.iter_mut().zip(&self.preconditioned) {
                *direction = *direction * ratio + preconditioned;
            }
            self.image.fill(SVector::zeros());
            operator.multiply_add(1.0, &self.direction, &mut self.image);
            let curvature = ranks.sum(dot(&self.direction, &self.image));
            let terms = self.diagonal.iter().zip(&self.direction);
            let terms: f64 = terms.map(|(a, d)| a.component_mul(d).dot(d)).sum();
            if curvature.is_nan() || curvature <= ROUNDING * ranks.sum(terms) {
                return Err(SolveError::IndefiniteDirection {
                    iteration,
                    curvature,
                });
            }
            let length = square / curvature;
            for ((x, residual), (direction, image)) in
                (x.iter_mut().zip(&mut self.residual)).zip(self.direction.iter().zip(&self.image))
            {
                *x += direction * length;
                *residual -= image * length;
            }
        }
        Err(SolveError::NotConverged {
            iterations: limit,
            change,
            tolerance: REDUCTION * first.sqrt(),
        })
    }
}

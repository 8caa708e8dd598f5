//! Conjugate gradients, preconditioned by PETSc's multigrid.

use nalgebra::SVector;
use stickslip::Matrix;

use crate::DistributedMatrix;
use crate::ffi::Multigrid;
use crate::world::or_abort;

/// The linear problem beside the operator: truncated components, and diagonal blocks at some vertices.
pub(crate) trait Linearization<const C: usize> {
    /// Zeroes the truncated components of a residual before preconditioning.
    fn hide(&self, residual: &mut [SVector<f64, C>]);

    /// Zeroes the truncated components of a preconditioned residual.
    fn complete(&self, correction: &mut [SVector<f64, C>]);

    /// Subtracts the surplus of the matrix of the preconditioner over the operator from a product with it.
    fn soften(&self, x: &[SVector<f64, C>], product: &mut [SVector<f64, C>]);

    /// The part of `d . A d` beyond the operator's, in this process.
    fn curvature(&self, direction: &[SVector<f64, C>]) -> f64;

    /// Takes `length` times the product with the direction off a residual, from which the operator's part of it, which
    /// is in `image`, has already been taken; and sums that up at these vertices.
    fn complete_residual(
        &mut self,
        length: f64,
        direction: &[SVector<f64, C>],
        image: &[SVector<f64, C>],
        residual: &mut [SVector<f64, C>],
    );
}

/// The fields of the iteration.
#[derive(Debug, Default)]
pub(crate) struct Gradients<const C: usize> {
    pub(crate) residual: Vec<SVector<f64, C>>,
    pub(crate) correction: Vec<SVector<f64, C>>,
    seen: Vec<SVector<f64, C>>,
    preconditioned: Vec<SVector<f64, C>>,
    direction: Vec<SVector<f64, C>>,
    /// The operator's products with the last two, without what it exerts on fixed components.
    product: Vec<SVector<f64, C>>,
    image: Vec<SVector<f64, C>>,
}

/// The end of the iteration.
pub(crate) struct End {
    pub(crate) cycles: usize,
    /// Square of the error that is left, in the norm of the matrix.
    pub(crate) error: f64,
}

impl<const C: usize> Gradients<C> {
    /// Takes memory for so many vertices.
    pub(crate) fn resize(&mut self, size: usize) {
        for field in [
            &mut self.residual,
            &mut self.correction,
            &mut self.seen,
            &mut self.preconditioned,
            &mut self.direction,
            &mut self.product,
            &mut self.image,
        ] {
            field.resize(size, SVector::zeros());
        }
    }

    /// Finds the correction for `residual`, until the square of the error has fallen by that of `reduction` or lies below
    /// `target`; `residual` is then the residual. The number that is no curvature where there is one.
    pub(crate) fn solve(
        &mut self,
        operator: &DistributedMatrix<C>,
        multigrid: &mut Multigrid<C>,
        newton: &mut impl Linearization<C>,
        (reduction, target): (f64, f64),
        most: usize,
    ) -> Result<End, f64> {
        // Square of the rate expected of a cycle while no second one has been seen.
        const FIRST_RATE: f64 = 0.1;
        for field in [&mut self.correction, &mut self.direction, &mut self.image] {
            field.fill(SVector::zeros());
        }
        let (mut first, mut previous, mut last_ratio) = (0.0, 0.0, 0.0);
        let mut end = End {
            cycles: 0,
            error: 0.0,
        };
        for cycle in 1..=most {
            self.seen.copy_from_slice(&self.residual);
            newton.hide(&mut self.seen);
            or_abort(multigrid.apply(&self.seen, &mut self.preconditioned));
            newton.complete(&mut self.preconditioned);
            let square = operator
                .ranks()
                .sum(dot(&self.residual, &self.preconditioned));
            end.cycles = cycle;
            if square == 0.0 {
                end.error = 0.0;
                return Ok(end);
            }
            if !(square > 0.0 && square.is_finite()) {
                return Err(square);
            }
            let ratio = if cycle == 1 { 0.0 } else { square / previous };
            // The matrix that the cycle has just read.
            or_abort(multigrid.multiply(&self.preconditioned, &mut self.product));
            newton.soften(&self.preconditioned, &mut self.product);
            let mut curvature = self.turn(ratio);
            curvature += newton.curvature(&self.direction);
            let curvature = operator.ranks().sum(curvature);
            if !(curvature > 0.0 && curvature.is_finite()) {
                return Err(curvature);
            }
            let length = square / curvature;
            for i in 0..self.residual.len() {
                self.correction[i] += self.direction[i] * length;
                self.residual[i] -= self.image[i] * length;
            }
            newton.complete_residual(length, &self.direction, &self.image, &mut self.residual);
            let rate = if cycle == 1 {
                first = square;
                FIRST_RATE
            } else {
                // By chance a cycle does far better than the next one, which finds what it left.
                f64::max(ratio, last_ratio).min(1.0)
            };
            end.error = square * rate;
            (previous, last_ratio) = (square, ratio);
            if end.error <= target.max(reduction * reduction * first) {
                break;
            }
        }
        Ok(end)
    }

    /// The next direction and its image; their product in this process.
    fn turn(&mut self, ratio: f64) -> f64 {
        let ahead = self.preconditioned.iter().zip(&self.product);
        let last = self.direction.iter_mut().zip(&mut self.image);
        let mut along = 0.0;
        for ((direction, image), (ahead, product)) in last.zip(ahead) {
            *direction = ahead + *direction * ratio;
            *image = product + *image * ratio;
            along += direction.dot(image);
        }
        along
    }
}

fn dot<const C: usize>(a: &[SVector<f64, C>], b: &[SVector<f64, C>]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a.dot(b)).sum()
}

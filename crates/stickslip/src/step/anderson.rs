//! Anderson acceleration of a fixed-point iteration, and its contraction.

use nalgebra::{SMatrix, SVector};
use stickslip_solvers::Ranks;

/// The number of differences in use.
pub(crate) const DEPTH: usize = 5;

/// The iteration `x <- G(x)`, accelerated: the next iterate is that of the affine combination of the last ones with the
/// smallest residual `G(x) - x`.
///
/// Source: D. Anderson, J. ACM 12 (1965); H. Walker, P. Ni, SIAM J. Numer. Anal. 49 (2011).
#[derive(Debug, Clone, Default)]
pub(crate) struct Anderson {
    /// The last differences of iterates and of images, and their number.
    steps: [Vec<f64>; DEPTH],
    images: [Vec<f64>; DEPTH],
    count: usize,
    /// The last iterate and its image.
    iterate: Vec<f64>,
    image: Vec<f64>,
    begun: bool,
}

impl Anderson {
    /// Memory for so many unknowns.
    pub(crate) fn new(size: usize) -> Self {
        let zeros = || vec![0.0; size];
        Self {
            steps: std::array::from_fn(|_| zeros()),
            images: std::array::from_fn(|_| zeros()),
            count: 0,
            iterate: zeros(),
            image: zeros(),
            begun: false,
        }
    }

    /// Forgets the iterates of another step.
    pub(crate) fn begin(&mut self) {
        (self.count, self.begun) = (0, false);
    }

    /// Replaces an iterate by the next one, by its image. Products are weighted, and sums of all processes.
    pub(crate) fn advance(
        &mut self,
        ranks: &Ranks,
        weights: &[f64],
        iterate: &mut [f64],
        image: &[f64],
    ) {
        if self.begun {
            self.steps.rotate_right(1);
            self.images.rotate_right(1);
            self.count = (self.count + 1).min(DEPTH);
            for (k, step) in self.steps[0].iter_mut().enumerate() {
                *step = iterate[k] - self.iterate[k];
            }
            for (k, step) in self.images[0].iter_mut().enumerate() {
                *step = image[k] - self.image[k];
            }
        }
        self.begun = true;
        self.iterate.copy_from_slice(iterate);
        self.image.copy_from_slice(image);
        let shares = self.shares(ranks, weights);
        iterate.copy_from_slice(image);
        for (share, step) in shares.iter().zip(&self.images).take(self.count) {
            for (x, step) in iterate.iter_mut().zip(step) {
                *x -= share * step;
            }
        }
    }

    /// The shares of the last differences in the combination with the smallest residual.
    fn shares(&self, ranks: &Ranks, weights: &[f64]) -> SVector<f64, DEPTH> {
        let mut gram = SMatrix::<f64, DEPTH, DEPTH>::zeros();
        let mut right = SVector::<f64, DEPTH>::zeros();
        for (k, weight) in weights.iter().enumerate() {
            let square = weight * weight;
            let own = self.image[k] - self.iterate[k];
            let residual = |i: usize| self.images[i][k] - self.steps[i][k];
            for i in 0..self.count {
                right[i] += square * residual(i) * own;
                for j in 0..self.count {
                    gram[(i, j)] += square * residual(i) * residual(j);
                }
            }
        }
        self.sum(ranks, &mut gram);
        for right in &mut right.as_mut_slice()[..self.count] {
            *right = ranks.sum(*right);
        }
        let basis = orthonormal(&gram, self.count);
        basis * (basis.transpose() * right)
    }

    /// The contraction of the plain iteration: the largest modulus of an eigenvalue of its linear map on the span of the
    /// last differences; 0 before there are any.
    pub(crate) fn contraction(&self, ranks: &Ranks, weights: &[f64]) -> f64 {
        let (mut gram, mut image) = (
            SMatrix::<f64, DEPTH, DEPTH>::zeros(),
            SMatrix::<f64, DEPTH, DEPTH>::zeros(),
        );
        for (k, weight) in weights.iter().enumerate() {
            for i in 0..self.count {
                let step = weight * weight * self.steps[i][k];
                for j in 0..self.count {
                    gram[(i, j)] += step * self.steps[j][k];
                    image[(i, j)] += step * self.images[j][k];
                }
            }
        }
        self.sum(ranks, &mut gram);
        self.sum(ranks, &mut image);
        let basis = orthonormal(&gram, self.count);
        spectral_radius(basis.transpose() * image * basis)
    }

    /// The products of all processes.
    fn sum(&self, ranks: &Ranks, products: &mut SMatrix<f64, DEPTH, DEPTH>) {
        if ranks.are_several() {
            let mut products = products.view_mut((0, 0), (self.count, self.count));
            products
                .iter_mut()
                .for_each(|part| *part = ranks.sum(*part));
        }
    }
}

/// Combinations of vectors with products `gram`, one a column, that are orthonormal: none for vectors that depend on
/// the others but for rounding.
fn orthonormal(gram: &SMatrix<f64, DEPTH, DEPTH>, count: usize) -> SMatrix<f64, DEPTH, DEPTH> {
    // The sine of an angle, squared, of which the products of vectors keep some digits.
    const INDEPENDENT: f64 = 1e-10;
    let mut basis = SMatrix::<f64, DEPTH, DEPTH>::zeros();
    for k in 0..count {
        let mut column = SVector::<f64, DEPTH>::zeros();
        column[k] = 1.0;
        for _ in 0..2 {
            column -= basis * (basis.transpose() * (gram * column));
        }
        let square = column.dot(&(gram * column));
        if square > INDEPENDENT * gram[(k, k)] {
            basis.set_column(k, &(column / square.sqrt()));
        }
    }
    basis
}

/// The largest modulus of an eigenvalue, as the root of the norm of a high power.
fn spectral_radius(mut matrix: SMatrix<f64, DEPTH, DEPTH>) -> f64 {
    const SQUARINGS: i32 = 12;
    let mut logarithm = 0.0;
    for k in 0..=SQUARINGS {
        let norm = matrix.norm();
        if norm == 0.0 || !norm.is_finite() {
            return norm;
        }
        logarithm += norm.ln() / 2_f64.powi(k);
        matrix /= norm;
        matrix *= matrix;
    }
    logarithm.exp()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A linear map in the plane with eigenvalues of modulus `q`, and a third number that it shrinks.
    fn map(q: f64, x: &[f64; 3]) -> [f64; 3] {
        [1.0 - q * x[1], 2.0 + q * x[0], 3.0 + 0.1 * q * x[2]]
    }

    #[test]
    fn a_linear_map_of_three_numbers_takes_four_iterations() {
        for q in [0.1, 0.9, 3.0] {
            let (mut anderson, mut x) = (Anderson::new(3), [0.0; 3]);
            anderson.begin();
            for _ in 0..5 {
                let image = map(q, &x);
                anderson.advance(&Ranks::default(), &[1.0; 3], &mut x, &image);
            }
            let image = map(q, &x);
            let left = image.iter().zip(&x).map(|(a, b)| (a - b).abs());
            assert!(left.fold(0.0, f64::max) < 1e-9, "{q}");
            let contraction = anderson.contraction(&Ranks::default(), &[1.0; 3]);
            assert!((contraction / q - 1.0).abs() < 1e-3, "{contraction} {q}");
        }
    }
}

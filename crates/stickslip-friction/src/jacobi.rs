//! Eigenvalues and eigenvectors of the small blocks.

use nalgebra::{SMatrix, SVector};

/// Sweeps converge quadratically: up to size 3 six suffice.
const SWEEPS: usize = 20;

/// `S = Q diag(lambda) Q^T` by cyclic Jacobi rotations, returned as `(lambda, Q)`.
///
/// Eigenvalues of positive definite blocks come out with a small relative error if the diagonal
/// scaling of `S` makes it well conditioned. Entries that are exactly 0 are not rotated: components
/// that do not couple to others keep their diagonal entry and their axis.
pub(crate) fn eigen<const C: usize>(
    block: &SMatrix<f64, C, C>,
) -> (SVector<f64, C>, SMatrix<f64, C, C>) {
    let mut s = *block;
    let mut q = SMatrix::identity();
    for _ in 0..SWEEPS {
        let mut rotated = false;
        for i in 0..C {
            for j in i + 1..C {
                let coupling = s[(i, j)];
                if coupling.abs() <= 0.25 * f64::EPSILON * (s[(i, i)] * s[(j, j)]).abs().sqrt() {
                    continue;
                }
                rotated = true;
                // tan of the smaller angle that annihilates s_ij.
                let cot2 = (s[(j, j)] - s[(i, i)]) / (2.0 * coupling);
                let tan = cot2.signum() / (cot2.abs() + cot2.hypot(1.0));
                let cos = tan.hypot(1.0).recip();
                let sin = tan * cos;
                for k in (0..C).filter(|&k| k != i && k != j) {
                    let (x, y) = (s[(k, i)], s[(k, j)]);
                    s[(k, i)] = cos * x - sin * y;
                    s[(k, j)] = sin * x + cos * y;
                    s[(i, k)] = s[(k, i)];
                    s[(j, k)] = s[(k, j)];
                }
                s[(i, i)] -= tan * coupling;
                s[(j, j)] += tan * coupling;
                s[(i, j)] = 0.0;
                s[(j, i)] = 0.0;
                for k in 0..C {
                    let (x, y) = (q[(k, i)], q[(k, j)]);
                    q[(k, i)] = cos * x - sin * y;
                    q[(k, j)] = sin * x + cos * y;
                }
            }
        }
        if !rotated {
            break;
        }
    }
    (s.diagonal(), q)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reconstructs_the_block() {
        let s = SMatrix::<f64, 3, 3>::new(4.0, 1.0, -2.0, 1.0, 3.0, 0.5, -2.0, 0.5, 5.0);
        let (lambda, q) = eigen(&s);
        assert!((q * SMatrix::from_diagonal(&lambda) * q.transpose() - s).norm() < 1e-14);
        assert!((q.transpose() * q - SMatrix::identity()).norm() < 1e-14);
    }

    #[test]
    fn zeros_stay_decoupled() {
        let s = SMatrix::<f64, 3, 3>::new(2e9, 0.0, 1e9, 0.0, 1.0, 0.0, 1e9, 0.0, 3e9);
        let (lambda, q) = eigen(&s);
        assert_eq!(lambda[1], 1.0);
        for k in [0, 2] {
            assert_eq!((q[(1, k)], q[(k, 1)]), (0.0, 0.0));
        }
    }

    #[test]
    fn small_eigenvalues_of_scaled_blocks_are_accurate() {
        let s = SMatrix::<f64, 2, 2>::new(1e12, 1.0, 1.0, 2e-12);
        let (lambda, _) = eigen(&s);
        assert!((lambda[1] - 1e-12).abs() < 1e-26);
    }
}

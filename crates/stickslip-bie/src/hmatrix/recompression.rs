//! The smallest rank within a tolerance: both factors orthogonal, singular values of the small matrix between them.

use nalgebra::DMatrix;

use super::cross::Crosses;

/// `left right^T`.
pub(super) struct Factors {
    pub(super) left: DMatrix<f64>,
    pub(super) right: DMatrix<f64>,
}

/// Singular values and vectors of a sum of crosses.
pub(super) struct Singular {
    left: DMatrix<f64>,
    right: DMatrix<f64>,
    values: Vec<f64>,
}

impl Singular {
    pub(super) fn of(crosses: &Crosses, [height, width]: [usize; 2]) -> Self {
        let rank = crosses.rows.len();
        if rank == 0 {
            return Self {
                left: DMatrix::zeros(height, 0),
                right: DMatrix::zeros(width, 0),
                values: Vec::new(),
            };
        }
        let matrix = |vectors: &[Vec<f64>], length: usize| {
            DMatrix::from_iterator(length, rank, vectors.iter().flatten().copied()).qr()
        };
        let (columns, rows) = (
            matrix(&crosses.columns, height),
            matrix(&crosses.rows, width),
        );
        let between = columns.r() * rows.r().transpose();
        let svd = between.svd(true, true);
        let (u, v) = (svd.u.unwrap_or_default(), svd.v_t.unwrap_or_default());
        Self {
            left: columns.q() * u,
            right: rows.q() * v.transpose(),
            values: svd.singular_values.iter().copied().collect(),
        }
    }

    /// The rank whose error is within a relative tolerance in the Frobenius norm.
    pub(super) fn rank(&self, tolerance: f64) -> usize {
        let total: f64 = self.values.iter().map(|x| x * x).sum();
        let (mut rank, mut error) = (self.values.len(), 0.0);
        while rank > 0 {
            error += self.values[rank - 1].powi(2);
            if error > tolerance * tolerance * total {
                break;
            }
            rank -= 1;
        }
        rank
    }

    /// Factors of this rank, each with the root of the singular values.
    pub(super) fn factors(&self, rank: usize) -> Factors {
        let scaled = |vectors: &DMatrix<f64>| {
            let mut vectors = vectors.columns(0, rank).into_owned();
            for (mut vector, value) in vectors.column_iter_mut().zip(&self.values) {
                vector *= value.sqrt();
            }
            vectors
        };
        Factors {
            left: scaled(&self.left),
            right: scaled(&self.right),
        }
    }
}

//! The normal equations of least squares.

use nalgebra::{DMatrix, DVector, SymmetricEigen};

/// The eigenvalues of the normal equations with a unit diagonal that count as zero: derivatives have 6 digits.
const RANK: f64 = 1e-8;

/// Residuals and their derivatives, a column per parameter.
pub(crate) type Linearised = (DVector<f64>, DMatrix<f64>);

/// The normal equations, scaled to a unit diagonal, in their eigenvectors.
#[derive(Debug, Clone)]
pub(crate) struct Normal {
    pub(crate) matrix: DMatrix<f64>,
    pub(crate) gradient: DVector<f64>,
    scale: DVector<f64>,
    eigen: SymmetricEigen<f64, nalgebra::Dyn>,
}

impl Normal {
    pub(crate) fn new((residual, jacobian): &Linearised) -> Self {
        let matrix = jacobian.tr_mul(jacobian);
        let gradient = jacobian.tr_mul(residual);
        let scale = matrix
            .diagonal()
            .map(|d| if d > 0.0 { d.sqrt() } else { 1.0 });
        let n = scale.len();
        let scaled = DMatrix::from_fn(n, n, |i, j| matrix[(i, j)] / (scale[i] * scale[j]));
        Self {
            eigen: SymmetricEigen::new(scaled),
            matrix,
            gradient,
            scale,
        }
    }

    fn is_regular(&self, k: usize) -> bool {
        self.eigen.eigenvalues[k] > RANK
    }

    /// The normal equations of the parameters of `free` alone.
    pub(crate) fn with(&self, free: &[bool]) -> Self {
        let kept: Vec<usize> = (0..free.len()).filter(|&i| free[i]).collect();
        let matrix = self.matrix.select_rows(&kept).select_columns(&kept);
        Self {
            scale: self.scale.select_rows(&kept),
            gradient: self.gradient.select_rows(&kept),
            eigen: SymmetricEigen::new(DMatrix::from_fn(kept.len(), kept.len(), |i, j| {
                matrix[(i, j)] / (self.scale[kept[i]] * self.scale[kept[j]])
            })),
            matrix,
        }
    }

    /// The square of the part of the residual that the linear model removes.
    pub(crate) fn removable(&self) -> f64 {
        let along = self.along();
        let regular = (0..along.len()).filter(|&k| self.is_regular(k));
        regular
            .map(|k| along[k] * along[k] / self.eigen.eigenvalues[k])
            .sum()
    }

    /// The step to the minimum of the linear model, without combinations of parameters that have no influence.
    pub(crate) fn to_minimum(&self) -> DVector<f64> {
        let mut along = self.along();
        for (k, along) in along.iter_mut().enumerate() {
            let value = self.eigen.eigenvalues[k];
            *along = if self.is_regular(k) {
                -*along / value
            } else {
                0.0
            };
        }
        (&self.eigen.eigenvectors * along).component_div(&self.scale)
    }

    /// The scaled gradient in the eigenvectors.
    fn along(&self) -> DVector<f64> {
        let scaled = self.gradient.component_div(&self.scale);
        self.eigen.eigenvectors.tr_mul(&scaled)
    }

    /// The damped step with the parameters of `free`.
    pub(crate) fn step(
        &self,
        damping: f64,
        damped: &DVector<f64>,
        free: &[bool],
    ) -> Option<DVector<f64>> {
        let mut matrix = self.matrix.clone();
        let mut right = -&self.gradient;
        for i in 0..free.len() {
            // A parameter without any influence stays.
            matrix[(i, i)] += damping * damped[i] + f64::MIN_POSITIVE;
            if !free[i] {
                matrix.row_mut(i).fill(0.0);
                matrix.column_mut(i).fill(0.0);
                matrix[(i, i)] = 1.0;
                right[i] = 0.0;
            }
        }
        Some(matrix.cholesky()?.solve(&right))
    }

    /// The inverse of `J^T J`; the variance of a parameter is infinite if a combination that contains it has no
    /// influence.
    pub(crate) fn inverse(&self) -> DMatrix<f64> {
        let n = self.scale.len();
        let (values, vectors) = (&self.eigen.eigenvalues, &self.eigen.eigenvectors);
        DMatrix::from_fn(n, n, |i, j| {
            let mut sum = 0.0;
            for k in 0..n {
                let product = vectors[(i, k)] * vectors[(j, k)];
                if self.is_regular(k) {
                    sum += product / values[k];
                } else if i == j && product > RANK.sqrt() {
                    sum = f64::INFINITY;
                }
            }
            sum / (self.scale[i] * self.scale[j])
        })
    }

    /// The inverse of `J^T J` without the combinations of parameters that have no influence.
    pub(crate) fn regular_inverse(&self) -> DMatrix<f64> {
        let n = self.scale.len();
        let (values, vectors) = (&self.eigen.eigenvalues, &self.eigen.eigenvectors);
        DMatrix::from_fn(n, n, |i, j| {
            let regular = (0..n).filter(|&k| self.is_regular(k));
            let sum: f64 = regular
                .map(|k| vectors[(i, k)] * vectors[(j, k)] / values[k])
                .sum();
            sum / (self.scale[i] * self.scale[j])
        })
    }

    /// Whether a parameter is in no combination without influence.
    pub(crate) fn has_influence(&self, i: usize) -> bool {
        let mut lost = (0..self.scale.len()).filter(|&k| !self.is_regular(k));
        lost.all(|k| self.eigen.eigenvectors[(i, k)].powi(2) <= RANK.sqrt())
    }

    /// The variance of a weighted sum of the parameters over that of the residuals; infinite if the sum changes along a
    /// combination of parameters without influence.
    pub(crate) fn variance(&self, weights: &DVector<f64>) -> f64 {
        let scaled = weights.component_div(&self.scale);
        let along = self.eigen.eigenvectors.tr_mul(&scaled);
        let mut sum = 0.0;
        for (k, along) in along.iter().enumerate() {
            if self.is_regular(k) {
                sum += along * along / self.eigen.eigenvalues[k];
            } else if along.abs() > RANK.sqrt() * scaled.norm() {
                return f64::INFINITY;
            }
        }
        sum
    }
}

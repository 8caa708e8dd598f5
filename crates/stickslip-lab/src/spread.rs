//! The covariance of fitted parameters, by independent or by correlated residuals.

use std::ops::Range;

use nalgebra::{DMatrix, DVector};

use crate::loss::Scale;
use crate::normal::{Linearised, Normal};

/// The correlation of neighbouring residuals from which on their independence is given up: standard errors of independent
/// ones would be less than `(.7/1.3)^(1/2)`, three quarters, of the true ones.
const CORRELATED: f64 = 0.3;

/// The covariance of the parameters, and the statistics of the residuals of each record.
#[derive(Debug, Clone)]
pub(crate) struct Spread {
    /// The covariance of the fitted values; infinite for those without influence.
    pub(crate) covariance: DMatrix<f64>,
    pub(crate) parts: Vec<Residuals>,
    normal: Normal,
}

/// The statistics of the residuals of a record.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Residuals {
    /// The standard deviation.
    pub(crate) deviation: f64,
    /// The correlation of neighbours.
    pub(crate) correlation: f64,
    /// The number of independent samples that determine a mean as well.
    pub(crate) samples: f64,
    /// Whether the covariance is that of correlated residuals.
    pub(crate) correlated: bool,
}

/// The rows of a record that have weights, and the slopes of their losses.
struct Block<'a> {
    jacobian: &'a DMatrix<f64>,
    rows: Vec<usize>,
    slopes: Vec<f64>,
}

impl Spread {
    /// The covariance `A^-1 B A^-1` of the minimum of a sum of losses `rho(r)`, `A` their second derivatives and `B` the
    /// covariance of their slopes, over records `r`:
    ///
    /// ```text
    /// A = mean(psi') J^T J,   B = sum v_r J_r^T R_r J_r,   v_r = sum psi^2/(N_r - tr((J^T J)^-1 J_r^T R_r J_r)),   psi = rho'
    /// ```
    ///
    /// With the correlation `c` of neighbouring residuals of a record, `R` has the entries `c^|i - j|` of a process of first
    /// order for `c` above 0.3 and its two standard errors, else it is the identity. Of the correlation that the fit takes
    /// from the residuals, the part of derivatives that vary slowly is added again: `(1 - c) tr(..)/N`. Samples without weight
    /// do not count. Sources: P. J. Huber, "Robust regression", Ann. Statist. 1 (1973); H. White, "A
    /// heteroskedasticity-consistent covariance matrix estimator", Econometrica 48 (1980), in its form for correlated errors.
    pub(crate) fn new(
        linearised: &Linearised,
        weighted: &[bool],
        records: &[(Range<usize>, Scale)],
    ) -> Self {
        let normal = Normal::new(linearised);
        let (residual, jacobian) = linearised;
        let regular = normal.regular_inverse();
        let count = regular.nrows();
        let mut middle = DMatrix::zeros(count, count);
        let (mut parts, mut inside, mut samples) = (Vec::new(), 0, 0);
        for (rows, scale) in records {
            let rows: Vec<usize> = rows.clone().filter(|&n| weighted[n]).collect();
            inside += rows
                .iter()
                .filter(|&&n| scale.is_inside(residual[n]))
                .count();
            samples += rows.len();
            let block = Block {
                jacobian,
                slopes: rows.iter().map(|&n| scale.slope(residual[n])).collect(),
                rows,
            };
            let (statistics, spread) = block.spread(&regular);
            middle += spread;
            parts.push(statistics);
        }
        let curvature = inside as f64 / samples as f64;
        let mut covariance = &regular * middle * &regular / (curvature * curvature);
        for k in 0..count {
            if !normal.has_influence(k) {
                covariance[(k, k)] = f64::INFINITY;
            }
        }
        for part in &mut parts {
            part.deviation /= curvature;
        }
        Self {
            covariance,
            parts,
            normal,
        }
    }

    /// The variance of a weighted sum of the values; infinite if it changes along a combination without influence.
    pub(crate) fn variance(&self, weights: &DVector<f64>) -> f64 {
        if self.normal.variance(weights).is_infinite() {
            return f64::INFINITY;
        }
        let mut sum = 0.0;
        for (i, one) in weights.iter().enumerate() {
            for (j, other) in weights.iter().enumerate() {
                // An infinite variance without weight.
                if *one != 0.0 && *other != 0.0 {
                    sum += one * other * self.covariance[(i, j)];
                }
            }
        }
        sum
    }
}

impl Block<'_> {
    /// The statistics of the residuals, and `v J^T R J`.
    fn spread(&self, regular: &DMatrix<f64>) -> (Residuals, DMatrix<f64>) {
        let count = self.slopes.len() as f64;
        let squares: f64 = self.slopes.iter().map(|slope| slope * slope).sum();
        let found = neighbours(&self.slopes);
        let removed = |middle: &DMatrix<f64>| (regular * middle).trace();
        let lost = removed(&self.correlated(found.max(0.0)));
        let correlation = (found + (1.0 - found) * lost / count).min(1.0 - count.recip());
        let correlated = are_correlated(count, correlation);
        let middle = self.correlated(if correlated { correlation } else { 0.0 });
        let variance = squares / (count - removed(&middle)).max(1.0);
        let statistics = Residuals {
            deviation: variance.sqrt(),
            correlation,
            samples: independent(count, correlation),
            correlated,
        };
        (statistics, variance * middle)
    }

    /// `J^T R J` with `R = c^|i - j|`: each row with the sum over those before, which decays by `c` a row.
    fn correlated(&self, correlation: f64) -> DMatrix<f64> {
        let count = self.jacobian.ncols();
        let (mut row, mut before) = (vec![0.0; count], vec![0.0; count]);
        let mut product = DMatrix::zeros(count, count);
        for &n in &self.rows {
            for (row, column) in row.iter_mut().zip(self.jacobian.column_iter()) {
                *row = column[n];
            }
            for (j, mut column) in product.column_iter_mut().enumerate() {
                for (i, entry) in column.iter_mut().enumerate() {
                    *entry += row[i] * (row[j] + before[j]) + before[i] * row[j];
                }
            }
            for (before, row) in before.iter_mut().zip(&row) {
                *before = correlation * (*before + row);
            }
        }
        product
    }
}

/// The correlation of neighbouring residuals; 0 of none.
pub(crate) fn neighbours(residuals: &[f64]) -> f64 {
    let squares: f64 = residuals.iter().map(|r| r * r).sum();
    let products: f64 = residuals.windows(2).map(|pair| pair[0] * pair[1]).sum();
    if squares > 0.0 {
        products / squares
    } else {
        0.0
    }
}

/// Whether so many samples are correlated: beyond the two standard errors of the correlation of independent ones, too.
fn are_correlated(count: f64, correlation: f64) -> bool {
    correlation > CORRELATED.max(2.0 / count.sqrt())
}

/// The number of independent samples that determine a mean as well as so many whose neighbours have a correlation.
pub(crate) fn independent(count: f64, correlation: f64) -> f64 {
    if are_correlated(count, correlation) {
        count * (1.0 - correlation) / (1.0 + correlation)
    } else {
        count
    }
}

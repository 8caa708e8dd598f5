//! The covariance of fitted parameters, by independent or by correlated residuals.

use nalgebra::{DMatrix, DVector};

use crate::loss::Scale;
use crate::normal::{Linearised, Normal};

/// The correlation of neighbouring residuals from which on their independence is given up: standard errors of independent
/// ones would be less than `(.7/1.3)^(1/2)`, three quarters, of the true ones.
const CORRELATED: f64 = 0.3;

/// The statistics of residuals and of the parameters by them.
#[derive(Debug, Clone)]
pub(crate) struct Spread {
    /// The covariance of the fitted values; infinite for those without influence.
    pub(crate) covariance: DMatrix<f64>,
    /// The standard deviation of the residuals.
    pub(crate) deviation: f64,
    /// The correlation of neighbouring residuals.
    pub(crate) correlation: f64,
    /// The number of independent samples that determine a mean as well.
    pub(crate) samples: f64,
    /// Whether the covariance is that of correlated residuals.
    pub(crate) correlated: bool,
    normal: Normal,
}

impl Spread {
    /// The covariance `A^-1 B A^-1` of the minimum of a sum of losses `rho(r)`, `A` their second derivatives and `B` the
    /// covariance of their slopes:
    ///
    /// ```text
    /// A = mean(psi') J^T J,   B = v J^T R J,   v = sum psi(r)^2/(N - tr((J^T J)^-1 J^T R J)),   psi = rho'
    /// ```
    ///
    /// With the correlation `c` of neighbouring residuals, `R` has the entries `c^|i - j|` of a process of first order for
    /// `c` above 0.3 and its two standard errors, else it is the identity. Of the correlation that the fit takes from the residuals, the part of
    /// derivatives that vary slowly is added again: `(1 - c) tr(..)/N`. Samples without weight do not count. Sources: P. J.
    /// Huber, "Robust regression", Ann. Statist. 1 (1973); H. White, "A heteroskedasticity-consistent covariance matrix
    /// estimator", Econometrica 48 (1980), in its form for correlated errors.
    pub(crate) fn new(linearised: &Linearised, weighted: &[bool], scale: Scale) -> Self {
        let normal = Normal::new(linearised);
        let (residual, jacobian) = linearised;
        let slopes: Vec<f64> = (0..residual.len())
            .filter(|&n| weighted[n])
            .map(|n| scale.slope(residual[n]))
            .collect();
        let rows: Vec<DVector<f64>> = (0..residual.len())
            .filter(|&n| weighted[n])
            .map(|n| jacobian.row(n).transpose())
            .collect();
        let count = slopes.len() as f64;
        let squares: f64 = slopes.iter().map(|slope| slope * slope).sum();
        let found = neighbours(&slopes);
        let regular = normal.regular_inverse();
        let removed = |middle: &DMatrix<f64>| (&regular * middle).trace();
        let lost = removed(&correlated(&rows, found.max(0.0)));
        let correlation = (found + (1.0 - found) * lost / count).min(1.0 - count.recip());
        let inside = residual.iter().zip(weighted);
        let inside = inside.filter(|(r, weighted)| **weighted && scale.is_inside(**r));
        let curvature = inside.count() as f64 / count;
        let is_correlated = are_correlated(count, correlation);
        let (covariance, variance) = if is_correlated {
            let middle = correlated(&rows, correlation);
            let variance = squares / (count - removed(&middle)).max(1.0);
            let mut covariance = &regular * middle * &regular * variance;
            for k in 0..covariance.nrows() {
                if !normal.has_influence(k) {
                    covariance[(k, k)] = f64::INFINITY;
                }
            }
            (covariance, variance)
        } else {
            let variance = squares / (count - normal.rank() as f64);
            (variance * normal.inverse(), variance)
        };
        Self {
            covariance: covariance / (curvature * curvature),
            deviation: variance.sqrt() / curvature,
            correlation,
            samples: independent(count, correlation),
            correlated: is_correlated,
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

/// `J^T R J` with `R = c^|i - j|`: each row with the sum over those before, which decays by `c` a row.
fn correlated(rows: &[DVector<f64>], correlation: f64) -> DMatrix<f64> {
    let count = rows.first().map_or(0, DVector::len);
    let mut sum = DVector::zeros(count);
    let mut product = DMatrix::zeros(count, count);
    for row in rows {
        let before = correlation * &sum;
        product += row * row.transpose() + row * before.transpose() + &before * row.transpose();
        sum = before + row;
    }
    product
}

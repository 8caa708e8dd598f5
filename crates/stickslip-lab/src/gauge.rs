//! The errors of parameters by those of a measured load history.

use nalgebra::{DMatrix, DVector};

use crate::least_squares::Minimum;
use crate::normal::{Linearised, Normal};
use crate::part::Part;
use crate::search::{FINE, Search};

/// The largest number of curves: all errors of up to 31 pieces on their own, and more in groups.
const CURVES: usize = 64;

/// The effect of the errors of a measured history.
pub(crate) struct GaugeErrors {
    /// The covariance of the fitted values.
    pub(crate) covariance: DMatrix<f64>,
    /// The standard deviation of the weighted residuals, by sample.
    pub(crate) deviations: Vec<f64>,
}

impl Search<'_> {
    /// The effect of errors of the gauge of a record on a fit: none of a history that is given.
    ///
    /// The displacement and the velocity of each piece of the history differ by one standard error each, up or down by the
    /// signs of a Hadamard matrix: the effects of all are orthogonal, and the mean of the squares of their sums is the sum of
    /// their squares. A curve that differs by `d` moves the parameters by `-(J^T J)^-1 J^T d`. Source: R. L. Plackett, J.
    /// P. Burman, "The design of optimum multifactorial experiments", Biometrika 33 (1946).
    pub(crate) fn gauge_errors(
        &mut self,
        number: usize,
        minimum: &Minimum,
        linearised: &Linearised,
    ) -> Option<GaugeErrors> {
        let part = &self.model.parts[number];
        let rows = self.model.rows()[number].clone();
        let point = part.point(&self.model.of_part(number, &minimum.parameters));
        let load = part.load;
        // Stress by less than the error of a curve.
        if load.displacement_error() * point.parameters.stiffness <= FINE * self.scale {
            return None;
        }
        let curves = (2 * load.steps().len() + 1).next_power_of_two().min(CURVES);
        let inverse = Normal::new(linearised).regular_inverse();
        let jacobian = linearised.1.rows(rows.start, rows.len());
        let base = part.change(&point, FINE, &mut self.course).ok()?;
        let count = self.model.free.len();
        let mut covariance = DMatrix::zeros(count, count);
        let mut squares = vec![0.0; base.len()];
        for row in 0..curves {
            // A column without a change of sign is left out.
            let sign = |k: usize| {
                let column = 1 + k % (curves - 1);
                if (row & column).count_ones().is_multiple_of(2) {
                    1.0
                } else {
                    -1.0
                }
            };
            let disturbed = load.disturbed(sign);
            let other = Part {
                load: &disturbed,
                ..part.clone()
            };
            let curve = other.change(&point, FINE, &mut self.course).ok()?;
            let differences = curve.iter().zip(&base).zip(&part.roots);
            let differences = differences.map(|((one, other), root)| root * (one - other));
            let differences = DVector::from_iterator(base.len(), differences);
            let moved = &inverse * jacobian.tr_mul(&differences);
            covariance += &moved * moved.transpose() / curves as f64;
            for (square, difference) in squares.iter_mut().zip(&differences) {
                *square += difference * difference / curves as f64;
            }
        }
        Some(GaugeErrors {
            covariance,
            deviations: squares.into_iter().map(f64::sqrt).collect(),
        })
    }
}

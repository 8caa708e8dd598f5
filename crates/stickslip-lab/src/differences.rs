//! Derivatives of residuals by differences, for state laws of one's own.

use nalgebra::{DMatrix, DVector};

use crate::course::Course;
use crate::error::LabError;
use crate::normal::Linearised;
use crate::parameter::Parameter;
use crate::part::Part;

/// The increment of a parameter in differences, of the logarithm of a positive one: the error is a millionth.
const DIFFERENCE: f64 = 1e-3;

impl Part<'_> {
    /// Central differences for all parameters but the linear ones.
    pub(crate) fn by_differences(
        &self,
        values: &[f64],
        tolerance: f64,
        course: &mut Course<'_>,
    ) -> Result<Linearised, LabError> {
        let roots = &self.roots;
        let point = self.point(values);
        let friction = self.friction(&point, tolerance, course)?;
        let residual = DVector::from_fn(friction.len(), |n, _| {
            roots[n] * (friction[n] - self.record.friction()[n])
        });
        let mut jacobian = DMatrix::zeros(friction.len(), self.free.len());
        for (k, parameter) in self.free.iter().enumerate() {
            match parameter {
                Parameter::ReferenceFriction => jacobian.column_mut(k).copy_from_slice(roots),
                Parameter::Trend => {
                    for (n, root) in roots.iter().enumerate() {
                        jacobian[(n, k)] = root * self.trend[n];
                    }
                }
                Parameter::StepOffset => {
                    let column = self.by_offset(&point, tolerance, course)?;
                    for (n, root) in roots.iter().enumerate() {
                        jacobian[(n, k)] = root * column[n];
                    }
                }
                _ => {
                    // b is as large as a, and so is a stress.
                    let unit = match parameter {
                        Parameter::B(_) | Parameter::InitialStress => point.parameters.a,
                        _ => 1.0,
                    };
                    let mut at = |by: f64| {
                        let mut values = values.to_vec();
                        values[k] += by;
                        self.change(&self.point(&values), tolerance, course)
                    };
                    let h = DIFFERENCE * unit;
                    let (more, less) = (at(h)?, at(-h)?);
                    for (n, root) in roots.iter().enumerate() {
                        jacobian[(n, k)] = root * (more[n] - less[n]) / (2.0 * h);
                    }
                }
            }
        }
        Ok((residual, jacobian))
    }
}

//! Residuals of the model of one record and their derivatives, as functions of the fitted parameters.

use nalgebra::{DMatrix, DVector};

use crate::course::Course;
use crate::curve::curve;
use crate::error::LabError;
use crate::evolution::Evolution;
use crate::load::LoadHistory;
use crate::normal::Linearised;
use crate::parameter::Parameter;
use crate::point::Point;
use crate::record::Record;

/// One of the records of a fit, and the parameters that are fitted to it.
#[derive(Clone)]
pub(crate) struct Part<'a> {
    pub(crate) laws: &'a [Evolution<'a>],
    pub(crate) load: &'a LoadHistory,
    pub(crate) record: &'a Record,
    /// The values of all parameters that are not fitted.
    pub(crate) fixed: Point,
    pub(crate) free: Vec<Parameter>,
    /// The places of these among the parameters of all records.
    pub(crate) places: Vec<usize>,
    /// The trend at the samples with a slope of 1; 0 without one.
    pub(crate) trend: Vec<f64>,
    /// The values of some parameters at the start.
    pub(crate) guesses: &'a [(Parameter, f64)],
    /// The noise of the record over the mean of all, which its residuals are divided by.
    pub(crate) noise: f64,
    /// The roots of the weights over the noise.
    pub(crate) roots: Vec<f64>,
}

impl Part<'_> {
    /// Whether each sample has a weight.
    pub(crate) fn weighted(&self) -> Vec<bool> {
        self.roots.iter().map(|root| *root > 0.0).collect()
    }

    /// The number of samples.
    pub(crate) fn len(&self) -> usize {
        self.record.times().len()
    }

    /// The first and the last time of the record; there are samples.
    pub(crate) fn ends(&self) -> (f64, f64) {
        let times = self.record.times();
        (times[0], times[times.len() - 1])
    }

    /// The value of a parameter that is not fitted.
    pub(crate) fn known(&self, parameter: Parameter) -> Option<f64> {
        (!self.free.contains(&parameter)).then(|| self.fixed.value(parameter))
    }

    /// The parameters with these values of the fitted ones, logarithms of positive ones.
    pub(crate) fn point(&self, values: &[f64]) -> Point {
        let mut point = self.fixed.clone();
        for (parameter, &value) in self.free.iter().zip(values) {
            let value = if parameter.is_logarithmic() {
                value.exp()
            } else {
                value
            };
            point.set(*parameter, value);
        }
        point
    }

    /// The values of the fitted parameters, logarithms of positive ones.
    pub(crate) fn values(&self, point: &Point) -> Vec<f64> {
        let values = self.free.iter().map(|parameter| {
            let value = point.value(*parameter);
            if parameter.is_logarithmic() {
                value.ln()
            } else {
                value
            }
        });
        values.collect()
    }

    /// The coefficient of friction at the samples.
    pub(crate) fn friction(
        &self,
        point: &Point,
        tolerance: f64,
        course: &mut Course<'_>,
    ) -> Result<Vec<f64>, LabError> {
        let rows = self.change(point, tolerance, course)?;
        let parameters = &point.parameters;
        Ok((rows.iter().zip(&self.trend))
            .map(|(m, trend)| parameters.reference_friction + m + parameters.trend * trend)
            .collect())
    }

    /// `mu - mu0` at the samples, without the trend.
    pub(crate) fn change(
        &self,
        point: &Point,
        tolerance: f64,
        course: &mut Course<'_>,
    ) -> Result<Vec<f64>, LabError> {
        let times = &self.times(point);
        let (laws, load) = (self.laws, self.load);
        Ok(if laws.len() == 1 {
            let rows = curve::<2, 1>(laws, point, load, times, tolerance, course)?;
            rows.iter().map(|row| row[0]).collect()
        } else {
            let rows = curve::<3, 1>(laws, point, load, times, tolerance, course)?;
            rows.iter().map(|row| row[0]).collect()
        })
    }

    /// The weighted residuals, model minus data, and their derivatives.
    pub(crate) fn linearised(
        &self,
        values: &[f64],
        tolerance: f64,
        course: &mut Course<'_>,
    ) -> Result<Linearised, LabError> {
        let point = self.point(values);
        let custom = (self.laws.iter()).any(|law| matches!(law, Evolution::Custom(_)));
        if custom {
            return self.by_differences(values, tolerance, course);
        }
        let initial = self.free.iter().any(|parameter| {
            matches!(
                parameter,
                Parameter::InitialState(_) | Parameter::InitialStress
            )
        });
        let stiffness = self.free.contains(&Parameter::Stiffness);
        let one = self.laws.len() == 1;
        // As few columns as the parameters need.
        if self.free.iter().any(|parameter| parameter.is_of_law()) {
            return if one {
                self.by_sensitivities::<2, 8>(&point, tolerance, course)
            } else {
                self.by_sensitivities::<3, 12>(&point, tolerance, course)
            };
        }
        match (self.laws.len(), initial, stiffness) {
            (1, false, false) => self.by_sensitivities::<2, 4>(&point, tolerance, course),
            (1, false, true) => self.by_sensitivities::<2, 5>(&point, tolerance, course),
            (1, true, _) => self.by_sensitivities::<2, 7>(&point, tolerance, course),
            (_, false, false) => self.by_sensitivities::<3, 6>(&point, tolerance, course),
            (_, false, true) => self.by_sensitivities::<3, 7>(&point, tolerance, course),
            (_, true, _) => self.by_sensitivities::<3, 10>(&point, tolerance, course),
        }
    }

    fn by_sensitivities<const N: usize, const W: usize>(
        &self,
        point: &Point,
        tolerance: f64,
        course: &mut Course<'_>,
    ) -> Result<Linearised, LabError> {
        use crate::system::column;
        let (times, parameters) = (&self.times(point), &point.parameters);
        let rows = curve::<N, W>(self.laws, point, self.load, times, tolerance, course)?;
        let sources: Vec<(usize, f64)> = (self.free.iter())
            .map(|parameter| match *parameter {
                Parameter::A => (column::A, parameters.a),
                Parameter::B(i) => (column::b(i + 1), 1.0),
                Parameter::SlipDistance(i) => (column::slip_distance::<N>(i + 1), 1.0),
                Parameter::Stiffness => (column::stiffness::<N>(), 1.0),
                Parameter::InitialState(i) => (column::initial_state::<N>(i + 1), 1.0),
                Parameter::InitialStress => (column::initial_stress::<N>(), 1.0),
                Parameter::AgingVelocity(i) | Parameter::StressWeight(i) => {
                    (column::law::<N>(i + 1), 1.0)
                }
                Parameter::ReferenceFriction | Parameter::Trend | Parameter::StepOffset => (0, 0.0),
            })
            .collect();
        let by_offset = if self.free.contains(&Parameter::StepOffset) {
            self.by_offset(point, tolerance, course)?
        } else {
            Vec::new()
        };
        let mut residual = DVector::zeros(rows.len());
        let mut jacobian = DMatrix::zeros(rows.len(), self.free.len());
        for (n, row) in rows.iter().enumerate() {
            let root = self.roots[n];
            let mu = parameters.reference_friction + row[0] + parameters.trend * self.trend[n];
            residual[n] = root * (mu - self.record.friction()[n]);
            for (k, parameter) in self.free.iter().enumerate() {
                jacobian[(n, k)] = root
                    * match parameter {
                        Parameter::ReferenceFriction => 1.0,
                        Parameter::Trend => self.trend[n],
                        Parameter::StepOffset => by_offset[n],
                        _ => sources[k].1 * row[sources[k].0],
                    };
            }
        }
        Ok((residual, jacobian))
    }
}

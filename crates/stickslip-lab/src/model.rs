//! Residuals of the model and their derivatives, as functions of the fitted parameters.

use nalgebra::{DMatrix, DVector};

use crate::curve::{Work, curve};
use crate::error::LabError;
use crate::evolution::Evolution;
use crate::load::LoadHistory;
use crate::normal::Linearised;
use crate::parameter::Parameter;
use crate::point::Point;
use crate::record::Record;

/// A linear trend of friction beside the model.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[doc(alias = "detrend")]
pub enum Trend {
    /// Linear in time.
    Time,
    /// Linear in the displacement of the load point.
    Displacement,
}

impl Trend {
    /// Time \[s\] or displacement \[m\] since the first sample.
    pub(crate) fn basis(self, load: &LoadHistory, times: &[f64]) -> Vec<f64> {
        let at = |time: f64| match self {
            Self::Time => time,
            Self::Displacement => load.displacement(time),
        };
        let first = times.first().map_or(0.0, |&time| at(time));
        times.iter().map(|&time| at(time) - first).collect()
    }
}

/// An experiment and the parameters that are fitted to it.
pub(crate) struct Model<'a> {
    pub(crate) laws: &'a [Evolution<'a>],
    pub(crate) load: &'a LoadHistory,
    pub(crate) record: &'a Record,
    /// The values of all parameters that are not fitted.
    pub(crate) fixed: Point,
    pub(crate) free: Vec<Parameter>,
    /// The trend at the samples with a slope of 1; 0 without one.
    pub(crate) trend: Vec<f64>,
    /// The values of some parameters at the start.
    pub(crate) guesses: &'a [(Parameter, f64)],
    /// The roots of the weights.
    pub(crate) roots: Vec<f64>,
}

impl Model<'_> {
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
        work: &mut Work,
    ) -> Result<Vec<f64>, LabError> {
        let rows = self.change(point, tolerance, work)?;
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
        work: &mut Work,
    ) -> Result<Vec<f64>, LabError> {
        let times = &self.times(point);
        let (laws, load) = (self.laws, self.load);
        Ok(if laws.len() == 1 {
            let rows = curve::<2, 1>(laws, point, load, times, tolerance, work)?;
            rows.iter().map(|row| row[0]).collect()
        } else {
            let rows = curve::<3, 1>(laws, point, load, times, tolerance, work)?;
            rows.iter().map(|row| row[0]).collect()
        })
    }

    /// The weighted residuals, model minus data, and their derivatives.
    pub(crate) fn linearised(
        &self,
        values: &[f64],
        tolerance: f64,
        work: &mut Work,
    ) -> Result<Linearised, LabError> {
        let point = self.point(values);
        let custom = (self.laws.iter()).any(|law| matches!(law, Evolution::Custom(_)));
        if custom {
            return self.by_differences(values, tolerance, work);
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
                self.by_sensitivities::<2, 8>(&point, tolerance, work)
            } else {
                self.by_sensitivities::<3, 12>(&point, tolerance, work)
            };
        }
        match (self.laws.len(), initial, stiffness) {
            (1, false, false) => self.by_sensitivities::<2, 4>(&point, tolerance, work),
            (1, false, true) => self.by_sensitivities::<2, 5>(&point, tolerance, work),
            (1, true, _) => self.by_sensitivities::<2, 7>(&point, tolerance, work),
            (_, false, false) => self.by_sensitivities::<3, 6>(&point, tolerance, work),
            (_, false, true) => self.by_sensitivities::<3, 7>(&point, tolerance, work),
            (_, true, _) => self.by_sensitivities::<3, 10>(&point, tolerance, work),
        }
    }

    fn by_sensitivities<const N: usize, const W: usize>(
        &self,
        point: &Point,
        tolerance: f64,
        work: &mut Work,
    ) -> Result<Linearised, LabError> {
        use crate::system::column;
        let (times, parameters) = (&self.times(point), &point.parameters);
        let rows = curve::<N, W>(self.laws, point, self.load, times, tolerance, work)?;
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
            self.by_offset(point, tolerance, work)?
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

//! The result of a fit.

use nalgebra::{DMatrix, DVector};

use crate::curve::Work;
use crate::doubts::warnings;
use crate::end::End;
use crate::fit::Fit;
use crate::least_squares::Minimum;
use crate::loss::Loss;
use crate::model::Trend;
use crate::parameter::Parameter;
use crate::parameters::Parameters;
use crate::search::Search;
use crate::spikes::Spike;
use crate::warning::Warning;

/// A fitted parameter.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Estimate {
    /// The parameter.
    pub parameter: Parameter,
    /// Its value, in SI units.
    pub value: f64,
    /// Its standard error, in the unit of the value; infinite if the data do not depend on it.
    pub standard_error: f64,
}

/// The errors of the data that standard errors assume.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Errors {
    /// Independent errors with equal weighted variance.
    Independent,
    /// Of errors of which neighbours have the correlation `c` of the residuals, and others `c^n` over `n` samples: a process
    /// of first order, AR(1).
    Correlated,
}

/// The result of a fit. It prints as a table.
#[derive(Debug, Clone)]
pub struct Fitted {
    /// The parameters of the minimum, with those that were fixed.
    pub parameters: Parameters,
    /// The fitted parameters with their standard errors, in the linear approximation: [`errors`](Self::errors) says of which
    /// data. Those of a measured load history are in them.
    pub estimates: Vec<Estimate>,
    /// The correlations of the fitted parameters, in the order of `estimates`; NaN where a standard error is infinite.
    pub correlation: DMatrix<f64>,
    /// The time by which the velocity changes are later than the load history says \[s\]; 0 unless it is fitted or fixed.
    pub step_offset: f64,
    /// Shear over normal stress at the first sample above that at which the block slides with the load point; 0 unless it is
    /// fitted or fixed.
    pub initial_stress: f64,
    /// `a - sum b_i` and its standard error.
    pub a_minus_b: (f64, f64),
    /// The weighted root mean square of the residuals.
    pub rms: f64,
    /// The errors of the data that standard errors and correlations assume.
    pub errors: Errors,
    /// The correlation of the residuals of neighbouring samples, with that which the fit takes from them.
    #[doc(alias = "autocorrelation")]
    pub lag_one: f64,
    /// The number of independent samples that determine a mean as well: `N (1 - c)/(1 + c)` with the correlation `c` of
    /// neighbours where it is above 0.3 and its two standard errors, else all.
    pub effective_samples: f64,
    /// Samples far beside their neighbours, in order: of ten thousand records without spikes one has such a sample.
    #[doc(alias = "outliers")]
    pub spikes: Vec<Spike>,
    /// The loss that is minimised.
    pub loss: Loss,
    /// The weighted standard deviation of the residuals: the root of the sum of squares over the number of samples
    /// minus that of parameters. By Huber's loss that of the errors beside spikes.
    pub deviation: f64,
    /// Akaike's information criterion, `N ln(sum of squares/N) + 2 (P + 1)`, up to a constant of the data: between
    /// models of the same data the smaller one is preferred, by `exp(-difference/2)`. By Huber's loss the sum is that of the
    /// losses.
    pub aic: f64,
    /// Warnings of parameters that the data do not determine.
    pub warnings: Vec<Warning>,
    /// The coefficient of friction of the model at the samples.
    pub friction: Vec<f64>,
    /// Data minus model at the samples.
    pub residuals: Vec<f64>,
    /// The names of the state laws.
    pub laws: Vec<&'static str>,
    /// The trend of the model.
    pub trend: Option<Trend>,
    /// The number of attempted steps of least squares, over all starts.
    pub steps: usize,
    /// The relative offset: the remaining distance to the minimum over the radius of the confidence region; 0 where a
    /// further step would change the curve by less than the error of its integration, as for data without noise.
    pub offset: f64,
    /// The number of curves and of their steps.
    pub work: Work,
}

impl Fitted {
    pub(crate) fn new(search: &Search<'_>, fit: &Fit<'_>, minimum: Minimum, end: End) -> Self {
        let model = search.model;
        let point = model.point(&minimum.parameters);
        let samples = model.record.weighted() as f64;
        // Of the values, not of their logarithms.
        let unit = |k: usize| {
            let parameter: Parameter = model.free[k];
            if parameter.is_logarithmic() {
                point.value(parameter)
            } else {
                1.0
            }
        };
        let count = model.free.len();
        let covariance = DMatrix::from_fn(count, count, |i, j| {
            unit(i) * unit(j) * end.spread.covariance[(i, j)]
        });
        let estimates = (0..count).map(|k| Estimate {
            parameter: model.free[k],
            value: point.value(model.free[k]),
            standard_error: covariance[(k, k)].sqrt(),
        });
        let correlation = DMatrix::from_fn(count, count, |i, j| {
            covariance[(i, j)] / (covariance[(i, i)] * covariance[(j, j)]).sqrt()
        });
        let difference = DVector::from_fn(count, |k, _| match model.free[k] {
            Parameter::A => point.parameters.a,
            Parameter::B(_) => -1.0,
            _ => 0.0,
        });
        let errors = if end.spread.correlated {
            Errors::Correlated
        } else {
            Errors::Independent
        };
        let data = model.record.friction();
        let mut fitted = Self {
            a_minus_b: (
                point.parameters.a_minus_b(),
                end.spread.variance(&difference).sqrt(),
            ),
            estimates: estimates.collect(),
            correlation,
            rms: (end.squares / model.record.weights().iter().sum::<f64>()).sqrt(),
            deviation: end.spread.deviation,
            aic: samples * (end.losses / samples).ln() + 2.0 * (count as f64 + 1.0),
            warnings: Vec::new(),
            friction: (data.iter().zip(&end.residuals))
                .map(|(mu, residual)| mu - residual)
                .collect(),
            laws: model.laws.iter().map(|law| law.name()).collect(),
            trend: fit.trend,
            loss: fit.loss,
            errors,
            lag_one: end.spread.correlation,
            effective_samples: end.spread.samples,
            spikes: end.spikes.clone(),
            steps: search.steps,
            offset: minimum.offset,
            work: search.work,
            step_offset: point.step_offset,
            initial_stress: point.initial_stress,
            parameters: point.parameters,
            residuals: end.residuals.clone(),
        };
        fitted.warnings = warnings(&fitted, model, &minimum.parameters, search.bounds, &end);
        fitted
    }

    /// The value of a parameter, fitted or fixed.
    ///
    /// # Panics
    /// For a state that the model does not have.
    pub fn value(&self, parameter: Parameter) -> f64 {
        match parameter {
            Parameter::StepOffset => self.step_offset,
            Parameter::InitialStress => self.initial_stress,
            _ => parameter.of(&self.parameters),
        }
    }

    /// The standard error of a parameter, 0 of one that was fixed.
    pub fn standard_error(&self, parameter: Parameter) -> f64 {
        let found = self
            .estimates
            .iter()
            .find(|found| found.parameter == parameter);
        found.map_or(0.0, |estimate| estimate.standard_error)
    }
}

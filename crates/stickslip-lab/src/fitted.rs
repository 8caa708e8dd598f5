//! The result of a fit.

use nalgebra::{DMatrix, DVector};

use crate::curve::Work;
use crate::doubts::warnings;
use crate::end::End;
use crate::fit::Fit;
use crate::least_squares::Minimum;
use crate::loss::Loss;
use crate::model::Model;
use crate::parameter::Parameter;
use crate::parameters::Parameters;
use crate::part::Part;
use crate::point::Point;
use crate::search::Search;
use crate::spikes::Spike;
use crate::trend::Trend;
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
    /// The slides and holds of the load point over the record, as they were given or read from a measured displacement: the time
    /// \[s\] from which on it has a velocity [m/s], 0 in a hold. The first one begins at the first sample.
    pub load: Vec<(f64, f64)>,
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
    /// Whether the fit was [interrupted](crate::Fit::with_interrupt): the parameters are the best so far, which are no minimum.
    pub interrupted: bool,
    /// The number of curves and of their steps.
    pub work: Work,
}

impl Fitted {
    /// The result for one of the records.
    pub(crate) fn new(
        search: &Search<'_>,
        fit: &Fit<'_>,
        minimum: &Minimum,
        end: &End,
        number: usize,
    ) -> Self {
        let (model, part) = (search.model, &search.model.parts[number]);
        let values = model.of_part(number, &minimum.parameters);
        let point = part.point(&values);
        let covariance = covariance(model, minimum, end);
        let places = &part.places;
        let estimates = part
            .free
            .iter()
            .zip(places)
            .map(|(&parameter, &place)| Estimate {
                parameter,
                value: point.value(parameter),
                standard_error: covariance[(place, place)].sqrt(),
            });
        let of_part = covariance.select_rows(places).select_columns(places);
        let (statistics, own) = (&end.spread.parts[number], &end.parts[number]);
        let errors = if statistics.correlated {
            Errors::Correlated
        } else {
            Errors::Independent
        };
        let data = part.record.friction();
        let mut fitted = Self {
            a_minus_b: a_minus_b(search, &point, end),
            estimates: estimates.collect(),
            correlation: correlation(&of_part),
            rms: (own.squares / part.record.weights().iter().sum::<f64>()).sqrt(),
            deviation: part.noise * statistics.deviation,
            aic: end.aic,
            warnings: Vec::new(),
            friction: (data.iter().zip(&own.residuals))
                .map(|(mu, residual)| mu - residual)
                .collect(),
            laws: part.laws.iter().map(|law| law.name()).collect(),
            trend: fit.trend,
            loss: fit.loss,
            errors,
            lag_one: statistics.correlation,
            effective_samples: statistics.samples,
            spikes: own.spikes.clone(),
            steps: search.steps,
            offset: minimum.offset,
            interrupted: search.course.is_interrupted(),
            work: search.course.work,
            load: slides(part, point.step_offset),
            step_offset: point.step_offset,
            initial_stress: point.initial_stress,
            parameters: point.parameters,
            residuals: own.residuals.clone(),
        };
        fitted.warnings = warnings(&fitted, search, &values, end, number);
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

/// The covariance of all fitted values, not of their logarithms.
pub(crate) fn covariance(model: &Model<'_>, minimum: &Minimum, end: &End) -> DMatrix<f64> {
    let units: Vec<f64> = (model.free.iter().zip(&minimum.parameters))
        .map(|(free, value)| {
            if free.parameter.is_logarithmic() {
                value.exp()
            } else {
                1.0
            }
        })
        .collect();
    let count = units.len();
    DMatrix::from_fn(count, count, |i, j| {
        units[i] * units[j] * end.spread.covariance[(i, j)]
    })
}

/// The correlations of a covariance.
pub(crate) fn correlation(covariance: &DMatrix<f64>) -> DMatrix<f64> {
    DMatrix::from_fn(covariance.nrows(), covariance.ncols(), |i, j| {
        covariance[(i, j)] / (covariance[(i, i)] * covariance[(j, j)]).sqrt()
    })
}

/// `a - sum b_i` and its standard error.
pub(crate) fn a_minus_b(search: &Search<'_>, point: &Point, end: &End) -> (f64, f64) {
    let free = &search.model.free;
    let weights = DVector::from_fn(free.len(), |k, _| match free[k].parameter {
        Parameter::A => point.parameters.a,
        Parameter::B(_) => -1.0,
        _ => 0.0,
    });
    (
        point.parameters.a_minus_b(),
        end.spread.variance(&weights).sqrt(),
    )
}

/// Slides and holds over a record, whose steps come later by an offset \[s\].
fn slides(part: &Part<'_>, offset: f64) -> Vec<(f64, f64)> {
    let (first, last) = part.ends();
    let phases = part.load.phases(first - offset, last - offset);
    let slides = phases.iter();
    slides
        .map(|phase| (phase.start + offset, phase.velocity))
        .collect()
}

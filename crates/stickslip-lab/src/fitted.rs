//! The result of a fit.

use std::fmt;

use nalgebra::{DMatrix, DVector};

use crate::curve::Work;
use crate::least_squares::Minimum;
use crate::model::Trend;
use crate::parameters::{Parameter, Parameters};
use crate::score::Tests;
use crate::search::Search;
use crate::warning::{Warning, warnings};

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

/// The result of a fit. It prints as a table.
#[derive(Debug, Clone)]
pub struct Fitted {
    /// The parameters of the minimum, with those that were fixed.
    pub parameters: Parameters,
    /// The fitted parameters with their standard errors: for independent errors of the data with equal weighted
    /// variance, in the linear approximation.
    pub estimates: Vec<Estimate>,
    /// The correlations of the fitted parameters, in the order of `estimates`; NaN where a standard error is infinite.
    pub correlation: DMatrix<f64>,
    /// The time by which the velocity changes are later than the load history says \[s\]; 0 unless it is fitted or fixed.
    pub step_offset: f64,
    /// `a - sum b_i` and its standard error.
    pub a_minus_b: (f64, f64),
    /// The weighted root mean square of the residuals.
    pub rms: f64,
    /// The weighted standard deviation of the residuals: the root of the sum of squares over the number of samples
    /// minus that of parameters.
    pub deviation: f64,
    /// Akaike's information criterion, `N ln(sum of squares/N) + 2 (P + 1)`, up to a constant of the data: between
    /// models of the same data the smaller one is preferred, by `exp(-difference/2)`.
    pub aic: f64,
    /// What the data do not determine.
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
    pub(crate) fn new(
        search: &Search<'_>,
        trend: Option<Trend>,
        minimum: Minimum,
        tests: &Tests,
        curve: Vec<f64>,
    ) -> Self {
        let model = search.model;
        let point = model.point(&minimum.parameters);
        let samples = model.record.weighted() as f64;
        let squares = minimum.residual.norm_squared();
        let variance = squares / (samples - minimum.normal.rank() as f64);
        let inverse = minimum.normal.inverse();
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
            variance * unit(i) * unit(j) * inverse[(i, j)]
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
        let spread = variance * minimum.normal.variance(&difference);
        let residuals = (minimum.residual.iter())
            .zip(model.record.weights())
            .zip(model.record.friction().iter().zip(&curve))
            .map(|((residual, weight), (mu, model))| {
                // The residual has more digits than the difference.
                if *weight > 0.0 {
                    -residual / weight.sqrt()
                } else {
                    mu - model
                }
            })
            .collect();
        let mut fitted = Self {
            a_minus_b: (point.parameters.a_minus_b(), spread.sqrt()),
            estimates: estimates.collect(),
            correlation,
            rms: (squares / model.record.weights().iter().sum::<f64>()).sqrt(),
            deviation: variance.sqrt(),
            aic: samples * (squares / samples).ln() + 2.0 * (count as f64 + 1.0),
            warnings: Vec::new(),
            friction: curve,
            residuals,
            laws: model.laws.iter().map(|law| law.name()).collect(),
            trend,
            steps: search.steps,
            offset: minimum.offset,
            work: search.work,
            step_offset: point.step_offset,
            parameters: point.parameters,
        };
        fitted.warnings = warnings(&fitted, model, &minimum.parameters, search.bounds, tests);
        fitted
    }

    /// The value of a parameter, fitted or fixed.
    ///
    /// # Panics
    /// For a state that the model does not have.
    pub fn value(&self, parameter: Parameter) -> f64 {
        match parameter {
            Parameter::StepOffset => self.step_offset,
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

impl fmt::Display for Fitted {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let law = match &self.laws[..] {
            [one, two] if one == two => format!("two states, {one} law"),
            [one, two] => format!("two states, {one} and {two} law"),
            _ => format!("one state, {} law", self.laws[0]),
        };
        writeln!(
            f,
            "{law}, V0 = {:e} m/s, {} samples",
            self.parameters.reference_velocity,
            self.residuals.len()
        )?;
        for estimate in &self.estimates {
            let unit = match estimate.parameter {
                Parameter::SlipDistance(_) => " m",
                Parameter::Stiffness => " 1/m",
                Parameter::Trend if self.trend == Some(Trend::Time) => " 1/s",
                Parameter::Trend => " 1/m",
                Parameter::StepOffset => " s",
                _ => "",
            };
            let row = rounded(estimate.value, estimate.standard_error);
            writeln!(f, "{:<14} {row}{unit}", estimate.parameter)?;
        }
        let (value, error) = self.a_minus_b;
        writeln!(f, "{:<14} {}", "a - b", rounded(value, error))?;
        write!(f, "{:<14} {:.2e}, AIC {:.1}", "rms", self.rms, self.aic)?;
        for warning in &self.warnings {
            write!(f, "\nwarning: {warning}")?;
        }
        Ok(())
    }
}

/// A value and its standard error, with two digits of the latter.
pub(crate) fn rounded(value: f64, error: f64) -> String {
    if !(error.is_finite() && error > 0.0) {
        return format!("{value:.4e} +- {error}");
    }
    let largest = value.abs().max(error);
    let digits = (largest.log10().floor() - error.log10().floor() + 1.0).clamp(0.0, 12.0) as usize;
    let exponent = largest.log10().floor() as i32;
    let mut scale = 10_f64.powi(exponent);
    let mut suffix = format!("e{exponent}");
    if (-3..4).contains(&exponent) {
        scale = 1.0;
        suffix.clear();
    }
    let digits = if scale == 1.0 {
        (digits as i32 - exponent).max(0) as usize
    } else {
        digits
    };
    format!(
        "({:.digits$} +- {:.digits$}){suffix}",
        value / scale,
        error / scale
    )
}

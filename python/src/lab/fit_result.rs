//! The result of a fit.

use numpy::{PyArray1, PyArray2, PyArrayMethods};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use stickslip::lab::{Errors, Evolution, Fitted, Parameter, Record};

use crate::plain::{Reduced, fields, helper, reduced};
use crate::view::view;

/// The result of a fit; `print` shows its table, `result["a"]` a parameter by its name, fitted or fixed. Its curves are
/// views, which cannot be written.
#[pyclass(frozen, module = "stickslip")]
pub(crate) struct FitResult {
    /// Fitted parameters by name, in SI units.
    #[pyo3(get)]
    parameters: Py<PyAny>,
    /// Standard errors of the fitted parameters by name, in their units.
    #[pyo3(get)]
    errors: Py<PyAny>,
    /// All parameters by name, fitted or fixed.
    #[pyo3(get)]
    values: Py<PyAny>,
    /// Correlations of the fitted parameters, in the order of `parameters`.
    #[pyo3(get)]
    correlation: Py<PyArray2<f64>>,
    /// a - b and its standard error.
    #[pyo3(get)]
    a_minus_b: (f64, f64),
    /// Weighted root mean square of the residuals.
    #[pyo3(get)]
    pub(super) rms: f64,
    /// Akaike's information criterion: of fits of the same data, the smaller one is preferred.
    #[pyo3(get)]
    aic: f64,
    /// Whether the standard errors are those of correlated residuals, by their correlation lag_one; else of independent ones.
    #[pyo3(get)]
    correlated_errors: bool,
    /// Correlation of the residuals of neighbouring samples.
    #[pyo3(get)]
    lag_one: f64,
    /// Number of independent samples that determine a mean as well.
    #[pyo3(get)]
    effective_samples: f64,
    /// Samples far beside their neighbours: pairs (time [s], data minus model).
    #[pyo3(get)]
    spikes: Vec<(f64, f64)>,
    /// Whether the fit was interrupted: the parameters are the best so far, which are no minimum.
    #[pyo3(get)]
    interrupted: bool,
    /// What the data do not determine, a sentence each.
    #[pyo3(get)]
    warnings: Vec<String>,
    /// Slides and holds of the load point, as given or read from displacements: pairs (time [s], velocity [m/s] from then on).
    #[pyo3(get)]
    load: Vec<(f64, f64)>,
    /// Times of the samples [s].
    t: Vec<f64>,
    /// Coefficient of friction of the model at the samples.
    mu: Vec<f64>,
    /// Data minus model at the samples.
    residuals: Vec<f64>,
    /// Names of the state laws.
    #[pyo3(get)]
    laws: Vec<String>,
    /// The table that `print` shows.
    #[pyo3(get)]
    text: String,
}

impl FitResult {
    pub(super) fn of(py: Python<'_>, record: &Record, fitted: &Fitted) -> PyResult<Self> {
        let named = |table: Vec<(String, f64)>| -> PyResult<_> {
            Ok(helper(py, "_names", "Parameters", (table,))?.unbind())
        };
        let estimates = |value: fn(&stickslip::lab::Estimate) -> f64| {
            let estimates = fitted.estimates.iter();
            let estimates =
                estimates.map(|estimate| (estimate.parameter.to_string(), value(estimate)));
            estimates.collect()
        };
        let matrix = &fitted.correlation;
        let correlation = PyArray1::from_slice(py, matrix.as_slice());
        Ok(Self {
            parameters: named(estimates(|estimate| estimate.value))?,
            errors: named(estimates(|estimate| estimate.standard_error))?,
            values: named(values(fitted))?,
            correlation: correlation
                .reshape([matrix.nrows(), matrix.ncols()])?
                .unbind(),
            a_minus_b: fitted.a_minus_b,
            rms: fitted.rms,
            aic: fitted.aic,
            correlated_errors: fitted.errors == Errors::Correlated,
            lag_one: fitted.lag_one,
            effective_samples: fitted.effective_samples,
            spikes: (fitted.spikes.iter())
                .map(|spike| (spike.time, spike.residual))
                .collect(),
            interrupted: fitted.interrupted,
            warnings: fitted.warnings.iter().map(ToString::to_string).collect(),
            load: fitted.load.clone(),
            t: record.times().to_vec(),
            mu: fitted.friction.clone(),
            residuals: fitted.residuals.clone(),
            laws: fitted.laws.iter().map(ToString::to_string).collect(),
            text: fitted.to_string(),
        })
    }
}

/// The parameters that the model has, by name.
fn values(fitted: &Fitted) -> Vec<(String, f64)> {
    let of_states = fitted.laws.iter().enumerate().flat_map(|(i, law)| {
        let law = law.parse::<Evolution<'static>>().ok();
        let own = law.and_then(|law| law.parameter(i));
        let all = [
            Parameter::B(i),
            Parameter::SlipDistance(i),
            Parameter::InitialState(i),
        ];
        all.into_iter().chain(own)
    });
    let others = [
        Parameter::Stiffness,
        Parameter::ReferenceFriction,
        Parameter::Trend,
        Parameter::StepOffset,
        Parameter::InitialStress,
    ];
    let all = [Parameter::A].into_iter().chain(of_states).chain(others);
    all.map(|parameter| (parameter.to_string(), fitted.value(parameter)))
        .collect()
}

#[pymethods]
impl FitResult {
    #[new]
    #[pyo3(signature = (*, parameters, errors, values, correlation, a_minus_b, rms, aic, correlated_errors, lag_one,
                        effective_samples, spikes, interrupted, warnings, load, t, mu, residuals, laws, text))]
    #[expect(clippy::too_many_arguments, reason = "keywords in Python")]
    fn new(
        parameters: Py<PyAny>,
        errors: Py<PyAny>,
        values: Py<PyAny>,
        correlation: Py<PyArray2<f64>>,
        a_minus_b: (f64, f64),
        rms: f64,
        aic: f64,
        correlated_errors: bool,
        lag_one: f64,
        effective_samples: f64,
        spikes: Vec<(f64, f64)>,
        interrupted: bool,
        warnings: Vec<String>,
        load: Vec<(f64, f64)>,
        t: Vec<f64>,
        mu: Vec<f64>,
        residuals: Vec<f64>,
        laws: Vec<String>,
        text: String,
    ) -> Self {
        Self {
            parameters,
            errors,
            values,
            correlation,
            a_minus_b,
            rms,
            aic,
            correlated_errors,
            lag_one,
            effective_samples,
            spikes,
            interrupted,
            warnings,
            load,
            t,
            mu,
            residuals,
            laws,
            text,
        }
    }

    /// Times of the samples [s].
    #[getter]
    fn t<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyArray1<f64>>> {
        view(slf, |result| result.t.as_slice().into())
    }

    /// Coefficient of friction of the model at the samples.
    #[getter]
    fn mu<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyArray1<f64>>> {
        view(slf, |result| result.mu.as_slice().into())
    }

    /// Data minus model at the samples.
    #[getter]
    fn residuals<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyArray1<f64>>> {
        view(slf, |result| result.residuals.as_slice().into())
    }

    /// A parameter by its name, fitted or fixed: a, b1 or b, L1, L or Dc, b2, L2, k, mu0, trend, step_offset.
    fn __getitem__<'py>(&self, py: Python<'py>, name: &str) -> PyResult<Bound<'py, PyAny>> {
        self.values.bind(py).get_item(name)
    }

    /// A table of pandas with a row per fitted parameter: its value and its standard error.
    fn to_frame<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let table = fields!(py, self; parameters, errors);
        helper(py, "_frames", "fit", (table,))
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<Reduced<'py>> {
        let (py, own) = (slf.py(), slf.get());
        let given = fields!(py, own; parameters, errors, values, correlation, a_minus_b, rms, aic, correlated_errors,
            lag_one, effective_samples, spikes, interrupted, warnings, load, laws, text);
        for curve in ["t", "mu", "residuals"] {
            given.set_item(curve, slf.getattr(curve)?)?;
        }
        reduced::<Self>(py, given)
    }

    fn _repr_html_(&self, py: Python<'_>) -> PyResult<String> {
        let table = fields!(py, self; parameters, errors, rms, warnings);
        helper(py, "_plain", "fit", (table,))?.extract()
    }

    fn __str__(&self) -> &str {
        &self.text
    }

    fn __repr__(&self, py: Python<'_>) -> PyResult<String> {
        let parameters = self.parameters.bind(py).cast::<PyDict>()?.iter();
        let parameters: PyResult<Vec<_>> = parameters
            .map(|(name, value)| Ok(format!("{name}={:.6e}", value.extract::<f64>()?)))
            .collect();
        Ok(format!("FitResult({})", parameters?.join(", ")))
    }
}

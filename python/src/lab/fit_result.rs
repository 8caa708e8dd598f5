//! The result of a fit.

use numpy::{PyArray1, PyArray2, PyArrayMethods};
use pyo3::exceptions::PyKeyError;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use stickslip::lab::{Errors, Fitted, Parameter, Record};

use crate::view::view;

/// The result of a fit; `print` shows its table, `result["a"]` a parameter by its name. Its curves are
/// views, which cannot be written.
#[pyclass(frozen, module = "stickslip")]
pub(crate) struct FitResult {
    fitted: Fitted,
    times: Vec<f64>,
}

impl FitResult {
    pub(super) fn new(_: Python<'_>, record: &Record, fitted: Fitted) -> Self {
        let times = record.times().to_vec();
        Self { fitted, times }
    }

    /// The parameter of a name that the model has.
    fn parameter(&self, name: &str) -> PyResult<Parameter> {
        let states = self.fitted.parameters.states.len();
        let found = name
            .parse::<Parameter>()
            .ok()
            .filter(|parameter| match parameter {
                Parameter::B(i) | Parameter::SlipDistance(i) | Parameter::InitialState(i) => {
                    *i < states
                }
                _ => true,
            });
        let unknown = || {
            let message =
                format!("{name:?} is none of a, b1, L1, b2, L2, k, mu0, trend and step_offset");
            PyKeyError::new_err(message)
        };
        found.ok_or_else(unknown)
    }

    fn table<'py>(
        &self,
        py: Python<'py>,
        value: impl Fn(&stickslip::lab::Estimate) -> f64,
    ) -> PyResult<Bound<'py, PyDict>> {
        let table = PyDict::new(py);
        for estimate in &self.fitted.estimates {
            table.set_item(estimate.parameter.to_string(), value(estimate))?;
        }
        Ok(table)
    }
}

#[pymethods]
impl FitResult {
    /// Fitted parameters by name, in SI units.
    #[getter]
    fn parameters<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        self.table(py, |estimate| estimate.value)
    }

    /// Standard errors of the fitted parameters by name, in their units.
    #[getter]
    fn errors<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        self.table(py, |estimate| estimate.standard_error)
    }

    /// Correlations of the fitted parameters, in the order of `parameters`.
    #[getter]
    fn correlation<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let matrix = &self.fitted.correlation;
        PyArray1::from_slice(py, matrix.as_slice()).reshape([matrix.nrows(), matrix.ncols()])
    }

    /// a - b and its standard error.
    #[getter]
    fn a_minus_b(&self) -> (f64, f64) {
        self.fitted.a_minus_b
    }

    /// Weighted root mean square of the residuals.
    #[getter]
    fn rms(&self) -> f64 {
        self.fitted.rms
    }

    /// Akaike's information criterion: of fits of the same data, the smaller one is preferred.
    #[getter]
    fn aic(&self) -> f64 {
        self.fitted.aic
    }

    /// What the data do not determine, a sentence each.
    #[getter]
    fn warnings(&self) -> Vec<String> {
        self.fitted
            .warnings
            .iter()
            .map(ToString::to_string)
            .collect()
    }

    /// Whether the standard errors are those of correlated residuals, by their correlation lag_one; else of independent ones.
    #[getter]
    fn correlated_errors(&self) -> bool {
        self.fitted.errors == Errors::Correlated
    }

    /// Correlation of the residuals of neighbouring samples.
    #[getter]
    fn lag_one(&self) -> f64 {
        self.fitted.lag_one
    }

    /// Number of independent samples that determine a mean as well.
    #[getter]
    fn effective_samples(&self) -> f64 {
        self.fitted.effective_samples
    }

    /// Samples far beside their neighbours: pairs (time [s], data minus model).
    #[getter]
    fn spikes(&self) -> Vec<(f64, f64)> {
        let spikes = self.fitted.spikes.iter();
        spikes.map(|spike| (spike.time, spike.residual)).collect()
    }

    /// Times of the samples [s].
    #[getter]
    fn t<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyArray1<f64>>> {
        view(slf, |result| result.times.as_slice().into())
    }

    /// Coefficient of friction of the model at the samples.
    #[getter]
    fn mu<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyArray1<f64>>> {
        view(slf, |result| result.fitted.friction.as_slice().into())
    }

    /// Data minus model at the samples.
    #[getter]
    fn residuals<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyArray1<f64>>> {
        view(slf, |result| result.fitted.residuals.as_slice().into())
    }

    /// Names of the state laws.
    #[getter]
    fn laws(&self) -> Vec<&'static str> {
        self.fitted.laws.clone()
    }

    /// A parameter by its name, fitted or fixed.
    fn __getitem__(&self, name: &str) -> PyResult<f64> {
        Ok(self.fitted.value(self.parameter(name)?))
    }

    fn __str__(&self) -> String {
        self.fitted.to_string()
    }

    fn __repr__(&self) -> String {
        let parameters = self.fitted.estimates.iter();
        let parameters: Vec<_> = parameters
            .map(|estimate| format!("{}={:.6e}", estimate.parameter, estimate.value))
            .collect();
        format!("FitResult({})", parameters.join(", "))
    }
}

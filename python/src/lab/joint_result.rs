//! The result of a fit of several records.

use numpy::{PyArray1, PyArray2, PyArrayMethods};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use stickslip::lab::{JointEstimate, JointFit, Record};

use super::fit_result::FitResult;
use crate::plain::{Reduced, fields, helper, reduced};

/// The result of a fit of several records; `print` shows its table, `result["a"]` a shared parameter, and `result["k[0]"]` that
/// of the first record.
#[pyclass(frozen, get_all, module = "stickslip")]
pub(crate) struct JointFitResult {
    /// Fitted parameters by name, in SI units: shared ones, and those of records such as "k[0]".
    parameters: Py<PyAny>,
    /// Standard errors of the fitted parameters by name, in their units.
    errors: Py<PyAny>,
    /// Correlations of the fitted parameters, in the order of `parameters`.
    correlation: Py<PyArray2<f64>>,
    /// a - b and its standard error.
    a_minus_b: (f64, f64),
    /// Akaike's information criterion: of fits of the same data, the smaller one is preferred.
    aic: f64,
    /// Whether the fit was interrupted: the parameters are the best so far, which are no minimum.
    interrupted: bool,
    /// What the data do not determine, a sentence each, with the index of the record if it is of one.
    warnings: Vec<String>,
    /// The results of the records, each with its parameters, curve and warnings; their standard errors are those of the whole
    /// fit.
    records: Vec<Py<FitResult>>,
    /// The table that `print` shows.
    text: String,
}

/// The name of a parameter, with the record that has it.
fn name(estimate: &JointEstimate) -> String {
    match estimate.record {
        None => estimate.parameter.to_string(),
        Some(record) => format!("{}[{record}]", estimate.parameter),
    }
}

impl JointFitResult {
    pub(super) fn of<'a>(
        py: Python<'_>,
        records: impl Iterator<Item = &'a Record>,
        fitted: &JointFit,
    ) -> PyResult<Self> {
        let named = |value: fn(&JointEstimate) -> f64| -> PyResult<_> {
            let estimates = fitted.estimates.iter();
            let table: Vec<_> = estimates.map(|e| (name(e), value(e))).collect();
            Ok(helper(py, "_names", "Parameters", (table,))?.unbind())
        };
        let matrix = &fitted.correlation;
        let correlation = PyArray1::from_slice(py, matrix.as_slice());
        let records = records.zip(&fitted.records);
        let records =
            records.map(|(record, fitted)| Py::new(py, FitResult::of(py, record, fitted)?));
        let warnings = fitted.warnings().into_iter();
        let warnings = warnings.map(|(record, warning)| match record {
            None => warning.to_string(),
            Some(record) => format!("records[{record}]: {warning}"),
        });
        Ok(Self {
            parameters: named(|estimate| estimate.value)?,
            errors: named(|estimate| estimate.standard_error)?,
            correlation: correlation
                .reshape([matrix.nrows(), matrix.ncols()])?
                .unbind(),
            a_minus_b: fitted.a_minus_b,
            aic: fitted.aic,
            interrupted: fitted.interrupted,
            warnings: warnings.collect(),
            records: records.collect::<PyResult<_>>()?,
            text: fitted.to_string(),
        })
    }
}

#[pymethods]
impl JointFitResult {
    #[new]
    #[pyo3(signature = (*, parameters, errors, correlation, a_minus_b, aic, interrupted, warnings, records, text))]
    #[expect(clippy::too_many_arguments, reason = "keywords in Python")]
    fn new(
        parameters: Py<PyAny>,
        errors: Py<PyAny>,
        correlation: Py<PyArray2<f64>>,
        a_minus_b: (f64, f64),
        aic: f64,
        interrupted: bool,
        warnings: Vec<String>,
        records: Vec<Py<FitResult>>,
        text: String,
    ) -> Self {
        Self {
            parameters,
            errors,
            correlation,
            a_minus_b,
            aic,
            interrupted,
            warnings,
            records,
            text,
        }
    }

    fn __len__(&self) -> usize {
        self.records.len()
    }

    /// A fitted parameter by its name: of all records, or of one, such as "k[0]".
    fn __getitem__<'py>(&self, py: Python<'py>, name: &str) -> PyResult<Bound<'py, PyAny>> {
        self.parameters.bind(py).get_item(name)
    }

    /// A table of pandas with a row per fitted parameter: its value and its standard error.
    fn to_frame<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let table = fields!(py, self; parameters, errors);
        helper(py, "_frames", "fit", (table,))
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Reduced<'py>> {
        let given = fields!(py, self; parameters, errors, correlation, a_minus_b, aic, interrupted, warnings, records, text);
        reduced::<Self>(py, given)
    }

    fn _repr_html_(&self, py: Python<'_>) -> PyResult<String> {
        let table = fields!(py, self; parameters, errors, warnings);
        // The largest residuals of a record.
        let rms = self.records.iter().map(|record| record.get().rms);
        table.set_item("rms", rms.fold(0.0, f64::max))?;
        helper(py, "_plain", "fit", (table,))?.extract()
    }

    fn __str__(&self) -> &str {
        &self.text
    }

    fn __repr__(&self, py: Python<'_>) -> PyResult<String> {
        let parameters = self.parameters.bind(py).cast::<PyDict>()?.iter();
        let shared = parameters.map(|(name, value)| {
            let (name, value) = (name.extract::<String>()?, value.extract::<f64>()?);
            Ok((!name.contains('[')).then(|| format!("{name}={value:.6e}")))
        });
        let shared: PyResult<Vec<_>> = shared.collect();
        let shared: Vec<String> = shared?.into_iter().flatten().collect();
        let count = self.records.len();
        Ok(format!(
            "JointFitResult({count} records, {})",
            shared.join(", ")
        ))
    }
}

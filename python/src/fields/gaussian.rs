//! Sources of fluid spread as a Gaussian.

use numpy::PyArray1;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use stickslip::fields::GaussianSource as Source;

use super::Cells;
use super::position::Position;
use super::rates::Rates;
use crate::arguments::{Numbers, named, positive};
use crate::plain::{Reduced, html, reduced, text};

/// A source of fluid whose rate is spread around a point as a Gaussian. Cells take all of it: what would lie beyond them is
/// spread over them in proportion.
///
/// Args:
///     position: on a line [m], or a pair along strike and down dip on a plane.
///     deviation: standard deviation [m], > 0.
///     times, rates, interpolation: as of a Well.
#[pyclass(frozen, module = "stickslip")]
pub(crate) struct GaussianSource {
    #[pyo3(get)]
    position: Position,
    #[pyo3(get)]
    deviation: f64,
    rates: Rates,
}

#[pymethods]
impl GaussianSource {
    #[new]
    #[pyo3(signature = (position, deviation, times, rates, *, interpolation="constant".to_owned()),
           text_signature = "(position, deviation, times, rates, *, interpolation='constant')")]
    fn new(
        #[pyo3(from_py_with = named)] position: Position,
        #[pyo3(from_py_with = named)] deviation: f64,
        #[pyo3(from_py_with = named)] times: Numbers,
        #[pyo3(from_py_with = named)] rates: Numbers,
        #[pyo3(from_py_with = named)] interpolation: String,
    ) -> PyResult<Self> {
        Ok(Self {
            position: position.checked()?,
            deviation: positive("deviation", deviation)?,
            rates: Rates::new(times, rates, interpolation)?,
        })
    }

    /// Times of the rates [s].
    #[getter]
    fn times<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        PyArray1::from_slice(py, &self.rates.times)
    }

    /// Rates [m^3/s], on a line [m^2/s].
    #[getter]
    fn rates<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        PyArray1::from_slice(py, &self.rates.rates)
    }

    /// "constant" or "linear".
    #[getter]
    fn interpolation(&self) -> &str {
        &self.rates.interpolation
    }

    fn __repr__(&self, py: Python<'_>) -> PyResult<String> {
        text("GaussianSource", &self.given(py)?)
    }

    fn _repr_html_(&self, py: Python<'_>) -> PyResult<String> {
        html("GaussianSource", &self.given(py)?)
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Reduced<'py>> {
        reduced::<Self>(py, self.given(py)?)
    }
}

impl GaussianSource {
    /// The arguments.
    fn given<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let given = PyDict::new(py);
        given.set_item("position", self.position)?;
        given.set_item("deviation", self.deviation)?;
        given.set_item("times", self.times(py))?;
        given.set_item("rates", self.rates(py))?;
        given.set_item("interpolation", self.interpolation())?;
        Ok(given)
    }

    /// The source on the cells of a fault.
    pub(super) fn on(&self, name: &str, cells: &Cells) -> PyResult<Source> {
        let place = self.position.on(&format!("{name}.position"), cells)?;
        let rates = self.rates.history.clone();
        Ok(Source::new(place, self.deviation, rates))
    }
}

//! Wells.

use numpy::PyArray1;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use stickslip::fields::Well as FluidWell;

use super::Cells;
use super::position::Position;
use super::rates::Rates;
use crate::arguments::{Numbers, named, positive};
use crate::errors::argument;
use crate::plain::{Reduced, fields, html, reduced, text};

/// A well that injects at a point, or produces at negative rates. Without `storage` its rate enters the cell of the point;
/// with it the well has a bore of its own pressure, from which fluid flows to the cell.
///
/// Args:
///     position: on a line [m], or a pair along strike and down dip on a plane.
///     times: [s], in order; two equal ones are a jump.
///     rates: from each time on: volumes per time [m^3/s], on a line per length out of the plane [m^2/s]; 0 before the first
///         time, and constant after the last one.
///     interpolation: "constant", each rate holds up to the next time, or "linear" between them.
///     storage: of the bore [m^3/Pa], on a line [m^2/Pa], > 0; with radius or index.
///     radius: of the bore [m], > 0, on a plane.
///     index: of the well [m^3/(Pa s)], on a line [m^2/(Pa s)], > 0, in the place of the radius.
#[pyclass(frozen, module = "stickslip")]
pub(crate) struct Well {
    #[pyo3(get)]
    position: Position,
    rates: Rates,
    #[pyo3(get)]
    storage: Option<f64>,
    #[pyo3(get)]
    radius: Option<f64>,
    #[pyo3(get)]
    index: Option<f64>,
}

#[pymethods]
impl Well {
    #[new]
    #[pyo3(signature = (position, times, rates, *, interpolation="constant".to_owned(), storage=None, radius=None, index=None),
           text_signature = "(position, times, rates, *, interpolation='constant', storage=None, radius=None, index=None)")]
    fn new(
        #[pyo3(from_py_with = named)] position: Position,
        #[pyo3(from_py_with = named)] times: Numbers,
        #[pyo3(from_py_with = named)] rates: Numbers,
        #[pyo3(from_py_with = named)] interpolation: String,
        #[pyo3(from_py_with = named)] storage: Option<f64>,
        #[pyo3(from_py_with = named)] radius: Option<f64>,
        #[pyo3(from_py_with = named)] index: Option<f64>,
    ) -> PyResult<Self> {
        for (name, value) in [("storage", storage), ("radius", radius), ("index", index)] {
            value.map(|value| positive(name, value)).transpose()?;
        }
        match (storage, radius, index) {
            (None, None, None) | (Some(_), Some(_), None) | (Some(_), None, Some(_)) => {}
            (None, _, _) => {
                return Err(argument("storage", "given with radius or index", "None"));
            }
            (Some(_), None, None) => {
                return Err(argument("radius", "given with storage, or index", "None"));
            }
            (Some(_), Some(_), Some(index)) => {
                return Err(argument("index", "None where radius is given", index));
            }
        }
        Ok(Self {
            position: position.checked()?,
            rates: Rates::new(times, rates, interpolation)?,
            storage,
            radius,
            index,
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

    /// The volume injected between two times [s]: [m^3], on a line [m^2].
    fn volume(
        &self,
        #[pyo3(from_py_with = named)] begin: f64,
        #[pyo3(from_py_with = named)] end: f64,
    ) -> f64 {
        self.rates.history.volume([begin, end])
    }

    fn __repr__(&self, py: Python<'_>) -> PyResult<String> {
        text("Well", &self.given(py)?)
    }

    fn _repr_html_(&self, py: Python<'_>) -> PyResult<String> {
        html("Well", &self.given(py)?)
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Reduced<'py>> {
        reduced::<Self>(py, self.given(py)?)
    }
}

impl Well {
    /// The arguments.
    fn given<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let given = PyDict::new(py);
        given.set_item("position", self.position)?;
        given.set_item("times", self.times(py))?;
        given.set_item("rates", self.rates(py))?;
        given.set_item("interpolation", self.interpolation())?;
        given.update(fields!(py, self; storage, radius, index).as_mapping())?;
        Ok(given)
    }

    /// The well on the cells of a fault.
    pub(super) fn on(&self, name: &str, cells: &Cells) -> PyResult<FluidWell> {
        let place = self.position.on(&format!("{name}.position"), cells)?;
        let well = FluidWell::new(place, self.rates.history.clone());
        match (self.storage, self.radius, self.index) {
            (Some(_), Some(radius), _) if cells.is_line() => {
                let name = format!("{name}.radius");
                Err(argument(&name, "None on a line: give index", radius))
            }
            (Some(storage), Some(radius), _) => Ok(well.with_bore(storage, radius)),
            (Some(storage), None, Some(index)) => Ok(well.with_bore_of_index(storage, index)),
            _ => Ok(well),
        }
    }
}

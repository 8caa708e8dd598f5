//! Dilatancy.

use pyo3::prelude::*;
use pyo3::types::PyDict;
use stickslip::fields::Dilatancy as Pores;

use crate::arguments::{finite, named, non_negative, positive};
use crate::plain::{Reduced, fields, html, reduced, text};

/// Pores that open with the slip rate, which takes pressure from their fluid (Segall and Rice, 1995):
///
///     phi' = -(V/slip_distance) (phi - phi_0 - coefficient ln(V/reference_velocity)),    storage p' = .. - phi'
///
/// Runs have the reading "porosity_change", phi - phi_0.
///
/// Args:
///     coefficient: >= 0.
///     reference_velocity: slip rate of the porosity phi_0 [m/s], > 0.
///     slip_distance: over which porosity evolves [m], > 0.
///     initial_change: of porosity at time 0; coefficient ln(V/reference_velocity) is steady at V.
#[pyclass(frozen, get_all, module = "stickslip")]
pub(crate) struct Dilatancy {
    coefficient: f64,
    reference_velocity: f64,
    slip_distance: f64,
    initial_change: f64,
}

#[pymethods]
impl Dilatancy {
    #[new]
    #[pyo3(signature = (*, coefficient, reference_velocity, slip_distance, initial_change=0.0))]
    fn new(
        #[pyo3(from_py_with = named)] coefficient: f64,
        #[pyo3(from_py_with = named)] reference_velocity: f64,
        #[pyo3(from_py_with = named)] slip_distance: f64,
        #[pyo3(from_py_with = named)] initial_change: f64,
    ) -> PyResult<Self> {
        Ok(Self {
            coefficient: non_negative("coefficient", coefficient)?,
            reference_velocity: positive("reference_velocity", reference_velocity)?,
            slip_distance: positive("slip_distance", slip_distance)?,
            initial_change: finite("initial_change", initial_change)?,
        })
    }

    fn __repr__(&self, py: Python<'_>) -> PyResult<String> {
        text("Dilatancy", &self.given(py)?)
    }

    fn _repr_html_(&self, py: Python<'_>) -> PyResult<String> {
        html("Dilatancy", &self.given(py)?)
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Reduced<'py>> {
        reduced::<Self>(py, self.given(py)?)
    }
}

impl Dilatancy {
    /// The arguments.
    fn given<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        Ok(fields!(py, self; coefficient, reference_velocity, slip_distance, initial_change))
    }

    /// That of the library.
    pub(super) fn law(&self) -> Pores {
        Pores {
            coefficient: self.coefficient,
            reference_velocity: self.reference_velocity,
            slip_distance: self.slip_distance,
            initial_change: self.initial_change,
        }
    }
}

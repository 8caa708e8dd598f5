//! Leak-off into the rock beside a fault.

use pyo3::prelude::*;
use pyo3::types::PyDict;
use stickslip::fields::LeakOff as Leak;

use super::cell_values::{CellValues, FINITE, POSITIVE};
use crate::arguments::named;
use crate::faults::Layout;
use crate::plain::{Reduced, fields, html, reduced, text};

/// Leak-off of fluid into the rock beside a fault: p' = .. - (p - far_pressure)/drainage_time.
///
/// Args, numbers or arrays with one per cell:
///     drainage_time: [s], > 0.
///     far_pressure: change of the pore pressure of that rock [Pa].
#[pyclass(frozen, module = "stickslip")]
pub(crate) struct LeakOff {
    #[pyo3(get)]
    drainage_time: CellValues,
    #[pyo3(get)]
    far_pressure: CellValues,
}

#[pymethods]
impl LeakOff {
    #[new]
    #[pyo3(signature = (drainage_time, *, far_pressure=CellValues::from(0.0)),
           text_signature = "(drainage_time, *, far_pressure=0.0)")]
    fn new(
        #[pyo3(from_py_with = named)] drainage_time: CellValues,
        #[pyo3(from_py_with = named)] far_pressure: CellValues,
    ) -> PyResult<Self> {
        Ok(Self {
            drainage_time: drainage_time.within("drainage_time", &POSITIVE)?,
            far_pressure: far_pressure.within("far_pressure", &FINITE)?,
        })
    }

    fn __repr__(&self, py: Python<'_>) -> PyResult<String> {
        text("LeakOff", &self.given(py)?)
    }

    fn _repr_html_(&self, py: Python<'_>) -> PyResult<String> {
        html("LeakOff", &self.given(py)?)
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Reduced<'py>> {
        reduced::<Self>(py, self.given(py)?)
    }
}

impl LeakOff {
    /// The arguments.
    fn given<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        Ok(fields!(py, self; drainage_time, far_pressure))
    }

    /// The leak-off of cells.
    pub(super) fn on(&self, name: &str, cells: Layout) -> PyResult<Leak> {
        Ok(Leak {
            drainage_time: self
                .drainage_time
                .on(&format!("{name}.drainage_time"), cells)?,
            far_pressure: self
                .far_pressure
                .on(&format!("{name}.far_pressure"), cells)?,
        })
    }
}

//! Permeability that slip raises and time heals.

use pyo3::prelude::*;
use pyo3::types::PyDict;
use stickslip::fields::PermeabilityEvolution as Evolution;

use super::cell_values::{CellValues, NOT_NEGATIVE, POSITIVE, POSITIVE_OR_INFINITE};
use crate::arguments::named;
use crate::faults::Layout;
use crate::plain::{Reduced, fields, html, reduced, text};

/// Permeability that slip raises and time heals (Zhu et al., 2020), from that of the Diffusion on:
///
///     k' = -(V/slip_distance) (k - maximum) - (k - minimum)/healing_time
///
/// Args, numbers or arrays with one per cell:
///     minimum: permeability that healing tends to [m^2], >= 0.
///     maximum: permeability that slip tends to [m^2], at least the minimum.
///     slip_distance: over which it rises [m], > 0.
///     healing_time: over which it heals [s], > 0; infinite for none.
#[pyclass(frozen, module = "stickslip")]
pub(crate) struct PermeabilityEvolution {
    #[pyo3(get)]
    minimum: CellValues,
    #[pyo3(get)]
    maximum: CellValues,
    #[pyo3(get)]
    slip_distance: CellValues,
    #[pyo3(get)]
    healing_time: CellValues,
}

#[pymethods]
impl PermeabilityEvolution {
    #[new]
    #[pyo3(signature = (*, minimum, maximum, slip_distance, healing_time))]
    fn new(
        #[pyo3(from_py_with = named)] minimum: CellValues,
        #[pyo3(from_py_with = named)] maximum: CellValues,
        #[pyo3(from_py_with = named)] slip_distance: CellValues,
        #[pyo3(from_py_with = named)] healing_time: CellValues,
    ) -> PyResult<Self> {
        Ok(Self {
            minimum: minimum.within("minimum", &NOT_NEGATIVE)?,
            maximum: maximum.within("maximum", &NOT_NEGATIVE)?,
            slip_distance: slip_distance.within("slip_distance", &POSITIVE)?,
            healing_time: healing_time.within("healing_time", &POSITIVE_OR_INFINITE)?,
        })
    }

    fn __repr__(&self, py: Python<'_>) -> PyResult<String> {
        text("PermeabilityEvolution", &self.given(py)?)
    }

    fn _repr_html_(&self, py: Python<'_>) -> PyResult<String> {
        html("PermeabilityEvolution", &self.given(py)?)
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Reduced<'py>> {
        reduced::<Self>(py, self.given(py)?)
    }
}

impl PermeabilityEvolution {
    /// The arguments.
    fn given<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        Ok(fields!(py, self; minimum, maximum, slip_distance, healing_time))
    }

    /// The evolution of cells.
    pub(super) fn on(&self, name: &str, cells: Layout) -> PyResult<Evolution> {
        let of = |values: &CellValues, what: &str| values.on(&format!("{name}.{what}"), cells);
        Ok(Evolution {
            minimum: of(&self.minimum, "minimum")?,
            maximum: of(&self.maximum, "maximum")?,
            slip_distance: of(&self.slip_distance, "slip_distance")?,
            healing_time: of(&self.healing_time, "healing_time")?,
        })
    }
}

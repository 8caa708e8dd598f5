//! The heat of friction alone.

use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use stickslip::fields::{ShearHeating as Heating, ShearZone, ThermalError};

use super::Cells;
use super::cell_values::{CellValues, NOT_NEGATIVE, POSITIVE};
use crate::arguments::named;
use crate::errors::argument;
use crate::faults::Layout;
use crate::memory::check_memory;
use crate::plain::{Reduced, fields, html, reduced, text};

/// The largest number of modes.
const MODES: usize = 64;

/// The temperature of a shear zone that friction heats, without a pore fluid; friction does not see it:
///
///     T' = thermal_diffusivity T_zz + tau V g(z)/heat_capacity,  g(z) = exp(-z^2/(2 half_width^2))/(half_width sqrt(2 pi))
///
/// Runs have the reading "temperature" [K], that of its centre.
///
/// Args, numbers or arrays with one per cell:
///     half_width: standard deviation of the Gaussian [m], > 0.
///     heat_capacity: volumetric [J/(m^3 K)], > 0.
///     thermal_diffusivity: [m^2/s], >= 0.
///     initial_temperature: [K], > 0.
/// Further args:
///     modes: number of modes across the fault, from 2 to 64.
#[pyclass(frozen, module = "stickslip")]
pub(crate) struct ShearHeating {
    #[pyo3(get)]
    half_width: CellValues,
    #[pyo3(get)]
    heat_capacity: CellValues,
    #[pyo3(get)]
    thermal_diffusivity: CellValues,
    #[pyo3(get)]
    initial_temperature: CellValues,
    #[pyo3(get)]
    modes: usize,
}

#[pymethods]
impl ShearHeating {
    #[new]
    #[pyo3(signature = (*, half_width, heat_capacity, thermal_diffusivity, initial_temperature, modes=24))]
    fn new(
        #[pyo3(from_py_with = named)] half_width: CellValues,
        #[pyo3(from_py_with = named)] heat_capacity: CellValues,
        #[pyo3(from_py_with = named)] thermal_diffusivity: CellValues,
        #[pyo3(from_py_with = named)] initial_temperature: CellValues,
        #[pyo3(from_py_with = named)] modes: usize,
    ) -> PyResult<Self> {
        Ok(Self {
            half_width: half_width.within("half_width", &POSITIVE)?,
            heat_capacity: heat_capacity.within("heat_capacity", &POSITIVE)?,
            thermal_diffusivity: thermal_diffusivity
                .within("thermal_diffusivity", &NOT_NEGATIVE)?,
            initial_temperature: initial_temperature.within("initial_temperature", &POSITIVE)?,
            modes: number_of_modes(modes)?,
        })
    }

    fn __repr__(&self, py: Python<'_>) -> PyResult<String> {
        text("ShearHeating", &self.given(py)?)
    }

    fn _repr_html_(&self, py: Python<'_>) -> PyResult<String> {
        html("ShearHeating", &self.given(py)?)
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Reduced<'py>> {
        reduced::<Self>(py, self.given(py)?)
    }
}

impl ShearHeating {
    /// The arguments.
    fn given<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        Ok(
            fields!(py, self; half_width, heat_capacity, thermal_diffusivity, initial_temperature, modes),
        )
    }

    /// The field of a fault.
    pub(super) fn on(&self, name: &str, cells: &Cells) -> PyResult<Heating> {
        let Layout { count, .. } = cells.layout;
        check_memory(name, &[count, self.modes], MODE)?;
        let zone = zone(
            name,
            cells.layout,
            [
                &self.half_width,
                &self.heat_capacity,
                &self.thermal_diffusivity,
                &self.initial_temperature,
            ],
        )?;
        let field = Heating::new(count, zone).and_then(|field| field.with_modes(self.modes));
        field.map_err(refused(name))
    }
}

/// The memory of a mode in a step \[B\].
pub(super) const MODE: usize = 40;

/// A legal number of modes.
pub(super) fn number_of_modes(modes: usize) -> PyResult<usize> {
    if (2..=MODES).contains(&modes) {
        return Ok(modes);
    }
    Err(argument("modes", "from 2 to 64", modes))
}

/// The shear zone of cells, from its half width, heat capacity, thermal diffusivity and initial temperature.
pub(super) fn zone(
    name: &str,
    cells: Layout,
    [width, capacity, diffusivity, temperature]: [&CellValues; 4],
) -> PyResult<ShearZone> {
    let of = |values: &CellValues, what: &str| values.on(&format!("{name}.{what}"), cells);
    Ok(ShearZone {
        half_width: of(width, "half_width")?,
        volumetric_heat_capacity: of(capacity, "heat_capacity")?,
        thermal_diffusivity: of(diffusivity, "thermal_diffusivity")?,
        initial_temperature: of(temperature, "initial_temperature")?,
    })
}

/// The exception of what a field refuses.
pub(super) fn refused(name: &str) -> impl Fn(ThermalError) -> PyErr + '_ {
    move |error| PyValueError::new_err(format!("{name}: {error}"))
}

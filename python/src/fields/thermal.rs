//! Thermal pressurization.

use pyo3::prelude::*;
use pyo3::types::PyDict;
use stickslip::fields::{PoreFluid, ThermalPressurization as Pressurization};

use super::Cells;
use super::cell_values::{CellValues, NOT_NEGATIVE, POSITIVE};
use super::heating::{MODE, number_of_modes, refused, zone};
use crate::arguments::named;
use crate::memory::check_memory;
use crate::plain::{Reduced, fields, html, reduced, text};

/// Heat of friction in a shear zone, and the pore fluid that it pressurizes, across the fault:
///
///     T' = thermal_diffusivity T_zz + tau V g(z)/heat_capacity,   p' = hydraulic_diffusivity p_zz + pressurization_coefficient T'
///     g(z) = exp(-z^2/(2 half_width^2))/(half_width sqrt(2 pi))
///
/// Its pressure, that of the centre, lowers the normal stress; runs have the reading "temperature" [K].
///
/// Args, numbers or arrays with one per cell:
///     half_width: standard deviation of the Gaussian [m], > 0.
///     heat_capacity: volumetric [J/(m^3 K)], > 0.
///     thermal_diffusivity: [m^2/s], >= 0; 0 is adiabatic.
///     hydraulic_diffusivity: [m^2/s], >= 0; 0 is undrained.
///     pressurization_coefficient: [Pa/K], >= 0.
///     initial_temperature: [K], > 0.
/// Further args:
///     modes: number of modes across the fault for each of temperature and pressure, from 2 to 64.
#[pyclass(frozen, module = "stickslip")]
pub(crate) struct ThermalPressurization {
    #[pyo3(get)]
    half_width: CellValues,
    #[pyo3(get)]
    heat_capacity: CellValues,
    #[pyo3(get)]
    thermal_diffusivity: CellValues,
    #[pyo3(get)]
    hydraulic_diffusivity: CellValues,
    #[pyo3(get)]
    pressurization_coefficient: CellValues,
    #[pyo3(get)]
    initial_temperature: CellValues,
    #[pyo3(get)]
    modes: usize,
}

#[pymethods]
impl ThermalPressurization {
    #[new]
    #[pyo3(signature = (*, half_width, heat_capacity, thermal_diffusivity, hydraulic_diffusivity, pressurization_coefficient,
                        initial_temperature, modes=24))]
    fn new(
        #[pyo3(from_py_with = named)] half_width: CellValues,
        #[pyo3(from_py_with = named)] heat_capacity: CellValues,
        #[pyo3(from_py_with = named)] thermal_diffusivity: CellValues,
        #[pyo3(from_py_with = named)] hydraulic_diffusivity: CellValues,
        #[pyo3(from_py_with = named)] pressurization_coefficient: CellValues,
        #[pyo3(from_py_with = named)] initial_temperature: CellValues,
        #[pyo3(from_py_with = named)] modes: usize,
    ) -> PyResult<Self> {
        Ok(Self {
            half_width: half_width.within("half_width", &POSITIVE)?,
            heat_capacity: heat_capacity.within("heat_capacity", &POSITIVE)?,
            thermal_diffusivity: thermal_diffusivity
                .within("thermal_diffusivity", &NOT_NEGATIVE)?,
            hydraulic_diffusivity: hydraulic_diffusivity
                .within("hydraulic_diffusivity", &NOT_NEGATIVE)?,
            pressurization_coefficient: pressurization_coefficient
                .within("pressurization_coefficient", &NOT_NEGATIVE)?,
            initial_temperature: initial_temperature.within("initial_temperature", &POSITIVE)?,
            modes: number_of_modes(modes)?,
        })
    }

    fn __repr__(&self, py: Python<'_>) -> PyResult<String> {
        text("ThermalPressurization", &self.given(py)?)
    }

    fn _repr_html_(&self, py: Python<'_>) -> PyResult<String> {
        html("ThermalPressurization", &self.given(py)?)
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Reduced<'py>> {
        reduced::<Self>(py, self.given(py)?)
    }
}

impl ThermalPressurization {
    /// The arguments.
    fn given<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        Ok(
            fields!(py, self; half_width, heat_capacity, thermal_diffusivity, hydraulic_diffusivity,
                              pressurization_coefficient, initial_temperature, modes),
        )
    }

    /// The field of a fault.
    pub(super) fn on(&self, name: &str, cells: &Cells) -> PyResult<Pressurization> {
        let layout = cells.layout;
        check_memory(name, &[layout.count, self.modes, 2], MODE)?;
        let zone = zone(
            name,
            layout,
            [
                &self.half_width,
                &self.heat_capacity,
                &self.thermal_diffusivity,
                &self.initial_temperature,
            ],
        )?;
        let of = |values: &CellValues, what: &str| values.on(&format!("{name}.{what}"), layout);
        let fluid = PoreFluid {
            hydraulic_diffusivity: of(&self.hydraulic_diffusivity, "hydraulic_diffusivity")?,
            pressurization_coefficient: of(
                &self.pressurization_coefficient,
                "pressurization_coefficient",
            )?,
        };
        let field = Pressurization::new(layout.count, zone, fluid);
        let field = field.and_then(|field| field.with_modes(self.modes));
        field.map_err(refused(name))
    }
}

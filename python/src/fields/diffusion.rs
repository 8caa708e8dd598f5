//! Pore pressure that diffuses along a fault.

use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use stickslip::fields::{Diffusion as Fluid, DiffusionError, Hydraulics, PerVertex};

use super::cell_values::{CellValues, FINITE, NOT_NEGATIVE, POSITIVE};
use super::sides::Sides;
use super::{Cells, Dilatancy, GaussianSource, LeakOff, PermeabilityEvolution, Well};
use crate::arguments::named;
use crate::errors::argument;
use crate::plain::{Reduced, fields, html, reduced, text};

/// Pore pressure that diffuses along a fault zone, with wells, by finite volumes and TR-BDF2:
///
///     storage thickness p' = div(thickness permeability/viscosity grad p) + Q delta + q - thickness phi'
///                            - storage thickness (p - far_pressure)/drainage_time
///
/// The cells are those of the LineFault or PlaneFault that takes it, or of one plane of a FaultSystem; p is the change of pore pressure [Pa], 0 at time 0.
/// Runs have the readings "darcy_velocity" [m/s], on a plane "darcy_velocity_along_strike" and "darcy_velocity_down_dip",
/// "permeability" [m^2] and "porosity_change", and the totals "injected_volume", "stored_volume", "leaked_volume",
/// "drained_volume" and "pore_volume" [m^3], on a line [m^2].
///
/// Args, numbers or arrays with one per cell:
///     permeability: [m^2], >= 0; cells of permeability 0 are sealed.
///     viscosity: of the fluid [Pa s], > 0.
///     storage: porosity times the compressibility of fluid and pores [1/Pa], > 0.
///     thickness: of the zone that conducts [m], > 0.
///     initial_pressure: change of pore pressure at time 0 [Pa].
/// Further args:
///     wells: Wells.
///     sources: GaussianSources.
///     sides: a dictionary of conditions: "begin" and "end" of a line, also a periodic one, or of a plane along strike, "top" and
///         "bottom" down dip. A condition is "sealed", as sides are by default, ("pressure", [Pa]) or ("flux", into the fault
///         [m/s]).
///     leak_off: LeakOff into the rock beside the fault.
///     dilatancy: Dilatancy, pores that open with the slip rate.
///     permeability_evolution: PermeabilityEvolution, which slip raises and time heals.
///     fourth_order: whether flow is of fourth order in the size of cells, for smooth pressures on a plane.
///     plane: the number of the plane of a FaultSystem that it follows: values per cell and positions are those of this plane,
///         readings are nan on others.
#[pyclass(frozen, module = "stickslip")]
pub(crate) struct Diffusion {
    #[pyo3(get)]
    permeability: CellValues,
    #[pyo3(get)]
    viscosity: CellValues,
    #[pyo3(get)]
    storage: CellValues,
    #[pyo3(get)]
    thickness: CellValues,
    #[pyo3(get)]
    initial_pressure: CellValues,
    #[pyo3(get)]
    wells: Vec<Py<Well>>,
    #[pyo3(get)]
    sources: Vec<Py<GaussianSource>>,
    #[pyo3(get)]
    sides: Sides,
    #[pyo3(get)]
    leak_off: Option<Py<LeakOff>>,
    #[pyo3(get)]
    dilatancy: Option<Py<Dilatancy>>,
    #[pyo3(get)]
    permeability_evolution: Option<Py<PermeabilityEvolution>>,
    #[pyo3(get)]
    fourth_order: bool,
    #[pyo3(get)]
    plane: Option<usize>,
}

#[pymethods]
impl Diffusion {
    #[new]
    #[pyo3(signature = (*, permeability, viscosity, storage, thickness, initial_pressure=CellValues::from(0.0), wells=Vec::new(),
                        sources=Vec::new(), sides=Sides::default(), leak_off=None, dilatancy=None,
                        permeability_evolution=None, fourth_order=false, plane=None),
           text_signature = "(*, permeability, viscosity, storage, thickness, initial_pressure=0.0, wells=[], sources=[], sides={}, leak_off=None, dilatancy=None, permeability_evolution=None, fourth_order=False, plane=None)")]
    #[expect(clippy::too_many_arguments, reason = "keywords in Python")]
    fn new(
        #[pyo3(from_py_with = named)] permeability: CellValues,
        #[pyo3(from_py_with = named)] viscosity: CellValues,
        #[pyo3(from_py_with = named)] storage: CellValues,
        #[pyo3(from_py_with = named)] thickness: CellValues,
        #[pyo3(from_py_with = named)] initial_pressure: CellValues,
        #[pyo3(from_py_with = named)] wells: Vec<Py<Well>>,
        #[pyo3(from_py_with = named)] sources: Vec<Py<GaussianSource>>,
        #[pyo3(from_py_with = named)] sides: Sides,
        #[pyo3(from_py_with = named)] leak_off: Option<Py<LeakOff>>,
        #[pyo3(from_py_with = named)] dilatancy: Option<Py<Dilatancy>>,
        #[pyo3(from_py_with = named)] permeability_evolution: Option<Py<PermeabilityEvolution>>,
        #[pyo3(from_py_with = named)] fourth_order: bool,
        #[pyo3(from_py_with = named)] plane: Option<usize>,
    ) -> PyResult<Self> {
        Ok(Self {
            permeability: permeability.within("permeability", &NOT_NEGATIVE)?,
            viscosity: viscosity.within("viscosity", &POSITIVE)?,
            storage: storage.within("storage", &POSITIVE)?,
            thickness: thickness.within("thickness", &POSITIVE)?,
            initial_pressure: initial_pressure.within("initial_pressure", &FINITE)?,
            wells,
            sources,
            sides,
            leak_off,
            dilatancy,
            permeability_evolution,
            fourth_order,
            plane,
        })
    }

    fn __repr__(&self, py: Python<'_>) -> PyResult<String> {
        text("Diffusion", &self.given(py)?)
    }

    fn _repr_html_(&self, py: Python<'_>) -> PyResult<String> {
        html("Diffusion", &self.given(py)?)
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Reduced<'py>> {
        reduced::<Self>(py, self.given(py)?)
    }
}

impl Diffusion {
    /// The arguments.
    fn given<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        Ok(
            fields!(py, self; permeability, viscosity, storage, thickness, initial_pressure, wells, sources, sides,
                              leak_off, dilatancy, permeability_evolution, fourth_order, plane),
        )
    }

    /// The number of the plane that it follows.
    pub(super) fn plane(&self) -> Option<usize> {
        self.plane
    }

    /// The field of a fault.
    pub(super) fn on(&self, name: &str, cells: &Cells) -> PyResult<Fluid> {
        let layout = cells.layout;
        let of = |values: &CellValues, what: &str| -> PyResult<PerVertex> {
            values.on(&format!("{name}.{what}"), layout)
        };
        let fluid_cells = cells.for_fluid(name)?;
        let hydraulics = Hydraulics {
            permeability: of(&self.permeability, "permeability")?,
            viscosity: of(&self.viscosity, "viscosity")?,
            storage: of(&self.storage, "storage")?,
            thickness: of(&self.thickness, "thickness")?,
        };
        let pressure = of(&self.initial_pressure, "initial_pressure")?;
        let field = Fluid::new(fluid_cells, &hydraulics)
            .and_then(|field| field.with_initial_pressure(pressure));
        let mut field = field.map_err(refused(name))?;
        if self.fourth_order {
            if cells.is_line() {
                let name = format!("{name}.fourth_order");
                return Err(argument(&name, "False on a line", true));
            }
            field = field.with_fourth_order().map_err(refused(name))?;
        }
        // Slip can open cells to wells.
        if let Some(evolution) = &self.permeability_evolution {
            let name = format!("{name}.permeability_evolution");
            let evolution = evolution.get().on(&name, layout)?;
            field = field
                .with_permeability_evolution(&evolution)
                .map_err(refused(&name))?;
        }
        if let Some(leak_off) = &self.leak_off {
            let name = format!("{name}.leak_off");
            let leak_off = leak_off.get().on(&name, layout)?;
            field = field.with_leak_off(&leak_off).map_err(refused(&name))?;
        }
        if let Some(dilatancy) = &self.dilatancy {
            let dilatancy = dilatancy.get().law();
            field = field.with_dilatancy(dilatancy).map_err(refused(name))?;
        }
        for (side, boundary) in self.sides.on(name, cells)? {
            field = field.with_side(side, boundary).map_err(refused(name))?;
        }
        self.fed(name, cells, field)
    }

    /// The field with its wells and sources.
    fn fed(&self, name: &str, cells: &Cells, mut field: Fluid) -> PyResult<Fluid> {
        for (n, well) in self.wells.iter().enumerate() {
            let name = format!("{name}.wells[{n}]");
            let well = well.get().on(&name, cells)?;
            field = field.with_well(well).map_err(refused(&name))?;
        }
        for (n, source) in self.sources.iter().enumerate() {
            let name = format!("{name}.sources[{n}]");
            let source = source.get().on(&name, cells)?;
            field = field.with_gaussian_source(source).map_err(refused(&name))?;
        }
        Ok(field)
    }
}

/// The exception of what diffusion refuses.
pub(super) fn refused(name: &str) -> impl Fn(DiffusionError) -> PyErr + '_ {
    move |error| PyValueError::new_err(format!("{name}: {error}"))
}

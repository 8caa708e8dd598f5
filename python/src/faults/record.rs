//! The record of a fault: arrays over time and cells.
#![expect(non_snake_case, reason = "names of the field")]

use numpy::{IntoPyArray, PyArray1, PyArray2, PyArray3, PyArrayDyn, PyArrayMethods};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use stickslip::record::Event;

use super::events::table;
use super::receivers::Receivers;
use super::samples::Record;
use crate::plain::{Reduced, fields, helper, ranges, reduced};

/// The history of a fault: samples by row, cells by column, the initial values first. Slip rates, slip and shear stresses
/// of a plane with a free rake have a last axis with the components along strike and up dip.
#[pyclass(frozen, get_all, module = "stickslip")]
pub(crate) struct FaultRun {
    /// Times of the samples [s].
    t: Py<PyArray1<f64>>,
    /// Slip rates [m/s].
    V: Py<PyArrayDyn<f64>>,
    /// Slip [m].
    slip: Py<PyArrayDyn<f64>>,
    /// States [s].
    theta: Py<PyArray2<f64>>,
    /// Shear stresses [Pa].
    shear_stress: Py<PyArrayDyn<f64>>,
    /// Normal stresses [Pa], with fields the total ones.
    normal_stress: Py<PyArray2<f64>>,
    /// Pore pressures of the fields [Pa]; 0 without any.
    pore_pressure: Py<PyArray2<f64>>,
    /// Normal stresses that friction sees [Pa], less the pore pressure.
    effective_normal_stress: Py<PyArray2<f64>>,
    /// Arrays of what fields show per cell, by name, such as "temperature" [K] or "darcy_velocity" [m/s].
    readings: Py<PyDict>,
    /// Arrays over time of what fields show as a whole, by name, such as "injected_volume"; those of one name are added.
    totals: Py<PyDict>,
    /// Displacement of the receivers of the run [m], by samples, receivers and axes.
    receiver_displacement: Py<PyArray3<f64>>,
    /// Their velocity [m/s].
    receiver_velocity: Py<PyArray3<f64>>,
    /// Events, a structured array with `to_frame()`: onset, arrest [s], origin, hypocentre [m], peak_slip_rate [m/s], cells,
    /// area, mean_slip, largest_slip [m], moment, stress_drop, pressure_change [Pa]. One under way at the end has nan as its
    /// arrest.
    events: Py<PyAny>,
    /// The number of accepted steps.
    steps: usize,
}

impl FaultRun {
    pub(super) fn of(
        py: Python<'_>,
        record: Record<'_>,
        events: &[Event],
        steps: usize,
    ) -> PyResult<Self> {
        let (samples, cells) = (record.times.len(), record.cells);
        let shape = match record.components {
            1 => vec![samples, cells],
            components => vec![samples, cells, components],
        };
        let [V, slip, shear_stress] = record.vectors.map(|field| {
            let array = field.into_pyarray(py).reshape(shape.clone());
            array.map(Bound::unbind)
        });
        let per_cell = |field: Vec<f64>| {
            let array = field.into_pyarray(py).reshape([samples, cells]);
            array.map(Bound::unbind)
        };
        let [theta, normal_stress] = record.scalars.map(per_cell);
        let normal_stress = normal_stress?;
        let [pore_pressure, effective_normal_stress] = match record.pressures {
            Some(pressures) => pressures.map(per_cell),
            None => [
                Ok(PyArray2::zeros(py, [samples, cells], false).unbind()),
                Ok(normal_stress.clone_ref(py)),
            ],
        };
        let (readings, totals) = (PyDict::new(py), PyDict::new(py));
        for (name, values) in record.readings {
            readings.set_item(name, per_cell(values)?)?;
        }
        for (name, values) in record.totals {
            totals.set_item(name, values.into_pyarray(py))?;
        }
        let receivers = record.receivers.map_or(0, Receivers::count);
        let [receiver_displacement, receiver_velocity] = record.moved.map(|moved| {
            let array = moved.into_pyarray(py).reshape([samples, receivers, 3]);
            array.map(Bound::unbind)
        });
        Ok(Self {
            t: record.times.into_pyarray(py).unbind(),
            V: V?,
            slip: slip?,
            theta: theta?,
            shear_stress: shear_stress?,
            normal_stress,
            pore_pressure: pore_pressure?,
            effective_normal_stress: effective_normal_stress?,
            readings: readings.unbind(),
            totals: totals.unbind(),
            receiver_displacement: receiver_displacement?,
            receiver_velocity: receiver_velocity?,
            events: table(py, events)?.unbind(),
            steps,
        })
    }

    fn fields<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        Ok(
            fields!(py, self; t, V, slip, theta, shear_stress, normal_stress, pore_pressure, effective_normal_stress, readings, totals, receiver_displacement, receiver_velocity, events, steps),
        )
    }
}

#[pymethods]
impl FaultRun {
    #[new]
    #[pyo3(signature = (*, t, V, slip, theta, shear_stress, normal_stress, pore_pressure, effective_normal_stress, readings, totals, receiver_displacement, receiver_velocity, events, steps))]
    #[expect(clippy::too_many_arguments, reason = "keywords in Python")]
    fn new(
        t: Py<PyArray1<f64>>,
        V: Py<PyArrayDyn<f64>>,
        slip: Py<PyArrayDyn<f64>>,
        theta: Py<PyArray2<f64>>,
        shear_stress: Py<PyArrayDyn<f64>>,
        normal_stress: Py<PyArray2<f64>>,
        pore_pressure: Py<PyArray2<f64>>,
        effective_normal_stress: Py<PyArray2<f64>>,
        readings: Py<PyDict>,
        totals: Py<PyDict>,
        receiver_displacement: Py<PyArray3<f64>>,
        receiver_velocity: Py<PyArray3<f64>>,
        events: Py<PyAny>,
        steps: usize,
    ) -> Self {
        Self {
            t,
            V,
            slip,
            theta,
            shear_stress,
            normal_stress,
            pore_pressure,
            effective_normal_stress,
            readings,
            totals,
            receiver_displacement,
            receiver_velocity,
            events,
            steps,
        }
    }

    /// A table of pandas with a row per sample and cell: t, cell, V, slip, theta, shear_stress, normal_stress; with
    /// fields pore_pressure, effective_normal_stress and their readings. With a free rake components end in _strike and _dip.
    ///
    /// Args:
    ///     cells: the numbers of some cells, or of one; by default all.
    #[pyo3(signature = (cells=None))]
    fn to_frame<'py>(
        &self,
        py: Python<'py>,
        cells: Option<Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        helper(py, "_frames", "cells", (self.fields(py)?, cells))
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Reduced<'py>> {
        reduced::<Self>(py, self.fields(py)?)
    }

    fn _repr_html_(&self, py: Python<'_>) -> PyResult<String> {
        ranges(&self.__repr__(py)?, &self.fields(py)?)
    }

    fn __len__(&self, py: Python<'_>) -> PyResult<usize> {
        self.t.bind(py).as_any().len()
    }

    fn __repr__(&self, py: Python<'_>) -> PyResult<String> {
        let events = self.events.bind(py).len()?;
        let samples = self.__len__(py)?;
        Ok(format!(
            "FaultRun({samples} samples, {} steps, {events} events)",
            self.steps
        ))
    }
}

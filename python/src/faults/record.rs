//! The record of a fault: arrays over time and cells.
#![expect(non_snake_case, reason = "names of the field")]

use numpy::{IntoPyArray, PyArray1, PyArray2, PyArrayDyn, PyArrayMethods};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use stickslip::Snapshot;
use stickslip::record::Event;

use super::events::table;
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
    /// Normal stresses [Pa].
    normal_stress: Py<PyArray2<f64>>,
    /// Events, a structured array with `to_frame()`: onset, arrest [s], origin, hypocentre [m], peak_slip_rate [m/s], cells,
    /// area, mean_slip, largest_slip [m], moment, stress_drop [Pa]. One under way at the end has nan as its arrest.
    events: Py<PyAny>,
    /// The number of accepted steps.
    steps: usize,
}

/// Samples of a run of a fault with so many cells.
pub(super) struct Record {
    cells: usize,
    times: Vec<f64>,
    /// V, slip and shear stress, of as many components as slip.
    vectors: [Vec<f64>; 3],
    /// theta and normal stress.
    scalars: [Vec<f64>; 2],
    components: usize,
}

impl Record {
    /// No samples yet of a fault.
    pub(super) fn of<const C: usize>(fault: &Snapshot<'_, C>) -> Self {
        Self {
            cells: fault.contact(0).len(),
            times: Vec::new(),
            vectors: Default::default(),
            scalars: Default::default(),
            components: C,
        }
    }

    /// Sets the times of the samples to those asked for, which clocks meet to rounding.
    pub(super) fn at(&mut self, times: &[f64]) {
        let count = self.times.len();
        self.times.copy_from_slice(&times[..count]);
    }

    /// Appends a sample.
    pub(super) fn add<const C: usize>(&mut self, at: &Snapshot<'_, C>) {
        self.times.push(at.time);
        let contact = at.contact(0);
        let [v, slip, shear] = &mut self.vectors;
        let [theta, normal] = &mut self.scalars;
        for k in 0..contact.len() {
            v.extend(&at.velocity[k]);
            slip.extend(&at.displacement[k]);
            shear.extend(&contact.traction(k));
            theta.push(contact.state(k).exp());
            normal.push(contact.normal_stress(k));
        }
    }
}

impl FaultRun {
    pub(super) fn of(
        py: Python<'_>,
        record: Record,
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
        let [theta, normal_stress] = record.scalars.map(|field| {
            let array = field.into_pyarray(py).reshape([samples, cells]);
            array.map(Bound::unbind)
        });
        Ok(Self {
            t: record.times.into_pyarray(py).unbind(),
            V: V?,
            slip: slip?,
            theta: theta?,
            shear_stress: shear_stress?,
            normal_stress: normal_stress?,
            events: table(py, events)?.unbind(),
            steps,
        })
    }

    fn fields<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        Ok(fields!(py, self; t, V, slip, theta, shear_stress, normal_stress, events, steps))
    }
}

#[pymethods]
impl FaultRun {
    #[new]
    #[pyo3(signature = (*, t, V, slip, theta, shear_stress, normal_stress, events, steps))]
    #[expect(clippy::too_many_arguments, reason = "keywords in Python")]
    fn new(
        t: Py<PyArray1<f64>>,
        V: Py<PyArrayDyn<f64>>,
        slip: Py<PyArrayDyn<f64>>,
        theta: Py<PyArray2<f64>>,
        shear_stress: Py<PyArrayDyn<f64>>,
        normal_stress: Py<PyArray2<f64>>,
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
            events,
            steps,
        }
    }

    /// A table of pandas with a row per sample and cell: t, cell, V, slip, theta, shear_stress, normal_stress; with a free
    /// rake the components end in _strike and _dip.
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

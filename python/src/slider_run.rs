//! The history of a block on a spring.
#![expect(non_snake_case, reason = "names of the field")]

use numpy::{IntoPyArray, PyArray1, PyArrayMethods};
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict};
use stickslip::Snapshot;
use stickslip::state::LogTheta;

use crate::laws::Evolution;
use crate::plain::{Reduced, fields, helper, ranges, reduced};

/// The history of a spring slider: arrays with one entry per accepted step, the initial values first, or per time that was
/// asked for.
#[pyclass(frozen, get_all, module = "stickslip")]
pub(crate) struct SliderRun {
    /// Time [s].
    t: Py<PyArray1<f64>>,
    /// Slip rate [m/s].
    V: Py<PyArray1<f64>>,
    /// State [s].
    theta: Py<PyArray1<f64>>,
    /// Coefficient of friction, positive in any direction of slip.
    mu: Py<PyArray1<f64>>,
    /// Slip since time 0 [m].
    slip: Py<PyArray1<f64>>,
    /// Shear stress [Pa], of the sign of the slip rate; without damping and mass that of the spring.
    shear_stress: Py<PyArray1<f64>>,
    /// Pore pressure of the fields [Pa]; 0 without any.
    pore_pressure: Py<PyArray1<f64>>,
    /// Normal stress that friction sees [Pa], less the pore pressure.
    effective_normal_stress: Py<PyArray1<f64>>,
    /// Arrays of what fields show, by name, such as "temperature" [K].
    readings: Py<PyDict>,
    /// The number of steps that were rejected.
    rejected: usize,
    /// The end of the run, from which another one goes on; it can be pickled.
    state: Py<PyBytes>,
}

#[pymethods]
impl SliderRun {
    #[new]
    #[pyo3(signature = (*, t, V, theta, mu, slip, shear_stress, pore_pressure, effective_normal_stress, readings, rejected, state))]
    #[expect(clippy::too_many_arguments, reason = "keywords in Python")]
    fn new(
        t: Py<PyArray1<f64>>,
        V: Py<PyArray1<f64>>,
        theta: Py<PyArray1<f64>>,
        mu: Py<PyArray1<f64>>,
        slip: Py<PyArray1<f64>>,
        shear_stress: Py<PyArray1<f64>>,
        pore_pressure: Py<PyArray1<f64>>,
        effective_normal_stress: Py<PyArray1<f64>>,
        readings: Py<PyDict>,
        rejected: usize,
        state: Py<PyBytes>,
    ) -> Self {
        Self {
            t,
            V,
            theta,
            mu,
            slip,
            shear_stress,
            pore_pressure,
            effective_normal_stress,
            readings,
            rejected,
            state,
        }
    }

    fn __len__(&self, py: Python<'_>) -> PyResult<usize> {
        self.t.bind(py).as_any().len()
    }

    /// A table of pandas with a row per sample; with fields it has their pressures and readings, too.
    fn to_frame<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let columns = fields!(py, self; t, V, theta, mu, slip, shear_stress);
        let readings = self.readings.bind(py);
        if !readings.is_empty() {
            let pressures = fields!(py, self; pore_pressure, effective_normal_stress);
            columns.update(pressures.as_mapping())?;
            columns.update(readings.as_mapping())?;
        }
        helper(py, "_frames", "columns", (columns,))
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Reduced<'py>> {
        reduced::<Self>(py, self.fields(py)?)
    }

    fn _repr_html_(&self, py: Python<'_>) -> PyResult<String> {
        ranges(&self.__repr__(py)?, &self.fields(py)?)
    }

    fn __repr__(&self, py: Python<'_>) -> PyResult<String> {
        let (length, t) = (self.__len__(py)?, self.t.bind(py).readonly());
        let end = t.as_slice()?.last().copied().unwrap_or(0.0);
        Ok(format!("SliderRun({length} samples, until={end})"))
    }
}

/// Samples of a run.
pub(crate) struct Samples {
    origin: f64,
    /// t, V, theta, mu, slip, shear stress, pore pressure, effective normal stress.
    columns: [Vec<f64>; 8],
    /// The readings of fields, by name.
    readings: Vec<(&'static str, Vec<f64>)>,
}

impl Samples {
    /// No samples yet, of a block that was at `origin` [m] at time 0.
    pub(crate) fn new(origin: f64, block: &Snapshot<'_, 1>) -> Self {
        let mut readings: Vec<(&str, Vec<f64>)> = Vec::new();
        for reading in block.contact(0).readings() {
            if readings.iter().all(|(name, _)| *name != reading.name) {
                readings.push((reading.name, Vec::new()));
            }
        }
        Self {
            origin,
            columns: Default::default(),
            readings,
        }
    }

    /// Sets the times of the samples to those asked for, which clocks meet to rounding.
    pub(crate) fn at(&mut self, times: &[f64]) {
        let [own, ..] = &mut self.columns;
        let count = own.len();
        own.copy_from_slice(&times[..count]);
    }

    /// Appends a sample.
    pub(crate) fn add(&mut self, at: &Snapshot<'_, 1>, law: &Evolution) {
        let contact = at.contact(0);
        let state = LogTheta(contact.state(0));
        let row = [
            at.time,
            at.velocity[0][0],
            law.ln_theta(state, contact.slip_rate(0)).exp(),
            contact.coefficient(0),
            at.displacement[0][0] - self.origin,
            contact.traction(0)[0],
            contact.pore_pressure(0),
            contact.effective_normal_stress(0),
        ];
        for (column, value) in self.columns.iter_mut().zip(row) {
            column.push(value);
        }
        for (name, values) in &mut self.readings {
            values.extend(contact.reading(name).unwrap_or_default());
        }
    }
}

impl SliderRun {
    /// The arrays of samples.
    pub(crate) fn of(
        py: Python<'_>,
        samples: Samples,
        rejected: usize,
        state: Bound<'_, PyBytes>,
    ) -> PyResult<Self> {
        let readings = PyDict::new(py);
        for (name, values) in samples.readings {
            readings.set_item(name, values.into_pyarray(py))?;
        }
        let [
            t,
            V,
            theta,
            mu,
            slip,
            shear_stress,
            pore_pressure,
            effective_normal_stress,
        ] = samples
            .columns
            .map(|column| column.into_pyarray(py).unbind());
        Ok(Self {
            t,
            V,
            theta,
            mu,
            slip,
            shear_stress,
            pore_pressure,
            effective_normal_stress,
            readings: readings.unbind(),
            rejected,
            state: state.unbind(),
        })
    }

    fn fields<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        Ok(
            fields!(py, self; t, V, theta, mu, slip, shear_stress, pore_pressure, effective_normal_stress, readings,
                              rejected, state),
        )
    }
}

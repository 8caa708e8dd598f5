//! The history of a block on a spring.
#![expect(non_snake_case, reason = "names of the field")]

use numpy::{IntoPyArray, PyArray1, PyArrayMethods};
use pyo3::prelude::*;
use stickslip::Snapshot;

/// The history of a spring slider: arrays with one entry per accepted step, the initial values first.
#[pyclass(frozen, get_all, module = "stickslip")]
pub(crate) struct SliderRun {
    /// Time [s].
    t: Py<PyArray1<f64>>,
    /// Slip rate [m/s].
    V: Py<PyArray1<f64>>,
    /// State [s].
    theta: Py<PyArray1<f64>>,
    /// Coefficient of friction.
    mu: Py<PyArray1<f64>>,
    /// Slip since time 0 [m].
    slip: Py<PyArray1<f64>>,
    /// The number of steps that were rejected.
    rejected: usize,
}

#[pymethods]
impl SliderRun {
    fn __len__(&self, py: Python<'_>) -> PyResult<usize> {
        self.t.bind(py).as_any().len()
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
    /// t, V, theta, mu, slip.
    columns: [Vec<f64>; 5],
}

impl Samples {
    /// The sample at the beginning.
    pub(crate) fn of(at: &Snapshot<'_, 1>) -> Self {
        let mut samples = Self {
            origin: at.displacement[0][0],
            columns: Default::default(),
        };
        samples.add(at);
        samples
    }

    /// Appends a sample.
    pub(crate) fn add(&mut self, at: &Snapshot<'_, 1>) {
        let contact = at.contact(0);
        let row = [
            at.time,
            at.velocity[0][0],
            contact.state(0).exp(),
            contact.coefficient(0),
            at.displacement[0][0] - self.origin,
        ];
        for (column, value) in self.columns.iter_mut().zip(row) {
            column.push(value);
        }
    }
}

impl SliderRun {
    /// The arrays of samples.
    pub(crate) fn new(py: Python<'_>, samples: Samples, rejected: usize) -> Self {
        let [t, V, theta, mu, slip] = samples
            .columns
            .map(|column| column.into_pyarray(py).unbind());
        Self {
            t,
            V,
            theta,
            mu,
            slip,
            rejected,
        }
    }
}

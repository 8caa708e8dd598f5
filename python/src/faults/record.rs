//! The record of a fault: arrays over time and cells.
#![expect(non_snake_case, reason = "names of the field")]

use numpy::{IntoPyArray, PyArray1, PyArray2, PyArrayMethods};
use pyo3::prelude::*;
use stickslip::Snapshot;
use stickslip::record::Event;

use super::events::table;

/// The history of a fault: samples by row, cells by column, the initial values first.
#[pyclass(frozen, get_all, module = "stickslip")]
pub(crate) struct FaultRun {
    /// Times of the samples [s].
    t: Py<PyArray1<f64>>,
    /// Slip rates [m/s].
    V: Py<PyArray2<f64>>,
    /// Slip [m].
    slip: Py<PyArray2<f64>>,
    /// States [s].
    theta: Py<PyArray2<f64>>,
    /// Shear stresses [Pa].
    shear_stress: Py<PyArray2<f64>>,
    /// Normal stresses [Pa].
    normal_stress: Py<PyArray2<f64>>,
    /// Events, a structured array: onset, arrest [s], origin, hypocentre [m], peak_slip_rate [m/s], cells, area,
    /// mean_slip, largest_slip [m], moment, stress_drop [Pa].
    events: Py<PyAny>,
    /// The number of accepted steps.
    steps: usize,
}

/// Samples of a run.
pub(super) struct Record {
    times: Vec<f64>,
    /// V, slip, theta, shear and normal stress.
    fields: [Vec<f64>; 5],
}

impl Record {
    /// The sample at the beginning.
    pub(super) fn new(at: &Snapshot<'_, 1>) -> Self {
        let mut record = Self {
            times: Vec::new(),
            fields: Default::default(),
        };
        record.add(at);
        record
    }

    /// Appends a sample.
    pub(super) fn add(&mut self, at: &Snapshot<'_, 1>) {
        self.times.push(at.time);
        let contact = at.contact(0);
        let [v, slip, theta, shear, normal] = &mut self.fields;
        for k in 0..contact.len() {
            v.push(at.velocity[k][0]);
            slip.push(at.displacement[k][0]);
            theta.push(contact.state(k).exp());
            shear.push(contact.traction(k)[0]);
            normal.push(contact.normal_stress(k));
        }
    }
}

impl FaultRun {
    pub(super) fn new(
        py: Python<'_>,
        record: Record,
        events: &[Event],
        steps: usize,
    ) -> PyResult<Self> {
        let samples = record.times.len();
        let [V, slip, theta, shear_stress, normal_stress] = record.fields.map(|field| {
            let columns = field.len() / samples;
            field
                .into_pyarray(py)
                .reshape([samples, columns])
                .map(Bound::unbind)
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
}

#[pymethods]
impl FaultRun {
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

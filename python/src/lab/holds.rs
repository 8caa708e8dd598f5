//! The healing rate of holds.

use numpy::PyArray1;
use pyo3::prelude::*;
use stickslip::lab::{Healing as Read, Record};

use super::given::history;
use super::names::refused;
use crate::plain::{Reduced, fields, helper, ranges, reduced};

/// The holds of a record: arrays with one entry per hold, and the healing rate.
#[pyclass(frozen, get_all, module = "stickslip")]
pub(crate) struct Healing {
    /// Durations of the holds [s].
    duration: Py<PyArray1<f64>>,
    /// Healing: the peak after a hold minus the level before it.
    healing: Py<PyArray1<f64>>,
    /// Relaxation: the level before a hold minus the coefficient at its end.
    relaxation: Py<PyArray1<f64>>,
    /// Healing per decade of duration; NaN for less than two durations.
    rate: f64,
    /// Its standard error; NaN for less than three holds.
    standard_error: f64,
}

#[pymethods]
impl Healing {
    #[new]
    #[pyo3(signature = (*, duration, healing, relaxation, rate, standard_error))]
    fn new(
        duration: Py<PyArray1<f64>>,
        healing: Py<PyArray1<f64>>,
        relaxation: Py<PyArray1<f64>>,
        rate: f64,
        standard_error: f64,
    ) -> Self {
        Self {
            duration,
            healing,
            relaxation,
            rate,
            standard_error,
        }
    }

    /// A table of pandas with a row per hold.
    fn to_frame<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let columns = fields!(py, self; duration, healing, relaxation);
        helper(py, "_frames", "columns", (columns,))
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Reduced<'py>> {
        let given = fields!(py, self; duration, healing, relaxation, rate, standard_error);
        reduced::<Self>(py, given)
    }

    fn _repr_html_(&self, py: Python<'_>) -> PyResult<String> {
        let arrays = fields!(py, self; duration, healing, relaxation);
        ranges(&self.__repr__(), &arrays)
    }

    fn __repr__(&self) -> String {
        format!(
            "Healing(rate={:.6}, standard_error={:.6})",
            self.rate, self.standard_error
        )
    }
}

/// Reads peaks and healing rate of a slide-hold-slide record, without a model.
///
/// Args:
///     t, mu, load, displacement, resolution, steps_at: as of fit.
#[pyfunction]
#[pyo3(signature = (t, mu, *, load=None, displacement=None, resolution=None, steps_at=None))]
pub(crate) fn healing(
    py: Python<'_>,
    t: Option<Vec<f64>>,
    mu: Vec<f64>,
    load: Option<Vec<(f64, f64)>>,
    displacement: Option<Vec<f64>>,
    resolution: Option<f64>,
    steps_at: Option<Vec<(f64, f64)>>,
) -> PyResult<Healing> {
    let (t, load) = history(py, t, (load, steps_at), (displacement, resolution))?;
    let record = refused(py, Record::new(t, mu))?;
    let read = refused(py, Read::of(&record, &load))?;
    let holds = &read.holds;
    let array = |value: &dyn Fn(&stickslip::lab::Hold) -> f64| {
        PyArray1::from_iter(py, holds.iter().map(value)).unbind()
    };
    Ok(Healing {
        duration: array(&|hold| hold.duration),
        healing: array(&|hold| hold.healing()),
        relaxation: array(&|hold| hold.relaxation()),
        rate: read.rate,
        standard_error: read.standard_error,
    })
}

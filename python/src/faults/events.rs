//! Events as a structured array.

use pyo3::prelude::*;
use pyo3::types::PyList;
use stickslip::record::Event;

use crate::plain::helper;

/// Names and types of the columns.
const COLUMNS: [(&str, &str); 12] = [
    ("onset", "f8"),
    ("arrest", "f8"),
    ("origin", "i8"),
    ("hypocentre", "3f8"),
    ("peak_slip_rate", "f8"),
    ("cells", "i8"),
    ("area", "f8"),
    ("mean_slip", "f8"),
    ("largest_slip", "f8"),
    ("moment", "f8"),
    ("stress_drop", "f8"),
    ("pressure_change", "f8"),
];

/// A structured array with one entry per event.
pub(super) fn table<'py>(py: Python<'py>, events: &[Event]) -> PyResult<Bound<'py, PyAny>> {
    let rows = events.iter().map(|event| {
        (
            event.onset,
            event.arrest,
            event.origin,
            (
                event.hypocentre[0],
                event.hypocentre[1],
                event.hypocentre[2],
            ),
            event.peak_slip_rate,
            event.vertices,
            event.area,
            event.mean_slip,
            event.largest_slip,
            event.moment,
            event.stress_drop,
            event.pressure_change,
        )
    });
    let rows = PyList::new(py, rows.collect::<Vec<_>>())?;
    helper(py, "_events", "table", (rows, COLUMNS.to_vec()))
}

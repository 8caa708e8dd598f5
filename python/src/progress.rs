//! The progress of a run, shown by Python.

use std::time::{Duration, Instant};

use pyo3::prelude::*;

use crate::exit::attached;

/// The time between two updates.
const PAUSE: Duration = Duration::from_millis(200);

/// A bar or a line of progress.
pub(crate) struct Progress {
    shown: Py<PyAny>,
    updated: Instant,
    /// The end of the last of several runs \[s\].
    goes_on: Option<f64>,
}

impl Progress {
    /// A bar from one time to another \[s\], if it is asked for.
    pub(crate) fn new(
        py: Python<'_>,
        asked: bool,
        [begin, end]: [f64; 2],
    ) -> PyResult<Option<Self>> {
        if !asked {
            return Ok(None);
        }
        let class = py.import("stickslip._progress")?.getattr("Progress")?;
        Ok(Some(Self {
            shown: class.call1((begin, end))?.unbind(),
            updated: Instant::now(),
            goes_on: None,
        }))
    }

    /// Shows a time \[s\], not too often.
    pub(crate) fn update(&mut self, time: f64) -> PyResult<()> {
        if self.updated.elapsed() < PAUSE {
            return Ok(());
        }
        self.updated = Instant::now();
        attached(|py| {
            self.shown
                .bind(py)
                .call_method1("update", (time,))
                .map(drop)
        })
    }

    /// Shows the end of a run at a time \[s\], after which another one may go on.
    pub(crate) fn finish(&mut self, py: Python<'_>, time: f64) -> PyResult<()> {
        let ends = self.goes_on.is_none_or(|end| time >= end);
        if !ends {
            return Ok(());
        }
        self.shown.bind(py).call_method1("close", (time,)).map(drop)
    }

    /// The bar of several runs, the last of which ends at a time \[s\].
    pub(crate) fn until(mut self, end: f64) -> Self {
        self.goes_on = Some(end);
        self
    }
}

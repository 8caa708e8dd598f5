//! Functions of time in Python, with a value per cell.

use pyo3::prelude::*;

use crate::bodies::PerVertex;
use crate::errors::argument;
use crate::exit::attached;
use crate::raised::Raised;

/// A function of time \[s\] that returns a number or one per cell, and the slot of its exception.
pub(super) struct CellFunction {
    name: &'static str,
    function: Py<PyAny>,
    raised: Raised,
}

impl CellFunction {
    /// The argument of this name, if it is given.
    pub(super) fn given(
        py: Python<'_>,
        name: &'static str,
        function: Option<Py<PyAny>>,
        raised: &Raised,
    ) -> PyResult<Option<Self>> {
        let Some(function) = function else {
            return Ok(None);
        };
        if !function.bind(py).is_callable() {
            let given = function.bind(py).repr()?.to_string();
            return Err(argument(name, "a function of time", given));
        }
        Ok(Some(Self {
            name,
            function,
            raised: raised.clone(),
        }))
    }

    /// The values of so many cells; not a number where the function raises an exception, which is kept.
    pub(super) fn at(&self, time: f64, cells: usize) -> Vec<f64> {
        let values = attached(|py| {
            let value: PerVertex = self.function.bind(py).call1((time,))?.extract()?;
            let name = format!("the value of {}", self.name);
            value.checked(&name, cells, "finite", f64::is_finite)
        });
        values.unwrap_or_else(|error| {
            self.raised.keep(error);
            vec![f64::NAN; cells]
        })
    }
}

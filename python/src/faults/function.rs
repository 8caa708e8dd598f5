//! Functions of time in Python, with a value per cell.

use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use stickslip::nalgebra::SVector;

use super::per_cell::{Layout, PerCell};
use crate::errors::argument;
use crate::exit::attached;
use crate::raised::Raised;

/// A function of time \[s\] that returns a value or one per cell, and the slot of its exception.
pub(super) struct CellFunction {
    name: &'static str,
    function: Py<PyAny>,
    cells: Layout,
    raised: Raised,
}

impl CellFunction {
    /// The argument of this name, if it is given.
    pub(super) fn given(
        py: Python<'_>,
        name: &'static str,
        function: Option<Py<PyAny>>,
        cells: Layout,
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
            cells,
            raised: raised.clone(),
        }))
    }

    /// The values of all cells; not a number where the function raises an exception, which is kept.
    pub(super) fn at<const C: usize>(&self, time: f64) -> Vec<SVector<f64, C>> {
        let values = attached(|py| {
            let name = format!("the value of {}", self.name);
            let value = self.function.bind(py).call1((time,))?;
            let value = value.extract::<PerCell>();
            let value = value
                .map_err(|error| PyTypeError::new_err(format!("{name} {}", error.value(py))))?;
            value.checked(&name, self.cells)
        });
        values.unwrap_or_else(|error| {
            self.raised.keep(error);
            vec![SVector::repeat(f64::NAN); self.cells.count]
        })
    }
}

//! Functions of time in Python, with a value per cell.

use pyo3::prelude::*;
use stickslip::nalgebra::SVector;

use super::per_cell::PerCell;
use crate::errors::argument;
use crate::exit::attached;
use crate::raised::Raised;

/// A function of time \[s\] that returns a value or one per cell, and the slot of its exception.
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
    pub(super) fn at<const C: usize>(&self, time: f64, cells: usize) -> Vec<SVector<f64, C>> {
        let values = attached(|py| {
            let value: PerCell = self.function.bind(py).call1((time,))?.extract()?;
            let name = format!("the value of {}", self.name);
            value.checked(&name, cells)
        });
        values.unwrap_or_else(|error| {
            self.raised.keep(error);
            vec![SVector::repeat(f64::NAN); cells]
        })
    }
}

//! Functions of the user that watch a run.

use std::ops::ControlFlow;

use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;

/// Asks a callback, at a time \[s\] and the largest slip rate [m/s], whether the run ends: None or False go on.
pub(super) fn asked(callback: &Bound<'_, PyAny>, at: (f64, f64)) -> PyResult<ControlFlow<()>> {
    let answer = callback.call1(at)?;
    if answer.is_none() {
        return Ok(ControlFlow::Continue(()));
    }
    match answer.extract::<bool>() {
        Ok(true) => Ok(ControlFlow::Break(())),
        Ok(false) => Ok(ControlFlow::Continue(())),
        // A number or a list would end the run without a word.
        Err(_) => Err(PyTypeError::new_err(format!(
            "callback must return None or a bool: True ends the run; it returned {}",
            answer.repr()?
        ))),
    }
}

//! States from which a run goes on with the same bits: as bytes, and as files.

use std::path::Path;

use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use pyo3::types::PyBytes;
use stickslip::integrate::Stepper;
use stickslip::{Checkpoint, Snapshot, StepState};

use crate::errors::{self, Bare, argument};

/// All that later steps depend on, as bytes.
pub(crate) fn state_bytes<'py, const C: usize>(
    py: Python<'py>,
    at: &Snapshot<'_, C>,
) -> PyResult<Bound<'py, PyBytes>> {
    packed(py, at.state())
}

/// Contents as bytes.
pub(crate) fn packed<'py>(
    py: Python<'py>,
    contents: &impl serde::Serialize,
) -> PyResult<Bound<'py, PyBytes>> {
    let bytes = postcard::to_allocvec(contents);
    let bytes = bytes.map_err(|error| PyRuntimeError::new_err(error.to_string()))?;
    Ok(PyBytes::new(py, &bytes))
}

/// The contents of bytes, which are the argument of a name.
pub(crate) fn unpacked<T: serde::de::DeserializeOwned>(name: &str, bytes: &[u8]) -> PyResult<T> {
    match postcard::take_from_bytes(bytes) {
        Ok((contents, [])) => Ok(contents),
        _ => {
            let given = Bare(format!("{} other bytes", bytes.len()));
            Err(argument(
                name,
                "the bytes of a state of such a simulation",
                given,
            ))
        }
    }
}

/// Restores a state from bytes, which are the argument of a name.
pub(crate) fn restore<const C: usize>(
    py: Python<'_>,
    name: &str,
    stepper: &mut dyn Stepper<C>,
    bytes: &[u8],
) -> PyResult<()> {
    let state: StepState<C> = unpacked(name, bytes)?;
    let restored = stepper.restore(&state);
    restored.map_err(|error| errors::of_argument(py, name, errors::scene(py, &error)))
}

/// Writes a file with the state and records.
pub(crate) fn save<const C: usize>(
    py: Python<'_>,
    path: &Path,
    at: &Snapshot<'_, C>,
    records: &impl serde::Serialize,
) -> PyResult<()> {
    let saved = Checkpoint::at(path).save(at, records);
    saved.map_err(|error| errors::file(py, &error))
}

/// Restores the state of a file of the same scene, and returns the records.
pub(crate) fn load<T: serde::de::DeserializeOwned, const C: usize>(
    py: Python<'_>,
    path: &Path,
    stepper: &mut dyn Stepper<C>,
) -> PyResult<T> {
    let loaded = Checkpoint::at(path).restore(stepper);
    loaded.map_err(|error| errors::file(py, &error))
}

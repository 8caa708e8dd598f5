//! Exceptions of functions of the user, on their way through the library.

use std::sync::{Arc, Mutex};

use pyo3::prelude::*;

/// The first exception of the functions that a run calls: the value is then NaN, and the run ends with the exception.
#[derive(Clone, Default)]
pub(crate) struct Raised(Arc<Mutex<Option<PyErr>>>);

impl Raised {
    /// Keeps an exception, unless there is one.
    pub(crate) fn keep(&self, error: PyErr) {
        if let Ok(mut first) = self.0.lock() {
            first.get_or_insert(error);
        }
    }

    /// Whether there is an exception.
    pub(crate) fn is_set(&self) -> bool {
        self.0.lock().is_ok_and(|first| first.is_some())
    }

    /// Hands over the exception.
    pub(crate) fn take(&self) -> Option<PyErr> {
        self.0.lock().ok()?.take()
    }
}

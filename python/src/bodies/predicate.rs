//! Python functions of a position.

use std::cell::RefCell;

use pyo3::prelude::*;
use stickslip::nalgebra::SVector;

use crate::exit::attached;

/// A Python function of a position [m], a list of 2 or 3 coordinates, which says whether a point belongs to a set.
///
/// After an exception no point does, and [`finish`](Self::finish) raises it.
pub(super) struct Predicate<'py> {
    function: &'py Bound<'py, PyAny>,
    raised: RefCell<Option<PyErr>>,
}

impl<'py> Predicate<'py> {
    pub(super) fn new(function: &'py Bound<'py, PyAny>) -> Self {
        Self {
            function,
            raised: RefCell::new(None),
        }
    }

    /// Whether a point is in the set.
    pub(super) fn holds<const D: usize>(&self, x: &SVector<f64, D>) -> bool {
        if self.raised.borrow().is_some() {
            return false;
        }
        let asked = || {
            let at = (x.as_slice().to_vec(),);
            attached(|_| self.function.call1(at)?.is_truthy())
        };
        let answer = asked();
        answer.unwrap_or_else(|error| {
            *self.raised.borrow_mut() = Some(error);
            false
        })
    }

    /// The result of the search for these points, unless the function has raised an exception.
    pub(super) fn finish<T>(self, result: PyResult<T>) -> PyResult<T> {
        match self.raised.into_inner() {
            Some(error) => Err(error),
            None => result,
        }
    }
}

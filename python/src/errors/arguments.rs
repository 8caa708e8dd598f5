//! Exceptions of arguments, which name them.

use pyo3::exceptions::{PyOverflowError, PyTypeError, PyValueError};
use pyo3::prelude::*;

use super::{Attributes, exception, made};

/// The argument of this module that gives a quantity of the library.
pub(super) fn argument_of(what: &str) -> Option<&'static str> {
    let quantities = [
        ("normal stress", "normal_stress"),
        ("shear modulus", "shear_modulus"),
        ("shear wave speed", "shear_wave_speed"),
        ("Poisson's ratio", "poisson_ratio"),
        ("dip ", "dip"),
        ("rake ", "rake"),
        ("number of cells", "cells"),
        ("depth [m] of the fault's upper end", "ends"),
        ("distance [m] down dip of the fault's upper end", "ends"),
        ("distance [m] of the plane's upper end", "down_dip"),
    ];
    let found = quantities
        .iter()
        .find(|(quantity, _)| what.starts_with(quantity));
    found.map(|&(_, argument)| argument)
}

/// An exception whose message begins with the name of an argument.
pub(crate) fn of_argument(py: Python<'_>, name: &str, error: PyErr) -> PyErr {
    made((|| {
        let message = format!("{name}: {}", error.value(py));
        error.value(py).setattr("args", (&message,))?;
        error.value(py).setattr("message", message)?;
        Ok(error)
    })())
}

/// The exception of an argument that is none of its kind, which takes the name of the argument into its message; others
/// pass, such as an interruption.
pub(crate) fn misfit(py: Python<'_>, error: PyErr) -> PyErr {
    let is_type = error.is_instance_of::<PyTypeError>(py);
    let is_value =
        error.is_instance_of::<PyValueError>(py) || error.is_instance_of::<PyOverflowError>(py);
    if !(is_type || is_value) {
        return error;
    }
    let class = if is_type {
        "ArgumentTypeError"
    } else {
        "ArgumentValueError"
    };
    let message = if error.is_instance_of::<PyOverflowError>(py) {
        "must be an integer from 0 on, and below 2^64".to_owned()
    } else {
        error.value(py).to_string()
    };
    made(exception(
        py,
        class,
        message,
        ("Argument".to_owned(), Attributes::new()),
    ))
}

/// The exception of an argument with a value out of its range.
pub(crate) fn argument(name: &str, requirement: &str, value: impl std::fmt::Debug) -> PyErr {
    PyValueError::new_err(format!("{name} must be {requirement}, is {value:?}"))
}

/// A text that stands in a message without quotes.
pub(crate) struct Bare(pub(crate) String);

impl std::fmt::Debug for Bare {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&self.0)
    }
}

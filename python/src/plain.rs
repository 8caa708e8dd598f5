//! Objects as what they were given: attributes, text, pickles.

use pyo3::PyTypeInfo;
use pyo3::call::PyCallArgs;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyType};

/// The value of `__reduce__`: a function and its arguments, a class and what it was given.
pub(crate) type Reduced<'py> = (Bound<'py, PyAny>, (Bound<'py, PyType>, Bound<'py, PyDict>));

/// The fields of an object as a dictionary of Python.
macro_rules! fields {
    ($py:expr, $own:expr; $($name:ident),* $(,)?) => {{
        let fields = pyo3::types::PyDict::new($py);
        $( fields.set_item(stringify!($name), &$own.$name)?; )*
        fields
    }};
}
pub(crate) use fields;

/// Calls a function of a module of Python in this package.
pub(crate) fn helper<'py>(
    py: Python<'py>,
    module: &str,
    function: &str,
    arguments: impl PyCallArgs<'py>,
) -> PyResult<Bound<'py, PyAny>> {
    let module = py.import(format!("stickslip.{module}"))?;
    module.getattr(function)?.call1(arguments)
}

/// How an object of a class is pickled and copied: by the arguments of its constructor.
pub(crate) fn reduced<'py, T: PyTypeInfo>(
    py: Python<'py>,
    given: Bound<'py, PyDict>,
) -> PyResult<Reduced<'py>> {
    let rebuild = py.import("stickslip._plain")?.getattr("rebuild")?;
    Ok((rebuild, (T::type_object(py), given)))
}

/// The call that makes an object, as its text.
pub(crate) fn text(name: &str, given: &Bound<'_, PyDict>) -> PyResult<String> {
    helper(given.py(), "_plain", "call", (name, given))?.extract()
}

/// The arguments of an object as a table of HTML.
pub(crate) fn html(name: &str, given: &Bound<'_, PyDict>) -> PyResult<String> {
    helper(given.py(), "_plain", "table", (name, given))?.extract()
}

/// The ranges of the arrays of an object as a table of HTML.
pub(crate) fn ranges(name: &str, fields: &Bound<'_, PyDict>) -> PyResult<String> {
    helper(fields.py(), "_plain", "ranges", (name, fields))?.extract()
}

//! Files of the SEAS benchmarks as arrays.

use std::path::PathBuf;

use numpy::{PyArray1, PyArray2, PyArrayMethods};
use pyo3::exceptions::{PyKeyError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict};
use stickslip::record::SeasTable as Table;

use crate::arguments::named;
use crate::errors;
use crate::plain::{Reduced, fields, helper, reduced};
use crate::view::view;

/// A file in the format of the SEAS benchmarks, of this code or another.
///
///     table = stickslip.SeasTable("fltst_dp075")
///     table["t"], table["slip"]
///
/// Numbers are separated by spaces, tabs or commas, and may have Fortran's exponents. A last row that an interrupted
/// program has left incomplete is dropped.
///
/// Args:
///     path: of the file.
///
/// Raises:
///     OSError: for a file that cannot be read.
///     FileError: for a line that is no row; it has the attributes path and line.
#[pyclass(frozen, module = "stickslip")]
pub(crate) struct SeasTable {
    table: Table,
    /// Of the file.
    #[pyo3(get)]
    path: PathBuf,
    /// The file, from which a pickle is read again.
    contents: Vec<u8>,
}

#[pymethods]
impl SeasTable {
    #[new]
    #[pyo3(signature = (path, *, contents=None), text_signature = "(path)")]
    fn new(
        py: Python<'_>,
        #[pyo3(from_py_with = named)] path: PathBuf,
        contents: Option<Vec<u8>>,
    ) -> PyResult<Self> {
        let contents = match contents {
            Some(contents) => contents,
            None => std::fs::read(&path).map_err(|error| {
                let message = format!("cannot read {}: {error}", path.display());
                std::io::Error::new(error.kind(), message)
            })?,
        };
        match Table::parse(contents.as_slice(), &path) {
            Ok(table) => Ok(Self {
                table,
                path,
                contents,
            }),
            Err(error) => Err(errors::file(py, &error)),
        }
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Reduced<'py>> {
        let given = fields!(py, self; path);
        given.set_item("contents", PyBytes::new(py, &self.contents))?;
        reduced::<Self>(py, given)
    }

    /// A table of pandas with the columns of the file; not of one of slip or stress on a line.
    fn to_frame<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let (names, columns) = (self.table.names(), self.table.columns());
        if names.len() != columns.len() {
            let message = "a file of slip or stress on a line has no column of each name: take values and positions";
            return Err(PyValueError::new_err(message));
        }
        let table = PyDict::new(py);
        for (name, column) in names.iter().zip(columns) {
            table.set_item(name, PyArray1::from_slice(py, column))?;
        }
        helper(py, "_frames", "columns", (table,))
    }

    /// The names of the columns. The last one of a file of slip or stress on a line is that of all columns from the
    /// third one on.
    #[getter]
    fn names(&self) -> Vec<String> {
        self.table.names().to_vec()
    }

    /// The comments at the beginning of the file, without "#".
    #[getter]
    fn comments(&self) -> Vec<String> {
        self.table.comments().to_vec()
    }

    /// The positions of the columns from the third one on [m], of a file of slip or stress on a line; else None.
    #[getter]
    fn positions<'py>(slf: &Bound<'py, Self>) -> PyResult<Option<Bound<'py, PyArray1<f64>>>> {
        if slf.get().table.positions().is_none() {
            return Ok(None);
        }
        view(slf, |file| {
            file.table.positions().unwrap_or_default().into()
        })
        .map(Some)
    }

    /// All numbers: rows by columns.
    #[getter]
    fn values<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let columns = self.table.columns();
        let rows =
            (0..self.table.len()).flat_map(|row| columns.iter().map(move |column| column[row]));
        PyArray1::from_iter(py, rows).reshape([self.table.len(), columns.len()])
    }

    /// The value of the first comment `# key=value`, or None.
    fn metadata(&self, #[pyo3(from_py_with = named)] key: &str) -> Option<&str> {
        self.table.metadata(key)
    }

    /// The column of a name: a view, which cannot be written.
    fn __getitem__<'py>(slf: &Bound<'py, Self>, name: &str) -> PyResult<Bound<'py, PyArray1<f64>>> {
        let table = &slf.get().table;
        if table.column(name).is_none() {
            let message = format!("{name:?} is none of {:?}", table.names());
            return Err(PyKeyError::new_err(message));
        }
        view(slf, |file| {
            file.table.column(name).unwrap_or_default().into()
        })
    }

    fn __len__(&self) -> usize {
        self.table.len()
    }

    fn __repr__(&self) -> String {
        format!(
            "SeasTable({:?}, {} rows)",
            self.table.names(),
            self.table.len()
        )
    }
}

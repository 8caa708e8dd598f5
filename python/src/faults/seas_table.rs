//! Files of the SEAS benchmarks as arrays.

use std::path::PathBuf;

use numpy::{PyArray1, PyArray2, PyArrayMethods};
use pyo3::exceptions::PyKeyError;
use pyo3::prelude::*;
use stickslip::record::SeasTable as Table;

use crate::errors;
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
}

#[pymethods]
impl SeasTable {
    #[new]
    fn new(py: Python<'_>, path: PathBuf) -> PyResult<Self> {
        match Table::read(path) {
            Ok(table) => Ok(Self { table }),
            Err(error) => Err(errors::file(py, &error)),
        }
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
    fn metadata(&self, key: &str) -> Option<&str> {
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

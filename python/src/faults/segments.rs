//! Polylines of segments.

use std::fs::File;
use std::path::PathBuf;

use numpy::{PyArray1, PyArray2};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use stickslip::bie::{DipProfile, Segments as Lines};
use stickslip::nalgebra::Vector2;

use super::rows::{Lines as Given, Rows};
use crate::arguments::named;
use crate::errors;
use crate::plain::{Reduced, reduced, text};
use crate::view::into_rows;

/// Faults along polylines in a vertical plane: bent, listric, branched or several. Cells are the segments between points, of
/// one polyline after the other.
///
/// Args:
///     lines: points (x, z) [m] of a polyline, or a list of polylines; z is the height above the free surface, 0 or less.
#[pyclass(frozen, module = "stickslip")]
pub(crate) struct Segments {
    pub(super) cells: Lines,
}

/// The segments, or the exception of what makes none.
fn checked(
    py: Python<'_>,
    segments: Result<Lines, stickslip::bie::SegmentsError>,
) -> PyResult<Segments> {
    let cells = segments.map_err(|error| errors::segments(py, &error))?;
    Ok(Segments { cells })
}

#[pymethods]
impl Segments {
    #[new]
    #[pyo3(signature = (lines))]
    fn new(py: Python<'_>, #[pyo3(from_py_with = named)] lines: Given) -> PyResult<Self> {
        let Given(lines) = lines;
        checked(py, Lines::polylines(&lines))
    }

    /// The polylines of a table: columns x, z [m] and, of several, fault.
    ///
    /// Args:
    ///     path: a file of comma-separated values; lines that begin with # are comments.
    ///
    /// Raises:
    ///     OSError: for a file that cannot be read.
    #[staticmethod]
    #[pyo3(signature = (path))]
    fn from_csv(py: Python<'_>, #[pyo3(from_py_with = named)] path: PathBuf) -> PyResult<Self> {
        let file = File::open(&path)?;
        checked(py, Lines::from_csv(file))
    }

    /// A fault by its dip, in cells of about equal length.
    ///
    /// Args:
    ///     pieces: pairs of a dip [degrees] and a length down dip [m], from above.
    ///     length: of cells [m], > 0.
    ///     spread: length [m] over which each bend is spread; 0 for sharp bends.
    ///     start: the first point (x, z) [m].
    #[staticmethod]
    #[pyo3(signature = (pieces, length, *, spread=0.0, start=[0.0, 0.0]), text_signature = "(pieces, length, *, spread=0.0, start=(0.0, 0.0))")]
    fn down(
        py: Python<'_>,
        #[pyo3(from_py_with = named)] pieces: Rows<2>,
        #[pyo3(from_py_with = named)] length: f64,
        #[pyo3(from_py_with = named)] spread: f64,
        #[pyo3(from_py_with = named)] start: [f64; 2],
    ) -> PyResult<Self> {
        let Rows(pieces) = pieces;
        let pieces = pieces.into_iter().map(|[dip, length]| (dip, length));
        let profile = DipProfile::new(pieces).spread(spread).starting_at(start);
        checked(py, Lines::down(profile, length))
    }

    /// The same polylines in cells of at most this length [m].
    #[pyo3(signature = (length))]
    fn divided(&self, py: Python<'_>, #[pyo3(from_py_with = named)] length: f64) -> PyResult<Self> {
        checked(py, self.cells.divided(length))
    }

    /// These polylines and others, behind them.
    #[pyo3(signature = (others))]
    fn joined(
        &self,
        py: Python<'_>,
        #[pyo3(from_py_with = named)] others: Py<Self>,
    ) -> PyResult<Self> {
        checked(py, self.cells.with(&others.get().cells))
    }

    /// The points of each polyline [m].
    #[getter]
    fn lines<'py>(&self, py: Python<'py>) -> PyResult<Vec<Bound<'py, PyArray2<f64>>>> {
        let lines = (0..self.cells.fault_count()).map(|fault| {
            let cells = self.cells.cells_of(fault);
            let first = cells.start;
            let ends = cells.map(|cell| self.cells.ends(cell)[1]);
            let points = std::iter::once(self.cells.ends(first)[0]).chain(ends);
            into_rows(py, points.map(Vector2::from).collect())
        });
        lines.collect()
    }

    /// The centres of cells [m], one row each: x and z.
    #[getter]
    fn centers<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        into_rows(py, self.cells.map(Vector2::from))
    }

    /// The lengths of cells [m].
    #[getter]
    fn lengths<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        PyArray1::from_iter(py, (0..self.cells.count()).map(|n| self.cells.length(n)))
    }

    /// The distances of the centres of cells from the first point of their polyline, along it [m].
    #[getter]
    fn distances<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        PyArray1::from_vec(py, self.cells.distances())
    }

    /// The number of the polyline of each cell.
    #[getter]
    fn faults<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<usize>> {
        PyArray1::from_iter(py, (0..self.cells.count()).map(|n| self.cells.fault_of(n)))
    }

    /// How even and smooth they are: `largest_ratio` of lengths of neighbours, `unequal` pairs of neighbours with a ratio above
    /// 1.2, and `largest_bend` [degrees].
    #[getter]
    fn quality<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let (quality, shown) = (self.cells.quality(), PyDict::new(py));
        shown.set_item("largest_ratio", quality.largest_ratio)?;
        shown.set_item("unequal", quality.unequal)?;
        shown.set_item("largest_bend", quality.largest_bend)?;
        Ok(shown)
    }

    fn __len__(&self) -> usize {
        self.cells.count()
    }

    fn __repr__(&self, py: Python<'_>) -> PyResult<String> {
        text("Segments", &self.given(py)?)
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Reduced<'py>> {
        reduced::<Self>(py, self.given(py)?)
    }
}

impl Segments {
    /// The arguments.
    fn given<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let given = PyDict::new(py);
        given.set_item("lines", self.lines(py)?)?;
        Ok(given)
    }
}

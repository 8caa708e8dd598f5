//! Surfaces of triangles.

use std::path::PathBuf;

use numpy::{PyArray1, PyArray2, PyArrayMethods};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use stickslip::SceneError;
use stickslip::bie::{SurfaceError, Triangles as Cells};
use stickslip::fem::gmsh;
use stickslip::nalgebra::Vector3;

use super::rows::Rows;
use crate::arguments::named;
use crate::errors::{self, argument};
use crate::plain::{Reduced, reduced};
use crate::view::into_rows;

/// The triangles of a fault in space: of any shape, of several sheets, with branches. Points that coincide are merged, and
/// triangles are turned so that those of a sheet agree.
///
/// Args:
///     points: x, y, z [m] of each point: east, north, and up from the free surface.
///     triangles: the numbers of the three points of each triangle, from 0.
#[pyclass(frozen, module = "stickslip")]
pub(crate) struct Triangles {
    pub(super) cells: Cells,
}

/// The cells, or the exception of what makes none.
fn checked(py: Python<'_>, cells: Result<Cells, SurfaceError>) -> PyResult<Triangles> {
    let cells = cells.map_err(|error| errors::surface(py, &error))?;
    Ok(Triangles { cells })
}

/// The numbers of points.
fn numbers(rows: Vec<[f64; 3]>) -> PyResult<Vec<[usize; 3]>> {
    let number = |x: f64| x >= 0.0 && x.fract() == 0.0 && x < 2_f64.powi(53);
    let whole = |(n, row): (usize, [f64; 3])| {
        if row.iter().all(|&x| number(x)) {
            return Ok(row.map(|x| x as usize));
        }
        let name = format!("triangles[{n}]");
        Err(argument(&name, "three integers from 0 on", row))
    };
    rows.into_iter().enumerate().map(whole).collect()
}

#[pymethods]
impl Triangles {
    #[new]
    #[pyo3(signature = (points, triangles))]
    fn new(
        py: Python<'_>,
        #[pyo3(from_py_with = named)] points: Rows<3>,
        #[pyo3(from_py_with = named)] triangles: Rows<3>,
    ) -> PyResult<Self> {
        let (Rows(points), Rows(triangles)) = (points, triangles);
        let triangles = numbers(triangles)?;
        checked(py, Cells::new(&points, &triangles))
    }

    /// The triangles of a file of Gmsh.
    ///
    /// Args:
    ///     path: an .msh file of version 2.2 or 4.1.
    ///     groups: names of physical groups; None for all triangles.
    #[staticmethod]
    #[pyo3(signature = (path, groups=None))]
    fn gmsh(
        py: Python<'_>,
        #[pyo3(from_py_with = named)] path: PathBuf,
        #[pyo3(from_py_with = named)] groups: Option<Vec<String>>,
    ) -> PyResult<Self> {
        let surface = gmsh::read_surface(&path);
        let mut surface = surface.map_err(|error| errors::mesh_file(py, &path, &error))?;
        if let Some(groups) = &groups {
            let groups: Vec<&str> = groups.iter().map(String::as_str).collect();
            let part = surface.of_groups(&groups);
            surface = part.map_err(|error| errors::scene(py, &SceneError::from(error)))?;
        }
        checked(py, Cells::new(&surface.points, &surface.triangles))
    }

    /// The triangles of an STL file, text or binary.
    #[staticmethod]
    #[pyo3(signature = (path))]
    fn stl(py: Python<'_>, #[pyo3(from_py_with = named)] path: PathBuf) -> PyResult<Self> {
        checked(py, Cells::read_stl(&path))
    }

    /// The vertices [m], one row each.
    #[getter]
    fn points<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let points = self.cells.points().iter();
        into_rows(py, points.copied().map(Vector3::from).collect())
    }

    /// The numbers of the vertices of each triangle, counterclockwise as seen from the side of its normal.
    #[getter]
    fn triangles<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<usize>>> {
        let numbers = self.cells.triangles().as_flattened().to_vec();
        PyArray1::from_vec(py, numbers).reshape([self.cells.count(), 3])
    }

    /// The centroids of triangles [m], one row each.
    #[getter]
    fn centers<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        into_rows(py, self.cells.map(Vector3::from))
    }

    /// The areas of triangles [m^2].
    #[getter]
    fn areas<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        PyArray1::from_iter(py, (0..self.cells.count()).map(|n| self.cells.area(n)))
    }

    /// The directions along strike of each triangle, one row each.
    #[getter]
    fn strikes<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let axes = (0..self.cells.count()).map(|n| self.cells.axes(n).strike);
        into_rows(py, axes.map(Vector3::from).collect())
    }

    /// The directions up dip, one row each.
    #[getter]
    fn dips<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let axes = (0..self.cells.count()).map(|n| self.cells.axes(n).up_dip);
        into_rows(py, axes.map(Vector3::from).collect())
    }

    /// The normals, one row each.
    #[getter]
    fn normals<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let axes = (0..self.cells.count()).map(|n| self.cells.axes(n).normal);
        into_rows(py, axes.map(Vector3::from).collect())
    }

    /// The number of the sheet of each triangle.
    #[getter]
    fn sheets<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<usize>> {
        PyArray1::from_iter(py, (0..self.cells.count()).map(|n| self.cells.sheet(n)))
    }

    /// What to look at before a run: `extent` [m], `area` [m^2], the shortest and the longest of `sides` [m], `needles`, pairs
    /// of `uneven` neighbours, `largest_bend` [degrees], and `text`, all of it in one line.
    #[getter]
    fn quality<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let (quality, shown) = (self.cells.quality(), PyDict::new(py));
        shown.set_item("text", quality.to_string())?;
        shown.set_item("extent", quality.extent)?;
        shown.set_item("area", quality.area)?;
        shown.set_item("sides", quality.sides)?;
        shown.set_item("needles", quality.needles)?;
        shown.set_item("uneven", quality.uneven)?;
        let bend = quality.largest_bend.map_or(0.0, |(bend, _)| bend);
        shown.set_item("largest_bend", bend)?;
        Ok(shown)
    }

    fn __len__(&self) -> usize {
        self.cells.count()
    }

    fn __repr__(&self) -> String {
        let (cells, points) = (self.cells.count(), self.cells.points().len());
        format!("Triangles({cells} triangles, {points} points)")
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Reduced<'py>> {
        let given = PyDict::new(py);
        given.set_item("points", self.points(py)?)?;
        given.set_item("triangles", self.triangles(py)?)?;
        reduced::<Self>(py, given)
    }
}

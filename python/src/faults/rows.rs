//! Points and other rows of numbers as arguments.

use pyo3::prelude::*;

use crate::arguments::wrong_type;
use crate::bodies::PerVertex;

/// Rows of `D` numbers each: an array of shape `(n, D)`, or a sequence of rows.
pub(super) struct Rows<const D: usize>(pub(super) Vec<[f64; D]>);

impl<'a, 'py, const D: usize> FromPyObject<'a, 'py> for Rows<D> {
    type Error = PyErr;

    fn extract(given: Borrowed<'a, 'py, PyAny>) -> PyResult<Self> {
        match given.extract::<PerVertex>() {
            Ok(PerVertex::Shaped(values, shape)) if shape.len() == 2 && shape[1] == D => {
                let (rows, _) = values.as_chunks::<D>();
                Ok(Self(rows.to_vec()))
            }
            _ => Err(wrong_type(
                &format!("an array of shape (n, {D}) of numbers"),
                &given,
            )),
        }
    }
}

/// Points in space, or in a plane: rows of two or three coordinates \[m\].
pub(super) struct Points(Vec<[f64; 3]>, bool);

impl<'a, 'py> FromPyObject<'a, 'py> for Points {
    type Error = PyErr;

    fn extract(given: Borrowed<'a, 'py, PyAny>) -> PyResult<Self> {
        if let Ok(Rows(points)) = given.extract::<Rows<3>>() {
            return Ok(Self(points, false));
        }
        let flat: PyResult<Rows<2>> = given.extract();
        let Rows(points) =
            flat.map_err(|_| wrong_type("an array of shape (n, 2) or (n, 3) of numbers", &given))?;
        let points = points.into_iter().map(|[x, other]| [x, other, 0.0]);
        Ok(Self(points.collect(), true))
    }
}

impl Points {
    /// Points of which two coordinates are `x` and `z`.
    pub(super) fn in_section(self) -> Vec<[f64; 3]> {
        let Self(points, flat) = self;
        let place = |[x, other, z]: [f64; 3]| {
            if flat { [x, 0.0, other] } else { [x, other, z] }
        };
        points.into_iter().map(place).collect()
    }

    /// Points of which two coordinates are `x` and `y`, at `z = 0`.
    pub(super) fn at_surface(self) -> Vec<[f64; 3]> {
        self.0
    }
}

/// Polylines: one, or a list of them.
pub(super) struct Lines(pub(super) Vec<Vec<[f64; 2]>>);

impl<'a, 'py> FromPyObject<'a, 'py> for Lines {
    type Error = PyErr;

    fn extract(given: Borrowed<'a, 'py, PyAny>) -> PyResult<Self> {
        if let Ok(Rows(line)) = given.extract() {
            return Ok(Self(vec![line]));
        }
        let lines = given.try_iter()?.map(|line| {
            let Rows(line) = line?.extract()?;
            Ok(line)
        });
        let lines: PyResult<Vec<_>> = lines.collect();
        lines.map(Self).map_err(|_: PyErr| {
            wrong_type("a polyline of points (x, z) [m], or a list of them", &given)
        })
    }
}

//! Numbers per cell, checked before the cells are known.

use numpy::{IntoPyArray, PyArray1, PyArrayMethods};
use pyo3::IntoPyObjectExt;
use pyo3::prelude::*;

use crate::bodies::PerVertex;
use crate::errors::argument;
use crate::faults::Layout;

/// The range of a parameter.
pub(super) struct Range {
    requirement: &'static str,
    legal: fn(f64) -> bool,
}

pub(super) const POSITIVE: Range = Range {
    requirement: "finite and positive",
    legal: |x| x.is_finite() && x > 0.0,
};
pub(super) const NOT_NEGATIVE: Range = Range {
    requirement: "finite and non-negative",
    legal: |x| x.is_finite() && x >= 0.0,
};
pub(super) const FINITE: Range = Range {
    requirement: "finite",
    legal: f64::is_finite,
};
pub(super) const POSITIVE_OR_INFINITE: Range = Range {
    requirement: "positive",
    legal: |x| x > 0.0,
};

/// A number for all cells, or one each.
#[derive(Clone)]
pub(crate) struct CellValues(PerVertex);

impl From<f64> for CellValues {
    fn from(value: f64) -> Self {
        Self(PerVertex::Uniform(value))
    }
}

impl<'a, 'py> FromPyObject<'a, 'py> for CellValues {
    type Error = PyErr;

    fn extract(given: Borrowed<'a, 'py, PyAny>) -> PyResult<Self> {
        given.extract().map(Self)
    }
}

impl<'py> IntoPyObject<'py> for &CellValues {
    type Target = PyAny;
    type Output = Bound<'py, PyAny>;
    type Error = PyErr;

    fn into_pyobject(self, py: Python<'py>) -> PyResult<Self::Output> {
        match &self.0 {
            PerVertex::Uniform(value) => value.into_bound_py_any(py),
            PerVertex::Each(values) => Ok(PyArray1::from_slice(py, values).into_any()),
            PerVertex::Shaped(values, shape) => {
                let array = values.clone().into_pyarray(py).reshape(shape.clone())?;
                Ok(array.into_any())
            }
        }
    }
}

impl CellValues {
    /// Passes numbers in their range.
    pub(super) fn within(self, name: &str, range: &Range) -> PyResult<Self> {
        let (values, shape) = match &self.0 {
            PerVertex::Uniform(value) if (range.legal)(*value) => return Ok(self),
            PerVertex::Uniform(value) => return Err(argument(name, range.requirement, value)),
            PerVertex::Each(values) => (values, std::slice::from_ref(&0)),
            PerVertex::Shaped(values, shape) => (values, shape.as_slice()),
        };
        let Some(mut n) = values.iter().position(|&value| !(range.legal)(value)) else {
            return Ok(self);
        };
        let value = values[n];
        // From the last axis on.
        let mut place = Vec::new();
        for &count in shape.iter().skip(1).rev() {
            place.push((n % count).to_string());
            n /= count;
        }
        place.push(n.to_string());
        place.reverse();
        let name = format!("{name}[{}]", place.join(", "));
        Err(argument(&name, range.requirement, value))
    }

    /// The numbers of the cells of a fault.
    pub(super) fn on<T: From<f64> + From<Vec<f64>>>(
        &self,
        name: &str,
        cells: Layout,
    ) -> PyResult<T> {
        match &self.0 {
            PerVertex::Uniform(value) => Ok((*value).into()),
            values => {
                let values = cells.flat(values.clone());
                Ok(values
                    .checked(name, cells.count, "a number", |_| true)?
                    .into())
            }
        }
    }
}

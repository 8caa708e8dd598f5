//! Parts of the boundary.

use numpy::{PyArray1, PyArray2};
use pyo3::prelude::*;
use stickslip::fem::Trace;

use crate::view::{rows, view};

/// A part of the boundary of a mesh. Its arrays are views, which cannot be written.
#[pyclass(frozen, module = "stickslip")]
pub(crate) struct Part {
    pub(super) trace: AnyTrace,
}

/// A part in the plane or in space.
#[derive(Clone)]
pub(super) enum AnyTrace {
    Plane(Trace<2>),
    Space(Trace<3>),
}

macro_rules! each {
    ($any:expr, $trace:ident => $work:expr) => {
        match $any {
            AnyTrace::Plane($trace) => $work,
            AnyTrace::Space($trace) => $work,
        }
    };
}

#[pymethods]
impl Part {
    /// The numbers of its vertices in the mesh.
    #[getter]
    fn vertices<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyArray1<usize>>> {
        view(
            slf,
            |part| each!(&part.trace, trace => trace.vertices().into()),
        )
    }

    /// Positions of its vertices [m], one row each.
    #[getter]
    fn points<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        view(
            slf,
            |part| each!(&part.trace, trace => rows(trace.points())),
        )
    }

    /// The share of its surface of each vertex: [m], or [m^2] in space.
    #[getter]
    fn weights<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyArray1<f64>>> {
        view(
            slf,
            |part| each!(&part.trace, trace => trace.weights().into()),
        )
    }

    fn __len__(&self) -> usize {
        self.count()
    }

    fn __repr__(&self) -> String {
        format!("Part({} vertices)", self.count())
    }
}

impl Part {
    /// The number of vertices.
    pub(super) fn count(&self) -> usize {
        each!(&self.trace, trace => trace.vertices().len())
    }
}

impl From<Trace<2>> for AnyTrace {
    fn from(trace: Trace<2>) -> Self {
        Self::Plane(trace)
    }
}

impl From<Trace<3>> for AnyTrace {
    fn from(trace: Trace<3>) -> Self {
        Self::Space(trace)
    }
}

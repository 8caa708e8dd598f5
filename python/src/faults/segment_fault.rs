//! Faults of segments.

use numpy::{PyArray1, PyArray2, PyArray3, PyArrayMethods};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use stickslip::bie::{Medium, Mode, SegmentFault as Fault, Sense};
use stickslip::nalgebra::{Vector1, Vector3};

use super::cycle::FaultSimulation;
use super::geometry::Geometry;
use super::laws::Given;
use super::loading::Directed;
use super::per_cell::PerCell;
use super::receivers::Receivers;
use super::rows::{Points, Rows};
use super::scene::{Arguments, simulation};
use super::segments::Segments;
use crate::arguments::{Numbers, named};
use crate::bodies::PerVertex;
use crate::errors::{self, argument};
use crate::fields::AnyField;
use crate::plain::{Reduced, fields, html, reduced, text};
use crate::view::into_rows;

/// A fault along polylines, or several: in antiplane strain, or with `poisson_ratio` in plane strain, where slip changes the
/// normal stress. At most 2000 cells.
///
/// Args:
///     segments: the cells.
///     shear_modulus: [Pa], > 0.
///     shear_wave_speed: [m/s], > 0.
///     poisson_ratio: of plane strain, > -1 and < 0.5; None for antiplane strain.
///     space: "half" or "whole".
///     sense: "thrust" or "normal", the positive sense of slip in plane strain.
#[pyclass(frozen, module = "stickslip")]
pub(crate) struct SegmentFault {
    fault: Fault,
    geometry: Geometry,
    #[pyo3(get)]
    segments: Py<Segments>,
    #[pyo3(get)]
    shear_modulus: f64,
    #[pyo3(get)]
    shear_wave_speed: f64,
    #[pyo3(get)]
    poisson_ratio: Option<f64>,
    #[pyo3(get)]
    space: String,
    #[pyo3(get)]
    sense: String,
}

#[pymethods]
impl SegmentFault {
    #[new]
    #[pyo3(signature = (segments, *, shear_modulus, shear_wave_speed, poisson_ratio=None, space="half", sense="thrust"))]
    fn new(
        py: Python<'_>,
        #[pyo3(from_py_with = named)] segments: Py<Segments>,
        #[pyo3(from_py_with = named)] shear_modulus: f64,
        #[pyo3(from_py_with = named)] shear_wave_speed: f64,
        #[pyo3(from_py_with = named)] poisson_ratio: Option<f64>,
        #[pyo3(from_py_with = named)] space: &str,
        #[pyo3(from_py_with = named)] sense: &str,
    ) -> PyResult<Self> {
        let positive = match sense {
            "thrust" => Sense::Thrust,
            "normal" => Sense::Normal,
            _ => return Err(argument("sense", "\"thrust\" or \"normal\"", sense)),
        };
        let rock = Medium {
            shear_modulus,
            shear_wave_speed,
        };
        let mode = match poisson_ratio {
            Some(poisson_ratio) => Mode::InPlane { poisson_ratio },
            None => Mode::Antiplane,
        };
        let cells = segments.get().cells.clone();
        let fault = match space {
            "half" => Fault::half_space(cells, rock, mode),
            "whole" => Fault::whole_space(cells, rock, mode),
            _ => return Err(argument("space", "\"half\" or \"whole\"", space)),
        };
        let fault = fault.map_err(|error| errors::segments(py, &error))?;
        let fault = fault.with_sense(positive);
        Ok(Self {
            geometry: Geometry::Segments(fault.clone()),
            fault,
            segments,
            shear_modulus,
            shear_wave_speed,
            poisson_ratio,
            space: space.to_owned(),
            sense: sense.to_owned(),
        })
    }

    /// The centres of cells [m], one row each: x and z.
    #[getter]
    fn centers<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        into_rows(py, self.geometry.centers())
    }

    /// The part along the fault of one velocity of the plate [m/s]: its x, y and z. It is a `plate_rate` for `simulation`.
    #[pyo3(signature = (velocity))]
    fn along<'py>(
        &self,
        py: Python<'py>,
        #[pyo3(from_py_with = named)] velocity: [f64; 3],
    ) -> PyResult<Bound<'py, PyArray1<f64>>> {
        let rates = self.fault.along(velocity);
        let rates = rates.map_err(|error| errors::kernel(py, &error))?;
        Ok(PyArray1::from_iter(py, rates.iter().map(|rate| rate[0])))
    }

    /// The displacement at points that slip causes [m], one row each: x, y and z.
    ///
    /// Args:
    ///     points: (x, z) [m], not at ends of cells; on the fault it is the mean of both sides.
    ///     slip: of each cell [m].
    #[pyo3(signature = (points, slip))]
    fn displacement_at<'py>(
        &self,
        py: Python<'py>,
        #[pyo3(from_py_with = named)] points: Rows<2>,
        #[pyo3(from_py_with = named)] slip: Numbers,
    ) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let (Rows(points), Numbers(slip)) = (points, slip);
        let slip: Vec<_> = slip.into_iter().map(Vector1::new).collect();
        let found = self.fault.displacement_at(&points, &slip);
        let found = found.map_err(|error| errors::segments(py, &error))?;
        into_rows(py, found.into_iter().map(Vector3::from).collect())
    }

    /// The stress at points that slip causes [Pa], a matrix of 3 x 3 each; tension is positive.
    #[pyo3(signature = (points, slip))]
    fn stress_at<'py>(
        &self,
        py: Python<'py>,
        #[pyo3(from_py_with = named)] points: Rows<2>,
        #[pyo3(from_py_with = named)] slip: Numbers,
    ) -> PyResult<Bound<'py, PyArray3<f64>>> {
        let (Rows(points), Numbers(slip)) = (points, slip);
        let slip: Vec<_> = slip.into_iter().map(Vector1::new).collect();
        let found = self.fault.stress_at(&points, &slip);
        let found = found.map_err(|error| errors::segments(py, &error))?;
        let numbers = found.iter().flatten().copied();
        PyArray1::from_iter(py, numbers).reshape([points.len(), 3, 3])
    }

    /// Points off the fault, at which its slip displaces and strains the rock; axes are those of the segments.
    ///
    /// Args:
    ///     points: (x, z) or (x, y, z) [m], not at ends of cells; right beside the fault both sides differ by the slip.
    #[pyo3(signature = (points))]
    fn receivers(
        slf: &Bound<'_, Self>,
        #[pyo3(from_py_with = named)] points: Points,
    ) -> PyResult<Receivers> {
        Receivers::of(slf.as_any(), &slf.get().geometry, points, None)
    }

    /// A simulation with friction on the fault; the arguments are those of `LineFault.simulation`.
    #[pyo3(signature = (*, a=None, b=None, Dc=None, normal_stress, shear_stress, theta=None, log_theta=None, slip_rate=None,
                        mu0=PerVertex::Uniform(0.6),
                        V0=PerVertex::Uniform(1e-6), plate_rate=None,
                        stress_rate=None, friction=None, law=None, allow_opening=false, pressure=None, overstress=None, alpha=None,
                        fields=Vec::new(), least_normal_stress=None),
           text_signature = "($self, *, a=None, b=None, Dc=None, normal_stress, shear_stress, theta=None, log_theta=None, slip_rate=None, mu0=0.6, V0=1e-06, plate_rate=0.0, stress_rate=None, friction='regularized', law='aging', allow_opening=False, pressure=None, overstress=None, alpha=None, fields=[], least_normal_stress=None)")]
    #[expect(non_snake_case, reason = "names of the field")]
    #[expect(clippy::too_many_arguments, reason = "keywords in Python")]
    fn simulation(
        &self,
        py: Python<'_>,
        #[pyo3(from_py_with = named)] a: Option<PerVertex>,
        #[pyo3(from_py_with = named)] b: Option<PerVertex>,
        #[pyo3(from_py_with = named)] Dc: Option<PerVertex>,
        #[pyo3(from_py_with = named)] normal_stress: PerVertex,
        #[pyo3(from_py_with = named)] shear_stress: PerCell,
        #[pyo3(from_py_with = named)] theta: Option<PerVertex>,
        #[pyo3(from_py_with = named)] log_theta: Option<PerVertex>,
        #[pyo3(from_py_with = named)] slip_rate: Option<PerCell>,
        #[pyo3(from_py_with = named)] mu0: PerVertex,
        #[pyo3(from_py_with = named)] V0: PerVertex,
        #[pyo3(from_py_with = named)] plate_rate: Option<PerCell>,
        #[pyo3(from_py_with = named)] stress_rate: Option<PerCell>,
        friction: Option<Bound<'_, PyAny>>,
        law: Option<Bound<'_, PyAny>>,
        #[pyo3(from_py_with = named)] allow_opening: bool,
        pressure: Option<Py<PyAny>>,
        overstress: Option<Py<PyAny>>,
        #[pyo3(from_py_with = named)] alpha: Option<PerVertex>,
        #[pyo3(from_py_with = named)] fields: Vec<AnyField>,
        #[pyo3(from_py_with = named)] least_normal_stress: Option<f64>,
    ) -> PyResult<FaultSimulation> {
        let arguments = Arguments {
            laws: Given {
                fitted: [a, b, Dc],
                reference: [mu0, V0],
                friction,
                law,
            },
            directed: Directed {
                shear_stress,
                plate_rate,
                stress_rate,
                slip_rate,
                overstress,
            },
            normal_stress,
            theta,
            log_theta,
            alpha,
            allow_opening,
            pressure,
            fields,
            least_normal_stress,
        };
        simulation(py, (&self.geometry, self.shear_modulus), arguments)
    }

    fn __len__(&self) -> usize {
        self.geometry.count()
    }

    fn __repr__(&self, py: Python<'_>) -> PyResult<String> {
        text("SegmentFault", &self.given(py)?)
    }

    fn _repr_html_(&self, py: Python<'_>) -> PyResult<String> {
        html("SegmentFault", &self.given(py)?)
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Reduced<'py>> {
        reduced::<Self>(py, self.given(py)?)
    }
}

impl SegmentFault {
    /// The arguments.
    fn given<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        Ok(
            fields!(py, self; segments, shear_modulus, shear_wave_speed, poisson_ratio, space, sense),
        )
    }
}

//! Several planes in one half space.

use numpy::PyArray2;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use stickslip::bie::{FaultGeometry, FaultSystem as System, KernelError, Placement};
use stickslip::nalgebra::Vector3;

use super::cycle::FaultSimulation;
use super::geometry::Geometry;
use super::laws::Given;
use super::loading::Directed;
use super::per_cell::PerCell;
use super::plane::PlaneFault;
use super::receivers::Receivers;
use super::rows::Points;
use super::scene::{Arguments, simulation};
use crate::arguments::named;
use crate::bodies::PerVertex;
use crate::errors::{self, Bare, argument};
use crate::fields::AnyField;
use crate::plain::{Reduced, html, reduced, text};
use crate::view::into_rows;

/// Several planes below one free surface, each of which feels the slip of all others.
///
/// A plane meets the surface along a line through its origin, with its strike, and dips to the right of it. Cells are numbered
/// plane after plane: `ranges` has those of each.
///
/// Args:
///     planes: PlaneFaults with space="half", in the same rock, all with a fixed rake or all with a free one.
///     strikes: of the planes, clockwise from north [degrees].
///     origins: pairs east and north [m]: the points of the surface from which positions along strike are counted.
#[pyclass(frozen, module = "stickslip")]
pub(crate) struct FaultSystem {
    geometry: Geometry,
    #[pyo3(get)]
    planes: Vec<Py<PlaneFault>>,
    #[pyo3(get)]
    strikes: Vec<f64>,
    #[pyo3(get)]
    origins: Vec<[f64; 2]>,
    shear_modulus: f64,
}

#[pymethods]
impl FaultSystem {
    #[new]
    #[pyo3(signature = (planes, *, strikes, origins))]
    fn new(
        py: Python<'_>,
        #[pyo3(from_py_with = named)] planes: Vec<Py<PlaneFault>>,
        #[pyo3(from_py_with = named)] strikes: Vec<f64>,
        #[pyo3(from_py_with = named)] origins: Vec<[f64; 2]>,
    ) -> PyResult<Self> {
        for (name, count) in [("strikes", strikes.len()), ("origins", origins.len())] {
            if count != planes.len() {
                let requirement = format!("one for each of {} planes", planes.len());
                return Err(argument(
                    name,
                    &requirement,
                    Bare(format!("{count} of them")),
                ));
            }
        }
        let places = strikes.iter().zip(&origins);
        let places = places.map(|(&strike, &origin)| Placement { strike, origin });
        let (mut fixed, mut free) = (Vec::new(), Vec::new());
        for (plane, place) in planes.iter().zip(places) {
            match plane.get().geometry() {
                Geometry::Plane(plane) => fixed.push((plane.clone(), place)),
                Geometry::Free(plane) => free.push((plane.clone(), place)),
                _ => {}
            }
        }
        if !fixed.is_empty() && !free.is_empty() {
            let requirement = "planes with a fixed rake, or with a free one";
            return Err(argument(
                "planes",
                requirement,
                Bare("some of both".to_owned()),
            ));
        }
        let made = || -> Result<Geometry, KernelError> {
            Ok(if free.is_empty() {
                Geometry::Planes(System::new(fixed)?)
            } else {
                Geometry::FreePlanes(System::new(free)?)
            })
        };
        let geometry = made();
        let geometry = geometry
            .map_err(|error| errors::of_argument(py, "planes", errors::kernel(py, &error)))?;
        let shear_modulus = planes
            .first()
            .map_or(0.0, |plane| plane.get().shear_modulus());
        Ok(Self {
            geometry,
            planes,
            strikes,
            origins,
            shear_modulus,
        })
    }

    /// The first cell of each plane, and the one behind its last.
    #[getter]
    fn ranges(&self) -> Vec<(usize, usize)> {
        let mut begin = 0;
        let ranges = self.planes.iter().map(|plane| {
            let from = begin;
            begin += plane.get().geometry().count();
            (from, begin)
        });
        ranges.collect()
    }

    /// The centres of cells [m], one row each: east, north, and up from the surface.
    #[getter]
    fn centers<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let centers = match &self.geometry {
            Geometry::FreePlanes(system) => FaultGeometry::cells(system).centers,
            Geometry::Planes(system) => FaultGeometry::cells(system).centers,
            _ => Vec::new(),
        };
        into_rows(py, centers.into_iter().map(Vector3::from).collect())
    }

    /// Points off the planes, at which their slip displaces and strains the rock. Axes: east, north and up.
    ///
    /// Args:
    ///     points: (x, y, z) [m], or (x, y) at z = 0, not on edges of cells; right beside a plane both sides differ by the
    ///         slip.
    #[pyo3(signature = (points))]
    fn receivers(
        slf: &Bound<'_, Self>,
        #[pyo3(from_py_with = named)] points: Points,
    ) -> PyResult<Receivers> {
        Receivers::of(slf.as_any(), &slf.get().geometry, points, None)
    }

    /// A simulation with friction on the planes; the arguments are those of `LineFault.simulation`, with values per cell plane
    /// after plane, and those of `PlaneFault.simulation` for a free rake.
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
        text("FaultSystem", &self.given(py)?)
    }

    fn _repr_html_(&self, py: Python<'_>) -> PyResult<String> {
        html("FaultSystem", &self.given(py)?)
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Reduced<'py>> {
        reduced::<Self>(py, self.given(py)?)
    }
}

impl FaultSystem {
    /// The arguments.
    fn given<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let given = PyDict::new(py);
        let planes: Vec<_> = self.planes.iter().map(|plane| plane.bind(py)).collect();
        given.set_item("planes", planes)?;
        given.set_item("strikes", &self.strikes)?;
        given.set_item("origins", &self.origins)?;
        Ok(given)
    }
}

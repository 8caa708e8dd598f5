//! Faults of triangles.

use numpy::{PyArray1, PyArray2};
use pyo3::IntoPyObjectExt;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use stickslip::bie::{Medium, SurfaceError, SurfaceFault as Fault};
use stickslip::nalgebra::Vector3;

use super::cycle::FaultSimulation;
use super::geometry::Geometry;
use super::laws::Given;
use super::loading::Directed;
use super::per_cell::PerCell;
use super::receivers::Receivers;
use super::rows::Points;
use super::scene::{Arguments, simulation};
use super::triangles::Triangles;
use crate::arguments::{named, wrong_type};
use crate::bodies::PerVertex;
use crate::errors::{self, argument};
use crate::fields::AnyField;
use crate::plain::{Reduced, fields, html, reduced, text};
use crate::view::into_rows;

/// A fault that is a surface of triangles, of any shape, in a whole space or below a free surface. Slip changes the normal
/// stress. Slip has a rake, or two components. Its matrices are dense: 16 bytes per pair of cells with a rake, 48 with two
/// components.
///
/// Args:
///     cells: the triangles.
///     shear_modulus: [Pa], > 0.
///     shear_wave_speed: [m/s], > 0.
///     poisson_ratio: > -1 and < 0.5.
///     space: "half" or "whole".
///     rake: of slip [degrees], one or one per cell: 0 along strike (left-lateral), 90 up dip (thrust); or "free" for slip along
///         the shear stress, with two components: along strike and up dip of each cell.
#[pyclass(frozen, module = "stickslip")]
pub(crate) struct SurfaceFault {
    geometry: Geometry,
    #[pyo3(get)]
    cells: Py<Triangles>,
    #[pyo3(get)]
    shear_modulus: f64,
    #[pyo3(get)]
    shear_wave_speed: f64,
    #[pyo3(get)]
    poisson_ratio: f64,
    #[pyo3(get)]
    space: String,
    rake: Rakes,
}

/// The rake of slip.
#[derive(Clone)]
enum Rakes {
    /// That of all cells \[degrees\].
    One(f64),
    /// Those of each cell \[degrees\].
    Each(Vec<f64>),
    /// Two components.
    Free,
}

impl<'a, 'py> FromPyObject<'a, 'py> for Rakes {
    type Error = PyErr;

    fn extract(given: Borrowed<'a, 'py, PyAny>) -> PyResult<Self> {
        if let Ok(name) = given.extract::<String>() {
            return match name.as_str() {
                "free" => Ok(Self::Free),
                _ => Err(argument("rake", "numbers or \"free\"", name)),
            };
        }
        match given.extract::<PerVertex>() {
            Ok(PerVertex::Uniform(rake)) => Ok(Self::One(rake)),
            Ok(PerVertex::Each(rakes)) => Ok(Self::Each(rakes)),
            _ => Err(wrong_type(
                "degrees, one or one per cell, or \"free\"",
                &given,
            )),
        }
    }
}

#[pymethods]
impl SurfaceFault {
    #[new]
    #[pyo3(signature = (cells, *, shear_modulus, shear_wave_speed, poisson_ratio=0.25, space="half", rake=Rakes::One(90.0)),
           text_signature = "(cells, *, shear_modulus, shear_wave_speed, poisson_ratio=0.25, space='half', rake=90.0)")]
    fn new(
        py: Python<'_>,
        #[pyo3(from_py_with = named)] cells: Py<Triangles>,
        #[pyo3(from_py_with = named)] shear_modulus: f64,
        #[pyo3(from_py_with = named)] shear_wave_speed: f64,
        #[pyo3(from_py_with = named)] poisson_ratio: f64,
        #[pyo3(from_py_with = named)] space: &str,
        #[pyo3(from_py_with = named)] rake: Rakes,
    ) -> PyResult<Self> {
        if !["half", "whole"].contains(&space) {
            return Err(argument("space", "\"half\" or \"whole\"", space));
        }
        let rock = Medium {
            shear_modulus,
            shear_wave_speed,
        };
        let made = || -> Result<Geometry, SurfaceError> {
            let cells = cells.get().cells.clone();
            let fault = if space == "half" {
                Fault::half_space(cells, rock, poisson_ratio)?
            } else {
                Fault::whole_space(cells, rock, poisson_ratio)?
            };
            Ok(match &rake {
                Rakes::One(rake) => Geometry::Surface(fault.with_rake(*rake)?),
                Rakes::Each(rakes) => Geometry::Surface(fault.with_rakes(rakes)?),
                Rakes::Free => Geometry::FreeSurface(fault),
            })
        };
        let geometry = made().map_err(|error| errors::surface(py, &error))?;
        Ok(Self {
            geometry,
            cells,
            shear_modulus,
            shear_wave_speed,
            poisson_ratio,
            space: space.to_owned(),
            rake,
        })
    }

    /// The rake, as given.
    #[getter]
    fn rake<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        match &self.rake {
            Rakes::One(rake) => rake.into_bound_py_any(py),
            Rakes::Each(rakes) => PyArray1::from_slice(py, rakes).into_bound_py_any(py),
            Rakes::Free => "free".into_bound_py_any(py),
        }
    }

    /// The centroids of cells [m], one row each: east, north, and up from the surface.
    #[getter]
    fn centers<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        into_rows(py, self.cells.get().cells.map(Vector3::from))
    }

    /// The part along slip of one velocity of the plate [m/s], east, north and up: a `plate_rate` for `simulation`, with two
    /// components for a free rake.
    #[pyo3(signature = (velocity))]
    fn along<'py>(
        &self,
        py: Python<'py>,
        #[pyo3(from_py_with = named)] velocity: [f64; 3],
    ) -> PyResult<Bound<'py, PyAny>> {
        match &self.geometry {
            Geometry::Surface(fault) => {
                let rates = fault.along(velocity);
                PyArray1::from_iter(py, rates.iter().map(|rate| rate[0])).into_bound_py_any(py)
            }
            Geometry::FreeSurface(fault) => {
                into_rows(py, fault.along(velocity))?.into_bound_py_any(py)
            }
            _ => Ok(py.None().into_bound(py)),
        }
    }

    /// The rake of one velocity of the plate, projected onto each cell [degrees].
    #[pyo3(signature = (velocity))]
    fn rakes_along<'py>(
        &self,
        py: Python<'py>,
        #[pyo3(from_py_with = named)] velocity: [f64; 3],
    ) -> Bound<'py, PyArray1<f64>> {
        let rakes = match &self.geometry {
            Geometry::Surface(fault) => fault.rakes_along(velocity),
            Geometry::FreeSurface(fault) => fault.rakes_along(velocity),
            _ => Vec::new(),
        };
        PyArray1::from_vec(py, rakes)
    }

    /// Points off the fault, at which its slip displaces and strains the rock. Axes: east, north and up.
    ///
    /// Args:
    ///     points: (x, y, z) [m], or (x, y) at z = 0, not on edges of cells; right beside the fault both sides differ by the
    ///         slip.
    #[pyo3(signature = (points))]
    fn receivers(
        slf: &Bound<'_, Self>,
        #[pyo3(from_py_with = named)] points: Points,
    ) -> PyResult<Receivers> {
        Receivers::of(slf.as_any(), &slf.get().geometry, points, None)
    }

    /// A simulation with friction on the fault; the arguments are those of `LineFault.simulation`, and those of
    /// `PlaneFault.simulation` for a free rake.
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
        text("SurfaceFault", &self.given(py)?)
    }

    fn _repr_html_(&self, py: Python<'_>) -> PyResult<String> {
        html("SurfaceFault", &self.given(py)?)
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Reduced<'py>> {
        reduced::<Self>(py, self.given(py)?)
    }
}

impl SurfaceFault {
    /// The arguments.
    fn given<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let given = fields!(py, self; cells, shear_modulus, shear_wave_speed, poisson_ratio, space);
        given.set_item("rake", self.rake(py)?)?;
        Ok(given)
    }
}

//! Faults that are planes.

use numpy::PyArray2;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use stickslip::bie::{Cells, KernelError, Medium, PlaneFault as Plane, Rectangles};

use super::cycle::FaultSimulation;
use super::geometry::Geometry;
use super::laws::Given;
use super::loading::Directed;
use super::per_cell::PerCell;
use super::receivers::Receivers;
use super::rows::Points;
use super::scene::{Arguments, simulation};
use crate::arguments::{named, wrong_type};
use crate::bodies::PerVertex;
use crate::errors::{self, argument};
use crate::fields::AnyField;
use crate::memory::{LINE_CELL, PAIR_DOWN_DIP, check_memory};
use crate::plain::{Reduced, fields, html, reduced, text};
use crate::view::into_rows;

/// A plane of rectangular cells, in a whole space or below a free surface. Cells are numbered along strike first: an array
/// per cell reshapes to `shape`, (cells down dip, cells along strike), and one of that shape is taken where values per cell
/// are asked for. Slip has a fixed rake, or two components.
///
/// Args:
///     along_strike, down_dip: positions of both ends [m]; down dip from the surface on.
///     cells: their numbers along strike and down dip.
///     shear_modulus: [Pa], > 0.
///     shear_wave_speed: [m/s], > 0.
///     poisson_ratio: > -1 and < 0.5.
///     space: "half" or "whole".
///     dip: from the horizontal [degrees], > 0 and <= 90, to the right of strike.
///     rake: of slip [degrees]: 0 left-lateral, 90 thrust, 180 right-lateral, -90 normal; or "free" for slip along the
///         shear stress, with two components: along strike (left-lateral) and up dip (thrust).
#[pyclass(frozen, module = "stickslip")]
pub(crate) struct PlaneFault {
    geometry: Geometry,
    #[pyo3(get)]
    along_strike: [f64; 2],
    #[pyo3(get)]
    down_dip: [f64; 2],
    #[pyo3(get)]
    cells: [usize; 2],
    #[pyo3(get)]
    shear_modulus: f64,
    #[pyo3(get)]
    shear_wave_speed: f64,
    #[pyo3(get)]
    poisson_ratio: f64,
    #[pyo3(get)]
    space: String,
    #[pyo3(get)]
    dip: f64,
    #[pyo3(get)]
    rake: Rake,
}

/// The rake of slip.
#[derive(Clone, IntoPyObject)]
enum Rake {
    /// Fixed \[degrees\].
    Degrees(f64),
    /// Free.
    Named(String),
}

impl<'a, 'py> FromPyObject<'a, 'py> for Rake {
    type Error = PyErr;

    fn extract(given: Borrowed<'a, 'py, PyAny>) -> PyResult<Self> {
        if let Ok(name) = given.extract() {
            return Ok(Self::Named(name));
        }
        let degrees = given.extract().map(Self::Degrees);
        degrees.map_err(|_| wrong_type("a number of degrees or \"free\"", &given))
    }
}

impl Rake {
    /// The number of components of slip.
    fn components(&self) -> PyResult<usize> {
        match self {
            Self::Degrees(_) => Ok(1),
            Self::Named(name) if name == "free" => Ok(2),
            Self::Named(name) => Err(argument("rake", "a number or \"free\"", name)),
        }
    }
}

#[pymethods]
impl PlaneFault {
    #[new]
    #[pyo3(signature = (along_strike, down_dip, cells, *, shear_modulus, shear_wave_speed, poisson_ratio=0.25,
                        space="half", dip=90.0, rake=Rake::Degrees(0.0)),
           text_signature = "(along_strike, down_dip, cells, *, shear_modulus, shear_wave_speed, poisson_ratio=0.25, space='half', dip=90.0, rake=0.0)")]
    #[expect(clippy::too_many_arguments, reason = "keywords in Python")]
    fn new(
        py: Python<'_>,
        #[pyo3(from_py_with = named)] along_strike: [f64; 2],
        #[pyo3(from_py_with = named)] down_dip: [f64; 2],
        #[pyo3(from_py_with = named)] cells: [usize; 2],
        #[pyo3(from_py_with = named)] shear_modulus: f64,
        #[pyo3(from_py_with = named)] shear_wave_speed: f64,
        #[pyo3(from_py_with = named)] poisson_ratio: f64,
        #[pyo3(from_py_with = named)] space: &str,
        #[pyo3(from_py_with = named)] dip: f64,
        #[pyo3(from_py_with = named)] rake: Rake,
    ) -> PyResult<Self> {
        if !["half", "whole"].contains(&space) {
            return Err(argument("space", "\"half\" or \"whole\"", space));
        }
        let rock = Medium {
            shear_modulus,
            shear_wave_speed,
        };
        let [columns, rows] = cells;
        let components = rake.components()?;
        check_memory("cells", &[columns, rows, components], LINE_CELL)?;
        if space == "half" {
            let counts = [columns, rows, rows, components, components];
            check_memory("cells", &counts, PAIR_DOWN_DIP)?;
        }
        let along = |name: &str, ends: [f64; 2], count: usize| {
            let cells = Cells::new(ends, count);
            cells.map_err(|error| errors::of_argument(py, name, errors::kernel(py, &error)))
        };
        let columns = along("along_strike", along_strike, columns)?;
        let rows = along("down_dip", down_dip, rows)?;
        let made = || -> Result<Geometry, KernelError> {
            let cells = Rectangles::new(columns, rows);
            let plane = if space == "half" {
                Plane::half_space(cells, dip, rock, poisson_ratio)?
            } else {
                Plane::whole_space(cells, rock, poisson_ratio)?
            };
            Ok(match &rake {
                Rake::Degrees(rake) => Geometry::Plane(plane.with_rake(*rake)?),
                Rake::Named(_) => Geometry::Free(plane),
            })
        };
        let geometry = made().map_err(|error| errors::kernel(py, &error))?;
        Ok(Self {
            geometry,
            along_strike,
            down_dip,
            cells,
            shear_modulus,
            shear_wave_speed,
            poisson_ratio,
            space: space.to_owned(),
            dip,
            rake,
        })
    }

    /// The numbers of cells down dip and along strike: arrays of this shape have a value per cell.
    #[getter]
    fn shape(&self) -> (usize, usize) {
        (self.cells[1], self.cells[0])
    }

    /// The centres of cells [m], one row each: along strike, and down dip.
    #[getter]
    fn centers<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        into_rows(py, self.geometry.centers())
    }

    /// Points off the fault, at which its slip displaces and strains the rock. Axes: x along strike, y horizontal to the left
    /// of it, z up; in a whole space y up dip, and z into the hanging wall.
    ///
    /// Args:
    ///     points: (x, y, z) [m], or (x, y) at z = 0, not on edges of cells; right beside the fault both sides differ by the
    ///         slip.
    ///     plate_rate: of the creep beyond the cells [m/s], with a free rake a pair, which histories of runs have, too; None
    ///         for none.
    #[pyo3(signature = (points, *, plate_rate=None))]
    fn receivers(
        slf: &Bound<'_, Self>,
        #[pyo3(from_py_with = named)] points: Points,
        #[pyo3(from_py_with = named)] plate_rate: Option<PerCell>,
    ) -> PyResult<Receivers> {
        Receivers::of(slf.as_any(), &slf.get().geometry, points, plate_rate)
    }

    /// A simulation with friction on the fault; the arguments are those of `LineFault.simulation`.
    ///
    /// With a free rake shear_stress, plate_rate, stress_rate, slip_rate and the value of overstress have two components,
    /// along strike and up dip: each is a pair, or an array with one pair per cell.
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
        text("PlaneFault", &self.given(py)?)
    }

    fn _repr_html_(&self, py: Python<'_>) -> PyResult<String> {
        html("PlaneFault", &self.given(py)?)
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Reduced<'py>> {
        reduced::<Self>(py, self.given(py)?)
    }
}

impl PlaneFault {
    /// The fault of the library.
    pub(super) fn geometry(&self) -> &Geometry {
        &self.geometry
    }

    /// \[Pa\].
    pub(super) fn shear_modulus(&self) -> f64 {
        self.shear_modulus
    }

    /// The arguments.
    fn given<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let given = fields!(py, self; along_strike, down_dip, cells, shear_modulus, shear_wave_speed, poisson_ratio, space, dip);
        given.set_item("rake", self.rake.clone())?;
        Ok(given)
    }
}

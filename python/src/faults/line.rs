//! Faults that are lines: in antiplane or plane strain, vertical or dipping.

use numpy::PyArray1;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use stickslip::bie::{Cells, DippingFault, Fault, KernelError, Medium, Mode, Sense};

use super::cycle::FaultSimulation;
use super::geometry::Geometry;
use super::laws::Given;
use super::loading::Directed;
use super::per_cell::PerCell;
use super::receivers::Receivers;
use super::rows::Points;
use super::scene::{Arguments, simulation};
use crate::arguments::named;
use crate::bodies::PerVertex;
use crate::errors::{self, argument};
use crate::fields::AnyField;
use crate::memory::{DIPPING_CELL, LINE_CELL, check_memory};
use crate::plain::{Reduced, fields, html, reduced, text};

/// A fault whose slip does not vary along one direction, in equal cells:
///
/// - without `poisson_ratio` in antiplane strain (strike slip), vertical below a free surface, in a whole space, or
///   periodic;
/// - with it in plane strain: in a whole space, periodic, or dipping below a free surface.
///
/// Args:
///     ends: positions of both ends [m]; below a free surface depths, or distances down dip.
///     cells: number of cells.
///     shear_modulus: [Pa], > 0.
///     shear_wave_speed: [m/s], > 0.
///     space: "half", "whole" or "periodic".
///     poisson_ratio: of plane strain, > -1 and < 0.5.
///     dip: from the horizontal [degrees], of plane strain in a half space; 90 by default.
///     sense: "thrust" or "normal", the positive sense of slip there.
#[pyclass(frozen, module = "stickslip")]
pub(crate) struct LineFault {
    geometry: Geometry,
    #[pyo3(get)]
    ends: [f64; 2],
    #[pyo3(get)]
    cells: usize,
    #[pyo3(get)]
    shear_modulus: f64,
    #[pyo3(get)]
    shear_wave_speed: f64,
    #[pyo3(get)]
    space: String,
    #[pyo3(get)]
    poisson_ratio: Option<f64>,
    #[pyo3(get)]
    dip: f64,
    #[pyo3(get)]
    sense: String,
}

#[pymethods]
impl LineFault {
    #[new]
    #[pyo3(signature = (ends, cells, *, shear_modulus, shear_wave_speed, space="half", poisson_ratio=None, dip=90.0,
                        sense="thrust"))]
    #[expect(clippy::too_many_arguments, reason = "keywords in Python")]
    fn new(
        py: Python<'_>,
        #[pyo3(from_py_with = named)] ends: [f64; 2],
        #[pyo3(from_py_with = named)] cells: usize,
        #[pyo3(from_py_with = named)] shear_modulus: f64,
        #[pyo3(from_py_with = named)] shear_wave_speed: f64,
        #[pyo3(from_py_with = named)] space: &str,
        #[pyo3(from_py_with = named)] poisson_ratio: Option<f64>,
        #[pyo3(from_py_with = named)] dip: f64,
        #[pyo3(from_py_with = named)] sense: &str,
    ) -> PyResult<Self> {
        let positive_sense = match sense {
            "thrust" => Sense::Thrust,
            "normal" => Sense::Normal,
            _ => return Err(argument("sense", "\"thrust\" or \"normal\"", sense)),
        };
        if !["half", "whole", "periodic"].contains(&space) {
            let names = "\"half\", \"whole\" or \"periodic\"";
            return Err(argument("space", names, space));
        }
        if dip != 90.0 && (space != "half" || poisson_ratio.is_none()) {
            let dips = "90 but in a half space with poisson_ratio";
            return Err(argument("dip", dips, dip));
        }
        let rock = Medium {
            shear_modulus,
            shear_wave_speed,
        };
        let bytes = match (space, poisson_ratio) {
            ("half", Some(_)) => DIPPING_CELL,
            _ => LINE_CELL,
        };
        check_memory("cells", &[cells], bytes)?;
        let along = Cells::new(ends, cells);
        let along =
            along.map_err(|error| errors::of_argument(py, "ends", errors::kernel(py, &error)))?;
        let made = || -> Result<Geometry, KernelError> {
            let cells = along;
            let mode = match poisson_ratio {
                Some(poisson_ratio) => Mode::InPlane { poisson_ratio },
                None => Mode::Antiplane,
            };
            Ok(match (space, poisson_ratio) {
                ("half", Some(ratio)) => {
                    Geometry::Dipping(DippingFault::new(cells, rock, ratio, dip, positive_sense)?)
                }
                ("half", None) => Geometry::Line(Fault::half_space(cells, rock)?),
                ("whole", _) => Geometry::Line(Fault::whole_space(cells, rock, mode)?),
                _ => Geometry::Line(Fault::periodic(cells, rock, mode)?),
            })
        };
        let geometry = made().map_err(|error| errors::kernel(py, &error))?;
        Ok(Self {
            geometry,
            ends,
            cells,
            shear_modulus,
            shear_wave_speed,
            space: space.to_owned(),
            poisson_ratio,
            dip,
            sense: sense.to_owned(),
        })
    }

    /// The centres of cells [m].
    #[getter]
    fn centers<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        PyArray1::from_iter(py, self.geometry.centers().iter().map(|x| x[0]))
    }

    /// Points off the fault, at which its slip displaces and strains the rock. Axes: x across the fault, with a dip from the
    /// trace towards the hanging wall; y along strike; z up. A vertical fault is at x = 0 and its positions are -z; slip is
    /// that of the side x > 0 along y, in plane strain up. Periodic faults have none.
    ///
    /// Args:
    ///     points: (x, z) or (x, y, z) [m], not at ends of cells; right beside the fault both sides differ by the slip.
    ///     plate_rate: of the creep beyond the cells [m/s], which histories of runs have, too; None for none.
    #[pyo3(signature = (points, *, plate_rate=None))]
    fn receivers(
        slf: &Bound<'_, Self>,
        #[pyo3(from_py_with = named)] points: Points,
        #[pyo3(from_py_with = named)] plate_rate: Option<PerCell>,
    ) -> PyResult<Receivers> {
        Receivers::of(slf.as_any(), &slf.get().geometry, points, plate_rate)
    }

    /// A simulation with rate- and state-dependent friction on the fault, regularised by asinh, and radiation damping.
    ///
    /// Args, each a number or one per cell:
    ///     a, b, Dc, mu0, V0: parameters of friction.
    ///     normal_stress: [Pa], positive in compression.
    ///     shear_stress: at time 0 [Pa].
    ///     theta: state at time 0 [s], > 0; or log_theta, its natural logarithm.
    ///     slip_rate: at time 0 [m/s], in balance with shear_stress; by default that in balance.
    ///     plate_rate: of the creep beyond the fault [m/s]. Its cells are loaded by back slip: those that all slip at their
    ///         plate rates keep their stress.
    ///     stress_rate: of shear stress [Pa/s].
    ///     alpha: of Linker and Dieterich, >= 0: a change of the normal stress sigma changes the state such that friction
    ///         changes by -alpha d(ln sigma) at once; b must be positive there.
    /// Further args:
    ///     friction: "regularized", or a law of your own as of SpringSlider, or a list of laws with one per cell.
    ///     law: "aging", "slip", or a law of your own as of SpringSlider, or a list of laws with one per cell. With both laws
    ///         of your own a, b and Dc are not needed. Laws of your own are computed cell by cell.
    ///     allow_opening: whether cells under tension open; else tension is an error.
    ///     pressure: of a fluid [Pa], a function of time [s] that returns a number or one per cell. It lowers the normal
    ///         stress, and is called several times a step.
    ///     overstress: shear stress [Pa] that adds to all others, a function of time [s] likewise: a transient load, or one
    ///         that nucleates an event.
    ///     fields: of heat and fluids on the fault: ThermalPressurization, ShearHeating, Diffusion. Their pressures add, and
    ///         lower the normal stress that friction sees. Pressure beyond the normal stress is an error, unless
    ///         allow_opening or least_normal_stress takes it.
    ///     least_normal_stress: that friction sees at least [Pa], > 0.
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
        text("LineFault", &self.given(py)?)
    }

    fn _repr_html_(&self, py: Python<'_>) -> PyResult<String> {
        html("LineFault", &self.given(py)?)
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Reduced<'py>> {
        reduced::<Self>(py, self.given(py)?)
    }
}

impl LineFault {
    /// The arguments.
    fn given<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        Ok(
            fields!(py, self; ends, cells, shear_modulus, shear_wave_speed, space, poisson_ratio, dip, sense),
        )
    }
}

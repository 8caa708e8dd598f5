//! Simulations of faults from the arguments of Python.

use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use stickslip::Snapshot;
use stickslip::integrate::Stepper;
use stickslip::nalgebra::SVector;
use stickslip::state::{LogTheta, Theta};

use super::cycle::{FaultSimulation, Motion};
use super::friction::CellFriction;
use super::function::CellFunction;
use super::geometry::{Built, Geometry, dipping, line, plane, segments, surface, system};
use super::laws::Given;
use super::loading::{Directed, Loading};
use crate::arguments::positive;
use crate::bodies::PerVertex;
use crate::errors::{self, argument};
use crate::exit::Call;
use crate::fields::{AnyField, Cells, Fields};
use crate::raised::Raised;

/// The arguments of a simulation.
pub(super) struct Arguments<'py> {
    pub(super) laws: Given<'py>,
    pub(super) directed: Directed,
    pub(super) normal_stress: PerVertex,
    pub(super) theta: Option<PerVertex>,
    pub(super) log_theta: Option<PerVertex>,
    pub(super) alpha: Option<PerVertex>,
    pub(super) allow_opening: bool,
    pub(super) pressure: Option<Py<PyAny>>,
    pub(super) fields: Vec<AnyField>,
    pub(super) least_normal_stress: Option<f64>,
}

/// A simulation of a fault in rock of this shear modulus \[Pa\].
pub(super) fn simulation(
    py: Python<'_>,
    (geometry, shear_modulus): (&Geometry, f64),
    given: Arguments<'_>,
) -> PyResult<FaultSimulation> {
    let raised = Raised::default();
    let at = (py, &raised, geometry.cells());
    let motion = match geometry {
        Geometry::Line(fault) => Motion::One(built(at, given, |l, f| line(fault, l, f))?, None),
        Geometry::Dipping(fault) => {
            Motion::One(built(at, given, |l, f| dipping(fault, l, f))?, None)
        }
        Geometry::Plane(fault) => Motion::One(built(at, given, |l, f| plane(fault, l, f))?, None),
        Geometry::Free(fault) => Motion::Two(built(at, given, |l, f| plane(fault, l, f))?, None),
        Geometry::Planes(planes) => {
            Motion::One(built(at, given, |l, f| system(planes, l, f))?, None)
        }
        Geometry::FreePlanes(planes) => {
            Motion::Two(built(at, given, |l, f| system(planes, l, f))?, None)
        }
        Geometry::Segments(fault) => {
            Motion::One(built(at, given, |l, f| segments(fault, l, f))?, None)
        }
        Geometry::Surface(fault) => {
            Motion::One(built(at, given, |l, f| surface(fault, l, f))?, None)
        }
        Geometry::FreeSurface(fault) => {
            Motion::Two(built(at, given, |l, f| surface(fault, l, f))?, None)
        }
    };
    Ok(FaultSimulation::new(
        motion,
        (shear_modulus, geometry.directions()),
        raised,
    ))
}

/// The motion of so many cells, built without the interpreter's lock.
fn built<const C: usize>(
    (py, raised, fault): (Python<'_>, &Raised, Cells),
    given: Arguments<'_>,
    build: impl FnOnce(Loading<C>, CellFriction<C>) -> Built<C> + Send,
) -> PyResult<Box<dyn Stepper<C>>> {
    let call = Call::begin()?;
    let layout = fault.layout;
    let (cells, flat) = (layout.count, |values| layout.flat(values));
    let any = |name: &str, values: PerVertex| values.checked(name, cells, "finite", f64::is_finite);
    let laws = given.laws.flat(layout);
    let effect = laws.normal_stress_effect(given.alpha.map(flat), cells)?;
    let laws = laws.laws(cells, raised)?;
    let states = states(given.theta.map(flat), given.log_theta.map(flat), cells)?;
    let (shear_stress, loading) = given.directed.checked(py, layout, raised)?;
    let norm = |stress: &SVector<f64, C>| stress.norm();
    let stresses: Option<Vec<f64>> =
        (!loading.has_rates()).then(|| shear_stress.iter().map(norm).collect());
    let least = given.least_normal_stress;
    if let (Some(stress), true) = (least, given.allow_opening) {
        let requirement = "None with allow_opening, which takes 0";
        return Err(argument("least_normal_stress", requirement, stress));
    }
    let least = least.map(|stress| positive("least_normal_stress", stress));
    let friction = CellFriction {
        laws,
        effect,
        states,
        normal_stress: any("normal_stress", flat(given.normal_stress))?,
        shear_stress,
        opens: given.allow_opening,
        pressure: CellFunction::given(py, "pressure", given.pressure, layout, raised)?,
        fields: Fields::on(&given.fields, &fault)?,
        least_stress: least.transpose()?,
    };
    let stepper = call.detach(py, || build(loading, friction));
    if let Some(error) = raised.take() {
        return Err(error);
    }
    let stepper = stepper.map_err(|error| errors::scene(py, &error))?;
    if let Some(stresses) = stresses {
        warn_of_seismic_start(py, &stepper.snapshot(), &stresses)?;
    }
    Ok(stepper)
}

/// The slip rate [m/s] at which a start is seismic: that at which events begin by default.
const SEISMIC: f64 = 1e-2;

/// Warns of a start at a seismic slip rate in balance with these shear stresses \[Pa\], which mistaken units are a cause of.
fn warn_of_seismic_start<const C: usize>(
    py: Python<'_>,
    at: &Snapshot<'_, C>,
    stresses: &[f64],
) -> PyResult<()> {
    let contact = at.contact(0);
    let rates = (0..contact.len()).map(|k| contact.slip_rate(k));
    let Some((cell, rate)) = rates.enumerate().max_by(|a, b| a.1.total_cmp(&b.1)) else {
        return Ok(());
    };
    if rate < SEISMIC {
        return Ok(());
    }
    let message = format!(
        "the fault starts at a seismic slip rate, {rate:.3e} m/s in cell {cell}, where a shear stress of {:.4e} Pa exceeds \
         the strength under a normal stress of {:.4e} Pa: check the units of shear_stress and normal_stress [Pa] and of \
         theta [s], or give slip_rate",
        stresses[cell],
        contact.normal_stress(cell)
    );
    py.import("warnings")?.call_method1("warn", (message,))?;
    Ok(())
}

/// The initial states, from one of two arguments.
fn states(
    theta: Option<PerVertex>,
    log_theta: Option<PerVertex>,
    cells: usize,
) -> PyResult<Vec<LogTheta>> {
    match (theta, log_theta) {
        (Some(theta), None) => {
            let legal = |x: f64| x > 0.0 && x.is_finite();
            let states = theta.checked("theta", cells, "finite and positive", legal)?;
            Ok(states
                .into_iter()
                .map(|theta| Theta(theta).into())
                .collect())
        }
        (None, Some(states)) => {
            let states = states.checked("log_theta", cells, "finite", f64::is_finite)?;
            Ok(states.into_iter().map(LogTheta).collect())
        }
        _ => {
            let message = "give theta or log_theta, one of them";
            Err(PyValueError::new_err(message))
        }
    }
}

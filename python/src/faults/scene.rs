//! Simulations of faults from the arguments of Python.

use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use stickslip::integrate::Stepper;
use stickslip::state::{LogTheta, Theta};

use super::cycle::{FaultSimulation, Motion};
use super::friction::CellFriction;
use super::function::CellFunction;
use super::geometry::{Built, Geometry, dipping, line, plane};
use super::laws::Given;
use super::loading::{Directed, Loading};
use crate::bodies::PerVertex;
use crate::errors;
use crate::exit::Call;
use crate::raised::Raised;

/// The arguments of a simulation.
pub(super) struct Arguments<'py> {
    pub(super) laws: Given<'py>,
    pub(super) directed: Directed,
    pub(super) normal_stress: PerVertex,
    pub(super) theta: Option<PerVertex>,
    pub(super) log_theta: Option<PerVertex>,
    pub(super) allow_opening: bool,
    pub(super) pressure: Option<Py<PyAny>>,
}

/// A simulation of a fault in rock of this shear modulus \[Pa\].
pub(super) fn simulation(
    py: Python<'_>,
    (geometry, shear_modulus): (&Geometry, f64),
    given: Arguments<'_>,
) -> PyResult<FaultSimulation> {
    let raised = Raised::default();
    let at = (py, &raised, geometry.count());
    let motion = match geometry {
        Geometry::Line(fault) => Motion::One(built(at, given, |l, f| line(fault, l, f))?, None),
        Geometry::Dipping(fault) => {
            Motion::One(built(at, given, |l, f| dipping(fault, l, f))?, None)
        }
        Geometry::Plane(fault) => Motion::One(built(at, given, |l, f| plane(fault, l, f))?, None),
        Geometry::Free(fault) => Motion::Two(built(at, given, |l, f| plane(fault, l, f))?, None),
    };
    Ok(FaultSimulation::new(
        motion,
        (shear_modulus, geometry.directions()),
        raised,
    ))
}

/// The motion of so many cells, built without the interpreter's lock.
fn built<const C: usize>(
    (py, raised, cells): (Python<'_>, &Raised, usize),
    given: Arguments<'_>,
    build: impl FnOnce(Loading<C>, CellFriction<C>) -> Built<C> + Send,
) -> PyResult<Box<dyn Stepper<C>>> {
    let call = Call::begin()?;
    let any = |name: &str, values: PerVertex| values.checked(name, cells, "finite", f64::is_finite);
    let laws = given.laws.laws(cells, raised)?;
    let states = states(given.theta, given.log_theta, cells)?;
    let (shear_stress, loading) = given.directed.checked(py, cells, raised)?;
    let friction = CellFriction {
        laws,
        states,
        normal_stress: any("normal_stress", given.normal_stress)?,
        shear_stress,
        opens: given.allow_opening,
        pressure: CellFunction::given(py, "pressure", given.pressure, raised)?,
    };
    let stepper = call.detach(py, || build(loading, friction));
    if let Some(error) = raised.take() {
        return Err(error);
    }
    stepper.map_err(|error| errors::scene(py, &error))
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

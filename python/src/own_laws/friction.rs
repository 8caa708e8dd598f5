//! Friction laws of the user.

use pyo3::prelude::*;
use stickslip::friction::{FrictionLaw, check_friction_law};
use stickslip::state::{LogTheta, Theta};

use super::{CompiledFriction, Function, STATES};
use crate::errors;
use crate::plain::helper;
use crate::raised::Raised;

/// A law of three functions of slip rate [m/s] and state [s].
#[derive(Clone)]
pub(crate) struct OwnFriction {
    coefficient: Function,
    slope: Function,
    potential: Function,
}

impl OwnFriction {
    /// The law of an object, the argument of a name, checked at some states and slip rates when it is
    /// seen first.
    pub(crate) fn new(name: &str, object: &Bound<'_, PyAny>) -> PyResult<Self> {
        let raised = Raised::default();
        let [coefficient, slope, potential] = match object.cast::<CompiledFriction>() {
            Ok(compiled) => compiled.get().functions(),
            Err(_) => {
                let method = |method| Function::method((name, object), method, &raised);
                [
                    method("coefficient")?,
                    method("slope")?,
                    method("potential")?,
                ]
            }
        };
        let law = Self {
            coefficient,
            slope,
            potential,
        };
        let py = object.py();
        if helper(py, "_laws", "is_checked", ("friction", object))?.is_truthy()? {
            return Ok(law);
        }
        let checked = check_friction_law(&law, &STATES);
        if let Some(error) = raised.take() {
            return Err(error);
        }
        checked
            .map_err(|violation| errors::of_argument(py, name, errors::friction(py, &violation)))?;
        helper(py, "_laws", "check", ("friction", object))?;
        Ok(law)
    }

    /// The law with the exceptions of its methods kept by a simulation.
    pub(crate) fn reporting_to(&self, raised: &Raised) -> Self {
        Self {
            coefficient: self.coefficient.reporting_to(raised),
            slope: self.slope.reporting_to(raised),
            potential: self.potential.reporting_to(raised),
        }
    }
}

impl FrictionLaw for OwnFriction {
    type State = LogTheta;

    fn coefficient(&self, slip_rate: f64, state: LogTheta) -> f64 {
        self.coefficient.value(slip_rate, Theta::from(state).0)
    }

    fn coefficient_rate_slope(&self, slip_rate: f64, state: LogTheta) -> f64 {
        self.slope.value(slip_rate, Theta::from(state).0)
    }

    fn potential(&self, slip_rate: f64, state: LogTheta) -> f64 {
        self.potential.value(slip_rate, Theta::from(state).0)
    }
}

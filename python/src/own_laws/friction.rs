//! Friction laws of the user.

use std::sync::{Arc, Mutex};

use pyo3::prelude::*;
use stickslip::friction::{FrictionLaw, check_friction_law};
use stickslip::state::{LogTheta, Theta};

use super::{CompiledFriction, Function, STATES, raised};
use crate::errors;

/// A law of three functions of slip rate [m/s] and state [s].
#[derive(Clone)]
pub(crate) struct OwnFriction {
    coefficient: Function,
    slope: Function,
    potential: Function,
    /// The exception of a method of Python.
    pub(crate) raised: Option<Arc<Mutex<Option<PyErr>>>>,
}

impl OwnFriction {
    /// The law of an object, checked at some states and slip rates.
    pub(crate) fn new(object: &Bound<'_, PyAny>) -> PyResult<Self> {
        let law = match object.cast::<CompiledFriction>() {
            Ok(compiled) => {
                let [coefficient, slope, potential] = compiled.get().functions();
                Self {
                    coefficient,
                    slope,
                    potential,
                    raised: None,
                }
            }
            Err(_) => {
                let slot = Arc::new(Mutex::new(None));
                let method = |name| Function::method(object, name, &slot);
                Self {
                    coefficient: method("coefficient")?,
                    slope: method("slope")?,
                    potential: method("potential")?,
                    raised: Some(Arc::clone(&slot)),
                }
            }
        };
        let checked = check_friction_law(&law, &STATES);
        match raised(&law.raised) {
            Some(error) => Err(error),
            None => checked
                .map(|()| law)
                .map_err(|violation| errors::friction(object.py(), &violation)),
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

//! State laws of the user.

use std::sync::{Arc, Mutex};

use pyo3::prelude::*;
use stickslip::state::{LogTheta, StateLaw, check_state_law};

use super::{CompiledState, Function, STATES, raised};
use crate::errors;

/// A law of two functions of the state [s] and the slip rate [m/s], in the logarithm of the state:
/// `alpha' = rate/theta` with `alpha = ln(theta / 1 s)`.
#[derive(Clone)]
pub(crate) struct OwnState {
    rate: Function,
    slope: Function,
    /// The exception of a method of Python.
    pub(crate) raised: Option<Arc<Mutex<Option<PyErr>>>>,
}

impl OwnState {
    /// The law of an object, checked at some states and slip rates.
    pub(crate) fn new(object: &Bound<'_, PyAny>) -> PyResult<Self> {
        let law = match object.cast::<CompiledState>() {
            Ok(compiled) => {
                let [rate, slope] = compiled.get().functions();
                Self {
                    rate,
                    slope,
                    raised: None,
                }
            }
            Err(_) => {
                let slot = Arc::new(Mutex::new(None));
                let method = |name| Function::method(object, name, &slot);
                Self {
                    rate: method("rate")?,
                    slope: method("slope")?,
                    raised: Some(Arc::clone(&slot)),
                }
            }
        };
        let checked = check_state_law(&law, &STATES);
        match raised(&law.raised) {
            Some(error) => Err(error),
            None => checked
                .map(|()| law)
                .map_err(|violation| errors::state_law(object.py(), &violation)),
        }
    }
}

impl StateLaw for OwnState {
    type State = LogTheta;

    fn evolution(&self, LogTheta(alpha): LogTheta, slip_rate: f64) -> f64 {
        let theta = alpha.exp();
        self.rate.value(theta, slip_rate) / theta
    }

    fn evolution_state_slope(&self, LogTheta(alpha): LogTheta, slip_rate: f64) -> f64 {
        let theta = alpha.exp();
        let slope = self.slope.value(theta, slip_rate);
        let rate = self.rate.value(theta, slip_rate) / theta;
        // Both can be far larger than their difference, which then is rounding.
        let rounding = 4.0 * f64::EPSILON * (slope.abs() + rate.abs());
        let difference = slope - rate;
        if difference.abs() <= rounding {
            0.0
        } else {
            difference
        }
    }
}

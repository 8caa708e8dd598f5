//! State laws of the user.

use pyo3::prelude::*;
use stickslip::state::{LogTheta, StateLaw, check_state_law};

use super::{CompiledState, Function, STATES};
use crate::errors;
use crate::plain::helper;
use crate::raised::Raised;

/// A law of two functions of the state [s] and the slip rate [m/s], in the logarithm of the state:
/// `alpha' = rate/theta` with `alpha = ln(theta / 1 s)`.
#[derive(Clone)]
pub(crate) struct OwnState {
    rate: Function,
    slope: Function,
}

impl OwnState {
    /// The law of an object, the argument of a name, checked at some states and slip rates when it is
    /// seen first.
    pub(crate) fn new(name: &str, object: &Bound<'_, PyAny>) -> PyResult<Self> {
        let raised = Raised::default();
        let [rate, slope] = match object.cast::<CompiledState>() {
            Ok(compiled) => compiled.get().functions(),
            Err(_) => {
                let method = |method| Function::method((name, object), method, &raised);
                [method("rate")?, method("slope")?]
            }
        };
        let law = Self { rate, slope };
        let py = object.py();
        if helper(py, "_laws", "is_checked", ("state", object))?.is_truthy()? {
            return Ok(law);
        }
        let checked = check_state_law(&law, &STATES);
        if let Some(error) = raised.take() {
            return Err(error);
        }
        checked.map_err(|violation| {
            errors::of_argument(py, name, errors::state_law(py, &violation))
        })?;
        helper(py, "_laws", "check", ("state", object))?;
        Ok(law)
    }

    /// The law with the exceptions of its methods kept by a simulation.
    pub(crate) fn reporting_to(&self, raised: &Raised) -> Self {
        Self {
            rate: self.rate.reporting_to(raised),
            slope: self.slope.reporting_to(raised),
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

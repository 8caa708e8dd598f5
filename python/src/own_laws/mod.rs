//! Friction and state laws of the user: objects of Python, and compiled functions.

mod compiled;
mod friction;
mod state;

pub(crate) use compiled::{CompiledFriction, CompiledState};
pub(crate) use friction::OwnFriction;
pub(crate) use state::OwnState;

use std::sync::Arc;

use pyo3::exceptions::PyAttributeError;
use pyo3::prelude::*;
use stickslip::state::LogTheta;

use crate::exit::attached;
use crate::raised::Raised;

/// The states at which a law is checked: 45 us, 1 s and 6 h.
pub(crate) const STATES: [LogTheta; 3] = [LogTheta(-10.0), LogTheta(0.0), LogTheta(10.0)];

/// A function of two numbers: of Python, or compiled.
#[derive(Clone)]
pub(crate) enum Function {
    /// A method of Python, whose exception is kept; values are then NaN.
    Python(Arc<Py<PyAny>>, Raised),
    /// `double f(double, double)`.
    Compiled {
        function: extern "C" fn(f64, f64) -> f64,
        /// The object that keeps the code loaded.
        _code: Arc<Py<PyAny>>,
    },
}

impl Function {
    /// The method of an object, which is the argument of a name.
    pub(crate) fn method(
        (argument, object): (&str, &Bound<'_, PyAny>),
        name: &str,
        raised: &Raised,
    ) -> PyResult<Self> {
        let method = object.getattr(name).map_err(|error| {
            let message = format!("{argument}: {}", error.value(object.py()));
            PyAttributeError::new_err(message)
        })?;
        Ok(Self::Python(Arc::new(method.unbind()), raised.clone()))
    }

    /// The function with its exceptions kept elsewhere.
    pub(crate) fn reporting_to(&self, raised: &Raised) -> Self {
        match self {
            Self::Python(function, _) => Self::Python(Arc::clone(function), raised.clone()),
            compiled => compiled.clone(),
        }
    }

    /// Its value.
    pub(crate) fn value(&self, x: f64, y: f64) -> f64 {
        match self {
            Self::Compiled { function, .. } => function(x, y),
            Self::Python(_, raised) if raised.is_set() => f64::NAN,
            Self::Python(function, raised) => {
                let value = attached(|py| function.bind(py).call1((x, y))?.extract::<f64>());
                value.unwrap_or_else(|error| {
                    raised.keep(error);
                    f64::NAN
                })
            }
        }
    }
}

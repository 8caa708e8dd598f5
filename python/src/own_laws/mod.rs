//! Friction and state laws of the user: objects of Python, and compiled functions.

mod compiled;
mod friction;
mod state;

pub(crate) use compiled::{CompiledFriction, CompiledState};
pub(crate) use friction::OwnFriction;
pub(crate) use state::OwnState;

use std::sync::{Arc, Mutex};

use pyo3::prelude::*;
use stickslip::state::LogTheta;

use crate::exit::attached;

/// The states at which a law is checked: 45 us, 1 s and 6 h.
pub(crate) const STATES: [LogTheta; 3] = [LogTheta(-10.0), LogTheta(0.0), LogTheta(10.0)];

/// A function of two numbers: of Python, or compiled.
#[derive(Clone)]
pub(crate) enum Function {
    /// A method of Python, whose first exception is kept; the value is then NaN.
    Python(Arc<Py<PyAny>>, Arc<Mutex<Option<PyErr>>>),
    /// `double f(double, double)`.
    Compiled {
        function: extern "C" fn(f64, f64) -> f64,
        /// The object that keeps the code loaded.
        _code: Arc<Py<PyAny>>,
    },
}

impl Function {
    /// The method of an object.
    pub(crate) fn method(
        object: &Bound<'_, PyAny>,
        name: &str,
        raised: &Arc<Mutex<Option<PyErr>>>,
    ) -> PyResult<Self> {
        let method = object.getattr(name)?;
        Ok(Self::Python(Arc::new(method.unbind()), Arc::clone(raised)))
    }

    /// Its value.
    pub(crate) fn value(&self, x: f64, y: f64) -> f64 {
        match self {
            Self::Compiled { function, .. } => function(x, y),
            Self::Python(function, raised) => {
                let value = attached(|py| function.bind(py).call1((x, y))?.extract::<f64>());
                value.unwrap_or_else(|error| {
                    if let Ok(mut raised) = raised.lock() {
                        raised.get_or_insert(error);
                    }
                    f64::NAN
                })
            }
        }
    }
}

/// The exception that a law has raised.
pub(crate) fn raised(slot: &Option<Arc<Mutex<Option<PyErr>>>>) -> Option<PyErr> {
    slot.as_ref()?.lock().ok()?.take()
}

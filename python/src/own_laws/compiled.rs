//! Laws of compiled functions.
#![allow(unsafe_code)]

use std::sync::Arc;

use pyo3::prelude::*;

use super::Function;
use crate::errors::argument;

/// A friction law of compiled functions, at full speed.
///
/// Each is a `double f(double slip_rate, double theta)` that any thread can call: a cfunc of numba, or a function of
/// ctypes with `restype = c_double` and `argtypes = (c_double, c_double)`.
///
/// Args:
///     coefficient: of friction.
///     slope: its derivative in the slip rate [s/m].
///     potential: its integral over the slip rate from 0 [m/s].
#[pyclass(frozen, weakref, module = "stickslip")]
pub(crate) struct CompiledFriction {
    functions: [Function; 3],
}

#[pymethods]
impl CompiledFriction {
    #[new]
    #[pyo3(signature = (*, coefficient, slope, potential))]
    fn new(
        coefficient: &Bound<'_, PyAny>,
        slope: &Bound<'_, PyAny>,
        potential: &Bound<'_, PyAny>,
    ) -> PyResult<Self> {
        Ok(Self {
            functions: [
                compiled("coefficient", coefficient)?,
                compiled("slope", slope)?,
                compiled("potential", potential)?,
            ],
        })
    }
}

impl CompiledFriction {
    pub(super) fn functions(&self) -> [Function; 3] {
        self.functions.clone()
    }
}

/// A state law of compiled functions, at full speed; functions as of CompiledFriction.
///
/// Args:
///     rate: `double f(double theta, double slip_rate)`, the rate of the state.
///     slope: its derivative in the state [1/s], not positive.
#[pyclass(frozen, weakref, module = "stickslip")]
pub(crate) struct CompiledState {
    functions: [Function; 2],
}

#[pymethods]
impl CompiledState {
    #[new]
    #[pyo3(signature = (*, rate, slope))]
    fn new(rate: &Bound<'_, PyAny>, slope: &Bound<'_, PyAny>) -> PyResult<Self> {
        Ok(Self {
            functions: [compiled("rate", rate)?, compiled("slope", slope)?],
        })
    }
}

impl CompiledState {
    pub(super) fn functions(&self) -> [Function; 2] {
        self.functions.clone()
    }
}

/// The function of an object of ctypes or numba that is declared as `double f(double, double)`.
fn compiled(name: &str, given: &Bound<'_, PyAny>) -> PyResult<Function> {
    let py = given.py();
    let ctypes = py.import("ctypes")?;
    // A cfunc of numba has its function of ctypes in this attribute.
    let function = given.getattr("ctypes").unwrap_or_else(|_| given.clone());
    let requirement =
        "a function of ctypes with restype and argtypes of c_double, or a cfunc of numba";
    let refused = || Err(argument(name, requirement, given.repr()?.to_string()));
    if !function.is_instance(&ctypes.getattr("_CFuncPtr")?)? {
        return refused();
    }
    let double = ctypes.getattr("c_double")?;
    let arguments = function.getattr("argtypes")?;
    let declared = function.getattr("restype")?.is(&double) && arguments.eq((&double, &double))?;
    let pointer = ctypes.call_method1("cast", (&function, ctypes.getattr("c_void_p")?))?;
    let address: Option<usize> = pointer.getattr("value")?.extract()?;
    let Some(address) = address.filter(|_| declared) else {
        return refused();
    };
    // SAFETY: ctypes declares the address as that of a C function `double (double, double)`, it is not null, and the
    // object keeps the code loaded. That the code is as declared is up to its author, as for each call by ctypes.
    let function = unsafe { std::mem::transmute::<usize, extern "C" fn(f64, f64) -> f64>(address) };
    Ok(Function::Compiled {
        function,
        _code: Arc::new(given.clone().unbind()),
    })
}

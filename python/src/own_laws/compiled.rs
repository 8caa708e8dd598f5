//! Laws of compiled functions, by their addresses.
#![allow(unsafe_code)]

use pyo3::prelude::*;

use super::Function;
use crate::errors::argument;

/// A friction law of compiled functions, at full speed.
///
/// Each is the address of `double f(double slip_rate, double theta)`: an integer, or an object with an `address` as
/// numba's cfunc has. Whoever gives an address vouches for it: it must be that of such a function, be safe to call from
/// any thread, and live as long as the law. Keep a reference to numba's cfunc.
///
/// Args:
///     coefficient: of friction.
///     slope: its derivative in the slip rate [s/m].
///     potential: its integral over the slip rate from 0 [m/s].
#[pyclass(frozen, module = "stickslip")]
pub(crate) struct CompiledFriction {
    functions: [Function; 3],
    /// What the addresses belong to.
    _owners: [Py<PyAny>; 3],
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
            _owners: [coefficient, slope, potential].map(|owner| owner.clone().unbind()),
        })
    }
}

impl CompiledFriction {
    pub(super) fn functions(&self) -> [Function; 3] {
        self.functions.clone()
    }
}

/// A state law of compiled functions, at full speed; the addresses as of CompiledFriction.
///
/// Args:
///     rate: `double f(double theta, double slip_rate)`, the rate of the state.
///     slope: its derivative in the state [1/s], not positive.
#[pyclass(frozen, module = "stickslip")]
pub(crate) struct CompiledState {
    functions: [Function; 2],
    /// What the addresses belong to.
    _owners: [Py<PyAny>; 2],
}

#[pymethods]
impl CompiledState {
    #[new]
    #[pyo3(signature = (*, rate, slope))]
    fn new(rate: &Bound<'_, PyAny>, slope: &Bound<'_, PyAny>) -> PyResult<Self> {
        Ok(Self {
            functions: [compiled("rate", rate)?, compiled("slope", slope)?],
            _owners: [rate, slope].map(|owner| owner.clone().unbind()),
        })
    }
}

impl CompiledState {
    pub(super) fn functions(&self) -> [Function; 2] {
        self.functions.clone()
    }
}

/// The function at an address.
fn compiled(name: &str, given: &Bound<'_, PyAny>) -> PyResult<Function> {
    let address = given.getattr("address").unwrap_or_else(|_| given.clone());
    let address: usize = address.extract().unwrap_or(0);
    if address == 0 {
        let requirement = "the address of a compiled function, or have one";
        return Err(argument(name, requirement, given.repr()?.to_string()));
    }
    // SAFETY: the caller vouches for the address, as the class says: a `double f(double, double)` that can be called from
    // any thread and outlives the law, whose owner is kept beside it. It is not null.
    let function = unsafe { std::mem::transmute::<usize, extern "C" fn(f64, f64) -> f64>(address) };
    Ok(Function::Compiled(function))
}

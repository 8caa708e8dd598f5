//! Signals during a fit.

use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

use pyo3::prelude::*;

use crate::exit::{Call, attached, leaving, thread_ends};

/// The time between looks for signals, short for a hand at the keyboard.
const PATIENCE: Duration = Duration::from_millis(50);

/// Looks for signals from within a fit.
pub(super) struct Watch {
    looked: Mutex<Instant>,
    raised: Mutex<Option<PyErr>>,
}

impl Watch {
    pub(super) fn new() -> Self {
        Self {
            looked: Mutex::new(Instant::now()),
            raised: Mutex::new(None),
        }
    }

    /// Whether a signal has raised an exception, or the interpreter exits.
    fn ends(&self) -> bool {
        if leaving() {
            return true;
        }
        let mut looked = self.looked.lock().unwrap_or_else(PoisonError::into_inner);
        if looked.elapsed() < PATIENCE {
            return false;
        }
        *looked = Instant::now();
        match attached(|py| py.check_signals()) {
            Ok(()) => false,
            Err(error) => {
                let mut raised = self.raised.lock().unwrap_or_else(PoisonError::into_inner);
                *raised = Some(error);
                true
            }
        }
    }

    /// Works without the interpreter's lock; `work` asks the function that it is given whether to end.
    ///
    /// An exception of a signal has what there is as its attribute `partial`: the result, or None.
    pub(super) fn run<T: Send, E: Send, P>(
        &self,
        py: Python<'_>,
        work: impl FnOnce(&(dyn Fn() -> bool + Sync)) -> Result<T, E> + Send,
        made: impl Fn(Result<T, E>) -> PyResult<P>,
    ) -> PyResult<P>
    where
        P: for<'py> IntoPyObject<'py>,
    {
        let call = Call::begin()?;
        let result = call.detach(py, || work(&|| self.ends()));
        let mut raised = self.raised.lock().unwrap_or_else(PoisonError::into_inner);
        let Some(error) = raised.take() else {
            if leaving() {
                return Err(thread_ends());
            }
            return made(result);
        };
        let partial = made(result).ok();
        error.value(py).setattr("partial", partial)?;
        Err(error)
    }
}

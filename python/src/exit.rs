//! The end of the interpreter while threads run simulations: daemon threads.
//!
//! A thread that takes the interpreter's lock while that is finalised ends at that point, below frames of Rust, and the
//! process aborts. So a hook of `atexit` asks all runs to end, and waits until their threads are back in Python.

use std::cell::Cell;
use std::process;
use std::sync::atomic::{AtomicBool, AtomicU32, AtomicUsize, Ordering::SeqCst};
use std::thread;
use std::time::{Duration, Instant};

use pyo3::exceptions::PySystemExit;
use pyo3::prelude::*;

/// The longest wait for runs: steps of large bodies, and functions of the user, can take longer.
const PATIENCE: Duration = Duration::from_secs(5);
/// The time between two looks.
const PAUSE: Duration = Duration::from_millis(1);

/// Whether the interpreter exits.
static EXITING: AtomicBool = AtomicBool::new(false);
/// Whether no thread may take the interpreter's lock any more.
static CLOSED: AtomicBool = AtomicBool::new(false);
/// The number of calls in progress, and their process: a child has its own.
static CALLS: AtomicUsize = AtomicUsize::new(0);
static PROCESS: AtomicU32 = AtomicU32::new(0);

thread_local! {
    /// Those of this thread, and whether it is the one that exits.
    static OWN_CALLS: Cell<usize> = const { Cell::new(0) };
    static EXITS: Cell<bool> = const { Cell::new(false) };
}

/// Whether this thread must leave the library, because another one ends the interpreter.
pub(crate) fn leaving() -> bool {
    EXITING.load(SeqCst) && !EXITS.get()
}

/// The exception that ends a thread without a word.
pub(crate) fn thread_ends() -> PyErr {
    PySystemExit::new_err(())
}

/// Calls Python from a step, unless the interpreter exits.
pub(crate) fn attached<T>(call: impl FnOnce(Python<'_>) -> PyResult<T>) -> PyResult<T> {
    if leaving() {
        return Err(thread_ends());
    }
    Python::attach(call)
}

/// A call from Python that calls functions of Python, or releases the interpreter's lock. The end of the interpreter
/// waits for it.
pub(crate) struct Call {
    process: u32,
}

impl Call {
    /// Counts a call; none begins while the interpreter exits.
    pub(crate) fn begin() -> PyResult<Self> {
        let process = process::id();
        if PROCESS.swap(process, SeqCst) != process {
            CALLS.store(OWN_CALLS.replace(0), SeqCst);
        }
        let call = Self { process };
        CALLS.fetch_add(1, SeqCst);
        OWN_CALLS.set(OWN_CALLS.get() + 1);
        // After the count, so that the hook sees this call or this call sees the hook.
        if leaving() {
            return Err(thread_ends());
        }
        Ok(call)
    }

    /// Works without the interpreter's lock. A thread that comes back too late waits for the end of the process.
    pub(crate) fn detach<T: Send>(&self, py: Python<'_>, work: impl FnOnce() -> T + Send) -> T {
        py.detach(|| {
            let result = work();
            while CLOSED.load(SeqCst) && !EXITS.get() {
                thread::park();
            }
            result
        })
    }
}

impl Drop for Call {
    fn drop(&mut self) {
        if PROCESS.load(SeqCst) == self.process {
            CALLS.fetch_sub(1, SeqCst);
            OWN_CALLS.set(OWN_CALLS.get().saturating_sub(1));
        }
    }
}

/// Ends all runs of other threads, and waits for them.
#[pyfunction]
pub(crate) fn _end_runs(py: Python<'_>) {
    EXITS.set(true);
    EXITING.store(true, SeqCst);
    if PROCESS.load(SeqCst) != process::id() {
        return;
    }
    py.detach(|| {
        let begun = Instant::now();
        while CALLS.load(SeqCst) > OWN_CALLS.get() && begun.elapsed() < PATIENCE {
            thread::sleep(PAUSE);
        }
        CLOSED.store(true, SeqCst);
    });
}

/// Asks the interpreter to call the hook at its end.
pub(crate) fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    let hook = wrap_pyfunction!(_end_runs, module)?;
    module
        .py()
        .import("atexit")?
        .call_method1("register", (hook,))?;
    Ok(())
}

//! Ctrl-C in commands that end with what they have.

use std::fmt;
use std::io;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use signal_hook::consts::SIGINT;
use signal_hook::flag;

/// The exit status of a command that was interrupted, as shells give it: 128 and the number of the signal.
pub const STATUS: u8 = 130;

/// The failure of a command that was interrupted and has written what it had.
#[derive(Debug, Clone, Copy)]
pub struct Interrupted;

impl fmt::Display for Interrupted {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("interrupted: the files have the best parameters so far, which are no minimum")
    }
}

impl std::error::Error for Interrupted {}

/// Watches for Ctrl-C from now on, until the process ends.
#[derive(Debug, Clone)]
pub struct Watch(Arc<AtomicBool>);

impl Watch {
    /// The first Ctrl-C sets a flag, a second one ends the process with status 130.
    ///
    /// # Errors
    /// That of the system.
    pub fn new() -> io::Result<Self> {
        let pressed = Arc::new(AtomicBool::new(false));
        // Those that are registered first are called first: the second Ctrl-C finds the flag set.
        flag::register_conditional_shutdown(SIGINT, i32::from(STATUS), pressed.clone())?;
        flag::register(SIGINT, pressed.clone())?;
        Ok(Self(pressed))
    }

    /// Whether Ctrl-C was pressed.
    pub fn is_pressed(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }
}

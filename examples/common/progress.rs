//! How far a run has come, on a terminal.

use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressStyle};

/// A progress bar that costs a run nothing: it is looked at a few times a second.
pub(crate) struct Progress {
    bar: ProgressBar,
    shown: Instant,
}

impl Progress {
    /// A bar of `steps` steps on standard error; hidden where that is no terminal.
    pub(crate) fn new(steps: usize) -> Self {
        let bar = ProgressBar::new(steps as u64);
        if let Ok(style) = ProgressStyle::with_template("{bar:30} {pos}/{len}  {msg}  {eta} left") {
            bar.set_style(style);
        }
        Self {
            bar,
            shown: Instant::now(),
        }
    }

    /// Shows `step` with a message, if the last one has been there for a while.
    pub(crate) fn show(&mut self, step: usize, message: impl FnOnce() -> String) {
        const WHILE: Duration = Duration::from_millis(150);
        if !self.bar.is_hidden() && self.shown.elapsed() > WHILE {
            self.bar.set_position(step as u64);
            self.bar.set_message(message());
            self.shown = Instant::now();
        }
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        self.bar.finish_and_clear();
    }
}

//! The progress of a run on standard error.

use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressStyle};

/// Progress at no cost for a run: a bar on a terminal, updated a few times per second; elsewhere a line after some seconds,
/// and then after longer and longer ones.
pub struct Progress {
    bar: ProgressBar,
    begun: Instant,
    shown: Instant,
    /// The time until the next line \[s\].
    next: Duration,
}

/// The positions of the bar.
const PARTS: f64 = 1000.0;
/// Between two states of the bar.
const WHILE: Duration = Duration::from_millis(150);
/// Until the first line, and at most between two.
const FIRST: Duration = Duration::from_secs(4);
const MOST: Duration = Duration::from_secs(60);

impl Default for Progress {
    fn default() -> Self {
        let bar = ProgressBar::new(PARTS as u64);
        if let Ok(style) = ProgressStyle::with_template("{bar:30} {percent} %  {msg}") {
            bar.set_style(style);
        }
        let now = Instant::now();
        Self {
            bar,
            begun: now,
            shown: now,
            next: FIRST,
        }
    }
}

impl Progress {
    /// Shows the share of the run that is done, a message, and the time left at the mean pace so far.
    pub fn show(&mut self, share: f64, message: impl FnOnce() -> String) {
        let wait = if self.bar.is_hidden() {
            self.next
        } else {
            WHILE
        };
        if self.shown.elapsed() < wait {
            return;
        }
        self.shown = Instant::now();
        let share = share.clamp(0.0, 1.0);
        let message = format!("{}  {}", message(), self.left(share));
        if self.bar.is_hidden() {
            self.next = (2 * self.next).min(MOST);
            note!("{:.0} %  {message}", 100.0 * share);
        } else {
            self.bar.set_position((share * PARTS) as u64);
            self.bar.set_message(message);
        }
    }

    /// Shows the time \[s\] of a run up to another, and the largest slip rate [m/s].
    pub fn at(&mut self, time: f64, end: f64, slip_rate: f64) {
        self.show(time / end, || {
            format!("t = {time:.4} s  V = {slip_rate:.2e} m/s")
        });
    }

    fn left(&self, share: f64) -> String {
        let seconds = self.begun.elapsed().as_secs_f64() * (1.0 / share - 1.0);
        match seconds {
            _ if !seconds.is_finite() => String::new(),
            ..100.0 => format!("about {seconds:.0} s left"),
            ..6000.0 => format!("about {:.0} min left", seconds / 60.0),
            _ => format!("about {:.0} h left", seconds / 3600.0),
        }
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        self.bar.finish_and_clear();
    }
}

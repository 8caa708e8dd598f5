//! Stall detection: whether an iteration still makes progress.

/// Number of successive slow windows: the set of sticking vertices may take one to settle.
const PATIENCE: usize = 2;

/// Stall detection from the changes of an iteration.
#[derive(Debug)]
pub(crate) struct Progress {
    /// The number of iterations over which progress is judged.
    window: usize,
    /// The largest number of windows to the tolerance, at the rate of the last window; beyond it an iteration is too
    /// slow.
    windows: f64,
    count: usize,
    /// The smallest change of this window and of the last.
    smallest: f64,
    before: f64,
    slow: usize,
}

impl Progress {
    /// Stall detection for an iteration that is to end within `windows` more windows of so many iterations.
    pub(crate) fn new(window: usize, windows: f64) -> Self {
        Self {
            window,
            windows,
            count: 0,
            smallest: f64::INFINITY,
            before: f64::INFINITY,
            slow: 0,
        }
    }

    /// Adds a change; false once `tolerance`, not below 0, is out of reach.
    pub(crate) fn goes_on(&mut self, change: f64, tolerance: f64) -> bool {
        self.count += 1;
        self.smallest = self.smallest.min(change);
        if self.count.is_multiple_of(self.window) {
            let gain = (self.before / self.smallest).ln();
            let left = (self.smallest / tolerance).ln();
            // The first window has nothing to be compared with.
            let too_slow = self.before.is_finite() && (gain <= 0.0 || left > self.windows * gain);
            self.slow = if too_slow { self.slow + 1 } else { 0 };
            self.before = std::mem::replace(&mut self.smallest, f64::INFINITY);
        }
        self.slow < PATIENCE
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The iteration at which a series of changes is given up.
    fn end(changes: impl Iterator<Item = f64>) -> Option<usize> {
        let mut progress = Progress::new(50, 40.0);
        changes
            .take(100_000)
            .position(|change| !progress.goes_on(change, 1e-10))
    }

    #[test]
    fn only_what_would_take_thousands_of_iterations_is_given_up() {
        let series = |rate: f64| (0..).map(move |n| rate.powi(n)).take_while(|&c| c > 1e-10);
        for rate in [0.1, 0.9, 0.98] {
            assert_eq!(end(series(rate)), None);
        }
        for rate in [0.9999, 1.0, 1.001] {
            assert!(end((0..).map(|n| f64::powi(rate, n))).is_some_and(|n| n < 160));
        }
        // Noise at a level that never falls.
        assert!(end((0..).map(|n| 1e-7 * (1.5 + f64::from(n).sin()))).is_some_and(|n| n < 400));
        // Changes that shrink by so little that none is small enough.
        let mut progress = Progress::new(50, 40.0);
        let shrinking = (0..).map(|n| 1e-15 * (1.0 - 1e-12 * f64::from(n)));
        let ended = shrinking
            .take(1000)
            .position(|change| !progress.goes_on(change, 0.0));
        assert!(ended.is_some_and(|n| n < 160));
        // A plateau of a hundred iterations before the rate sets in.
        let plateau = (0..).map(|n: i32| 0.5_f64.powi((n - 110).max(0)));
        assert_eq!(end(plateau.take_while(|&c| c > 1e-10)), None);
    }
}

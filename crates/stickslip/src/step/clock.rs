//! Time without drift.

/// Counts steps; for a constant step size the time is a product, not a sum.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Clock {
    step: usize,
    /// The time at which the present step size began, and the part of it that rounding took.
    origin: f64,
    lost: f64,
    dt: f64,
    steps_of_dt: usize,
}

impl Clock {
    /// Step 0 at a time \[s\].
    pub fn starting_at(time: f64) -> Self {
        Self {
            origin: time,
            ..Self::default()
        }
    }

    /// The number of steps so far.
    pub fn step(&self) -> usize {
        self.step
    }

    /// The time \[s\].
    pub fn time(&self) -> f64 {
        self.origin + (self.steps_of_dt as f64 * self.dt - self.lost)
    }

    /// The step \[s\] that leads to the time `until` \[s\] exactly, as far as there is one.
    pub fn left(&self, until: f64) -> f64 {
        let left = (until - self.origin) - (self.steps_of_dt as f64 * self.dt - self.lost);
        // The difference of times far apart is rounded itself.
        let leads_there = |&dt: &f64| self.after(dt).time() == until;
        let near = [left, left.next_up(), left.next_down()];
        near.into_iter().find(leads_there).unwrap_or(left)
    }

    /// The clock one step of `dt` \[s\] later.
    #[must_use]
    pub fn after(&self, dt: f64) -> Self {
        let mut next = *self;
        if dt != self.dt {
            // Kahan: what the new origin has too much is taken off every later time.
            let advance = self.steps_of_dt as f64 * self.dt - self.lost;
            next.origin = self.origin + advance;
            next.lost = (next.origin - self.origin) - advance;
            next.dt = dt;
            next.steps_of_dt = 0;
        }
        next.steps_of_dt += 1;
        next.step += 1;
        next
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn constant_steps_do_not_accumulate_rounding() {
        let mut clock = Clock::default();
        for _ in 0..6735 {
            clock = clock.after(1.5e-3);
        }
        assert_eq!(clock.time(), 6735.0 * 1.5e-3);
        assert_eq!(clock.step, 6735);
    }

    #[test]
    fn what_is_left_leads_to_the_time_asked_for() {
        let mut clock = Clock::default();
        for n in 0..10_000_usize {
            let until = clock.time() + 1.7_f64.powi((n % 40) as i32 - 20);
            assert_eq!(clock.after(clock.left(until)).time(), until);
            clock = clock.after(0.1 + 0.7 * (n % 7) as f64);
        }
    }

    #[test]
    fn changing_steps_lose_nothing() {
        let mut clock = Clock::default();
        for n in 0..1_000_000_usize {
            clock = clock.after(if n % 2 == 0 { 0.1 } else { 1e-9 });
        }
        let exact = 500_000.0 * 0.1 + 500_000.0 * 1e-9;
        assert!(
            (clock.time() - exact).abs() <= 1e-11,
            "{}",
            clock.time() - exact
        );
    }
}

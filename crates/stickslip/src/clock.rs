//! A clock without rounding drift.

/// Step counter and time; for a constant step size the time is a product, not a sum.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Clock {
    step: usize,
    /// The time at which the present step size began, and its compensation for rounding.
    origin: f64,
    lost: f64,
    dt: f64,
    steps_of_dt: usize,
}

impl Clock {
    /// A clock at step 0 and a time \[s\].
    pub fn starting_at(time: f64) -> Self {
        Self {
            origin: time,
            ..Self::default()
        }
    }

    /// The number of steps taken.
    pub fn step(&self) -> usize {
        self.step
    }

    /// The time \[s\].
    pub fn time(&self) -> f64 {
        self.origin + (self.steps_of_dt as f64 * self.dt - self.lost)
    }

    /// The step size \[s\] that leads to the time `until` \[s\] exactly, as far as one exists.
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

//! The least-squares line of samples, by sums that merge without cancellation.

/// The least-squares line of some samples of a displacement, and the sum of squares beside it.
#[derive(Debug, Clone, Copy)]
pub(super) struct Line {
    /// The number of samples.
    pub(super) count: f64,
    /// Their mean time \[s\].
    pub(super) time: f64,
    /// Their mean displacement \[m\].
    displacement: f64,
    /// The sum of the squares of the times less their mean [s^2].
    pub(super) spread: f64,
    /// The slope [m/s]; 0 of one sample.
    pub(super) velocity: f64,
    /// The sum of squares of the residuals [m^2].
    pub(super) squares: f64,
}

impl Line {
    /// The line of one sample.
    pub(super) fn sample(time: f64, displacement: f64) -> Self {
        Self {
            count: 1.0,
            time,
            displacement,
            spread: 0.0,
            velocity: 0.0,
            squares: 0.0,
        }
    }

    /// The line of the samples in order, at least one.
    pub(super) fn of(times: &[f64], displacements: &[f64]) -> Self {
        let samples = times[1..].iter().zip(&displacements[1..]);
        let first = Self::sample(times[0], displacements[0]);
        samples.fold(first, |line, (&time, &x)| {
            line.joined(&Self::sample(time, x)).0
        })
    }

    /// The line of the samples of both, and by how much the sum of squares exceeds that of the two lines.
    ///
    /// With the distance `T` of the mean times, that of the means `X`, and `h = n1 n2/(n1 + n2)` the sum of squares of a
    /// joint slope `s` is `h (s T - X)^2 + S1 (s - s1)^2 + S2 (s - s2)^2` above the two: the slopes `X/T`, `s1` and `s2`
    /// have the weights `h T^2`, `S1` and `S2`. Differences of slopes alone are squared, so that nothing cancels.
    pub(super) fn joined(&self, other: &Self) -> (Self, f64) {
        let count = self.count + other.count;
        let apart = other.time - self.time;
        let moved = other.displacement - self.displacement;
        let (middle, share) = (moved / apart, other.count / count);
        let weight = self.count * share * apart * apart;
        let spread = weight + self.spread + other.spread;
        let velocity =
            (weight * middle + self.spread * self.velocity + other.spread * other.velocity)
                / spread;
        let excess = weight * (middle - velocity).powi(2)
            + self.spread * (self.velocity - velocity).powi(2)
            + other.spread * (other.velocity - velocity).powi(2);
        let joined = Self {
            count,
            time: self.time + share * apart,
            displacement: self.displacement + share * moved,
            spread,
            velocity,
            squares: self.squares + other.squares + excess,
        };
        (joined, excess)
    }

    /// The mean of the same samples: the line of a load point at rest.
    pub(super) fn at_rest(&self) -> Self {
        Self {
            velocity: 0.0,
            squares: self.squares + self.spread * self.velocity * self.velocity,
            ..*self
        }
    }

    /// The displacement \[m\] of the line at a time \[s\].
    pub(super) fn at(&self, time: f64) -> f64 {
        self.displacement + self.velocity * (time - self.time)
    }

    /// The time \[s\] at which this line meets another; not finite for parallel lines.
    pub(super) fn meets(&self, other: &Self) -> f64 {
        let middle = 0.5 * (self.time + other.time);
        middle + (other.at(middle) - self.at(middle)) / (self.velocity - other.velocity)
    }
}

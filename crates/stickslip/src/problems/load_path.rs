//! How the far end of a spring moves.

/// The position of a load point as a function of time, by a velocity that is linear between kinks.
///
/// ```
/// use stickslip::problems::LoadPath;
///
/// // 1 um/s, ten times faster from 10 s on, at rest from 20 s to 30 s, then slowly up to 1 um/s.
/// let path = LoadPath::steady(1e-6).then(10.0, 1e-5).then(20.0, 0.0).ramp(30.0, 40.0, 1e-6);
/// assert_eq!(path.velocity(25.0), 0.0);
/// assert!((path.position(20.0) - (1e-5 + 1e-4)).abs() < 1e-19);
/// assert!((path.velocity(35.0) - 5e-7).abs() < 1e-19);
/// assert_eq!(path.kinks().collect::<Vec<_>>(), [10.0, 20.0, 30.0, 40.0]);
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct LoadPath {
    segments: Vec<Segment>,
}

/// A piece of constant acceleration.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Segment {
    start: f64,
    position: f64,
    velocity: f64,
    acceleration: f64,
}

impl Segment {
    fn velocity(&self, time: f64) -> f64 {
        self.velocity + self.acceleration * (time - self.start)
    }

    fn position(&self, time: f64) -> f64 {
        let since = time - self.start;
        self.position + since * (self.velocity + 0.5 * self.acceleration * since)
    }
}

impl LoadPath {
    /// From position 0 at time 0 with a constant velocity [m/s].
    pub fn steady(velocity: f64) -> Self {
        Self {
            segments: vec![Segment {
                start: 0.0,
                position: 0.0,
                velocity,
                acceleration: 0.0,
            }],
        }
    }

    /// From `time` \[s\] on, which must not lie before what is already there, with another velocity
    /// [m/s].
    #[must_use]
    pub fn then(mut self, time: f64, velocity: f64) -> Self {
        let position = self.position(time);
        self.segments.push(Segment {
            start: time,
            position,
            velocity,
            acceleration: 0.0,
        });
        self
    }

    /// From one time to another \[s\] with a velocity that grows linearly to a new one [m/s], which
    /// then stays.
    #[must_use]
    pub fn ramp(self, from: f64, to: f64, velocity: f64) -> Self {
        let before = self.velocity(from);
        let mut path = self.then(from, before);
        if let Some(last) = path.segments.last_mut() {
            last.acceleration = (velocity - before) / (to - from);
        }
        path.then(to, velocity)
    }

    /// The position at a time \[s\], in \[m\].
    pub fn position(&self, time: f64) -> f64 {
        self.at(time).position(time)
    }

    /// The velocity at a time \[s\], from the right, in [m/s].
    pub fn velocity(&self, time: f64) -> f64 {
        self.at(time).velocity(time)
    }

    /// The times \[s\] at which the velocity has a jump or a kink: a step should end there.
    pub fn kinks(&self) -> impl Iterator<Item = f64> {
        self.segments[1..].iter().map(|segment| segment.start)
    }

    fn at(&self, time: f64) -> &Segment {
        let after = self
            .segments
            .partition_point(|segment| segment.start <= time);
        &self.segments[after.saturating_sub(1)]
    }
}

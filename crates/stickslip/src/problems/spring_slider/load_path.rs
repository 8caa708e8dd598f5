//! The motion of a load point.

use crate::SceneError;
use crate::checks::require;

/// The position of a load point as a function of time, with a velocity that is linear between kinks.
///
/// Invalid times and velocities are recorded, and refused by [`validate`](Self::validate) or when a scene is built.
///
/// ```
/// use stickslip::problems::spring_slider::LoadPath;
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
    /// The first error.
    refused: Option<SceneError>,
}

const VELOCITY: &str = "velocity of the load path";

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
    /// A path from position 0 at time 0 with a constant velocity [m/s], a finite number.
    pub fn steady(velocity: f64) -> Self {
        let mut path = Self {
            segments: vec![Segment {
                start: 0.0,
                position: 0.0,
                velocity,
                acceleration: 0.0,
            }],
            refused: None,
        };
        path.refuse_unless(velocity.is_finite(), VELOCITY, "finite", velocity);
        path
    }

    /// Sets another velocity [m/s] from `time` \[s\] on, which must not precede the existing path.
    #[must_use]
    pub fn then(mut self, time: f64, velocity: f64) -> Self {
        self.refuse_beginning(time);
        self.refuse_unless(velocity.is_finite(), VELOCITY, "finite", velocity);
        self.push(time, velocity, 0.0);
        self
    }

    /// Adds a ramp: between two times \[s\] the velocity changes linearly to a new one [m/s], and then stays. The first
    /// time must not precede the existing path.
    #[must_use]
    pub fn ramp(mut self, from: f64, to: f64, velocity: f64) -> Self {
        let before = self.velocity(from);
        let acceleration = (velocity - before) / (to - from);
        self.refuse_beginning(from);
        self.refuse_unless(velocity.is_finite(), VELOCITY, "finite", velocity);
        let requirement = "finite and after the ramp's beginning";
        let grows = to > from && to.is_finite() && acceleration.is_finite();
        self.refuse_unless(grows, "end of a ramp of the load path", requirement, to);
        self.push(from, before, acceleration);
        self.push(to, velocity, 0.0);
        self
    }

    /// The times \[s\] at which its velocity or acceleration jumps, for
    /// [`Steps::stopping_at`](crate::Steps::stopping_at).
    pub fn jumps(&self) -> impl Iterator<Item = f64> {
        self.segments.iter().skip(1).map(|segment| segment.start)
    }

    /// Validates the pieces of the path; the construction of a scene does the same.
    ///
    /// # Errors
    /// [`SceneError::Value`] for the first time that is not finite, goes back, or ends a ramp where it begins, and for
    /// a velocity that is not finite. Its position counts the previous pieces. The path remains as it was before the
    /// invalid piece.
    pub fn validate(&self) -> Result<(), SceneError> {
        self.refused.clone().map_or(Ok(()), Err)
    }

    /// Adds a piece to a path without error.
    fn push(&mut self, start: f64, velocity: f64, acceleration: f64) {
        if self.refused.is_none() {
            let position = self.position(start);
            self.segments.push(Segment {
                start,
                position,
                velocity,
                acceleration,
            });
        }
    }

    fn refuse_beginning(&mut self, time: f64) {
        let last = self.segments.last().map_or(0.0, |last| last.start);
        let onward = time.is_finite() && time >= last;
        let requirement = "finite and not before the time given last";
        self.refuse_unless(onward, "time of the load path", requirement, time);
    }

    fn refuse_unless(
        &mut self,
        holds: bool,
        what: &'static str,
        requirement: &'static str,
        value: f64,
    ) {
        let position = self.segments.len();
        if self.refused.is_none() {
            self.refused = require(what, requirement, position, value, holds).err();
        }
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

//! The test problem of all checks: one component with a spring and a damper.

use crate::{Motion, RateScheme};

/// `m u'' + d u' + k u = f(t)`.
#[derive(Clone, Copy)]
pub(super) struct Oscillator {
    pub(super) mass: f64,
    pub(super) damping: f64,
    pub(super) stiffness: f64,
}

impl Oscillator {
    /// One step of a scheme, with all its stages, from `time` on.
    pub(super) fn step<R: RateScheme + ?Sized>(
        &self,
        scheme: &R,
        old: Motion,
        time: f64,
        dt: f64,
        force: impl Fn(f64) -> f64,
    ) -> Motion {
        let mut now = old;
        for stage in scheme.properties().stages {
            let formula = scheme.update_formula(stage.share * dt);
            let between = |old: f64, now: f64| old + stage.lead * (now - old);
            let from = Motion {
                displacement: between(old.displacement, now.displacement),
                velocity: between(old.velocity, now.velocity),
                ..now
            };
            let (u, a) = (
                formula.displacement.of_old(from),
                formula.acceleration.of_old(from),
            );
            let load = force(time + stage.end * dt) - self.mass * a - self.stiffness * u;
            let resistance = self.mass * formula.acceleration.new_velocity
                + self.damping
                + self.stiffness * formula.displacement.new_velocity;
            now = formula.motion(from, load / resistance);
        }
        now
    }
}

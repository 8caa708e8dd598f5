//! Exact-enough minimisation of the energy along a correction.

use nalgebra::SVector;

use super::models::{Friction, Models};
use super::system::Aim;

/// The energy along `from + t along`, seen as its second-order model plus what that misses.
pub(super) struct Line<'a, const C: usize> {
    pub(super) friction: &'a Friction<'a, C>,
    pub(super) from: &'a [SVector<f64, C>],
    pub(super) along: &'a [SVector<f64, C>],
    pub(super) aim: Aim,
    /// At `from`.
    pub(super) models: &'a Models<C>,
}

impl<const C: usize> Line<'_, C> {
    /// The right-hand derivative at `t`. Near the solution the model's part vanishes exactly at
    /// `t = 1` and the rest is a difference of neighbouring slopes: no large terms cancel.
    /// Second: how far rounding alone may have moved it.
    fn slope(&self, t: f64) -> (f64, f64) {
        let mut slope = t * self.aim.curvature - self.aim.decrease;
        let mut noise = 0.0;
        for (k, &vertex) in self.friction.vertices.iter().enumerate() {
            let d = &self.along[vertex];
            if d.iter().all(|&component| component == 0.0) {
                continue;
            }
            let at = self.from[vertex] + d * t;
            let linear = self.models.gradients[k].dot(d);
            let ahead = self.friction.potentials.slope_along(k, &at, d).upper;
            slope += ahead - linear - t * d.dot(&(self.models.hessians[k] * d));
            noise += linear.abs();
        }
        (slope, NOISE * noise)
    }
}

/// What rounding does to a slope, over the sum of the terms it is a difference of.
pub(super) const NOISE: f64 = 64.0 * f64::EPSILON;

/// A `t` in `[0, 1]` at which the energy still falls or is minimal. Whoever knows [`Line::slope`] at
/// 1 passes it on as `end`.
pub(super) fn search<const C: usize>(line: &Line<'_, C>, end: Option<(f64, f64)>) -> f64 {
    // Not a direction of descent: rounding is all that is left of it.
    if !(line.aim.decrease > 0.0 && line.aim.curvature.is_finite()) {
        return 0.0;
    }
    // The slope grows from -decrease: a rise this small cannot outweigh what was gained before it.
    const NEGLIGIBLE: f64 = 1e-6;
    let (mut low, mut low_slope) = (0.0, -line.aim.decrease);
    let (mut high, (mut high_slope, noise)) = (1.0, end.unwrap_or_else(|| line.slope(1.0)));
    if high_slope <= NEGLIGIBLE * line.aim.decrease + noise {
        return 1.0;
    }
    // Illinois variant of the secant, which keeps the bracket and halves the weight of a stale end.
    for halving in 0..60 {
        let secant = low + (high - low) * low_slope / (low_slope - high_slope);
        let t = if halving % 4 == 3 || !secant.is_finite() {
            0.5 * (low + high)
        } else {
            secant
        };
        let (slope, _) = line.slope(t);
        if slope <= 0.0 {
            if slope >= -0.1 * line.aim.decrease {
                return t;
            }
            (low, low_slope) = (t, slope);
            high_slope *= 0.5;
        } else {
            (high, high_slope) = (t, slope);
            low_slope *= 0.5;
        }
    }
    low
}

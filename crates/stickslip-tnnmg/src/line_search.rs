//! Exact-enough minimisation of the energy along a correction.

use nalgebra::{SMatrix, SVector};
use stickslip_friction::ConvexPotential;

use crate::{BlockMatrix, Energy};

/// The energy along `from + t along`, seen as its second-order model plus what that misses.
pub(crate) struct Line<'a, P, const C: usize> {
    pub(crate) energy: &'a Energy<'a, BlockMatrix<C>, P, C>,
    pub(crate) from: &'a [SVector<f64, C>],
    pub(crate) along: &'a [SVector<f64, C>],
    /// Minus the slope of the model at `t = 0`.
    pub(crate) decrease: f64,
    /// The second derivative of the model.
    pub(crate) curvature: f64,
    /// Gradient of each potential at `from`, zero on truncated components.
    pub(crate) gradients: &'a [SVector<f64, C>],
    /// Hessian of each potential at `from`.
    pub(crate) hessians: &'a [SMatrix<f64, C, C>],
}

impl<P: ConvexPotential<C>, const C: usize> Line<'_, P, C> {
    /// The right-hand derivative at `t`. Near the solution the model's part vanishes exactly at
    /// `t = 1` and the rest is a difference of neighbouring slopes: no large terms cancel.
    /// Second: how far rounding alone may have moved it.
    fn slope(&self, t: f64) -> (f64, f64) {
        let mut slope = t * self.curvature - self.decrease;
        let mut noise = 0.0;
        for (k, (potential, &vertex)) in self
            .energy
            .potentials
            .iter()
            .zip(self.energy.vertices)
            .enumerate()
        {
            let d = &self.along[vertex];
            if d.iter().all(|&component| component == 0.0) {
                continue;
            }
            let at = self.from[vertex] + d * t;
            let linear = self.gradients[k].dot(d);
            slope +=
                potential.slope_along(&at, d).upper - linear - t * d.dot(&(self.hessians[k] * d));
            noise += linear.abs();
        }
        (slope, NOISE * noise)
    }
}

/// What rounding does to a slope, over the sum of the terms it is a difference of.
pub(crate) const NOISE: f64 = 64.0 * f64::EPSILON;

/// A `t` in `[0, 1]` at which the energy still falls or is minimal. Whoever knows [`Line::slope`] at
/// 1 passes it on as `end`.
pub(crate) fn search<P: ConvexPotential<C>, const C: usize>(
    line: &Line<'_, P, C>,
    end: Option<(f64, f64)>,
) -> f64 {
    // Not a direction of descent: rounding is all that is left of it.
    if !(line.decrease > 0.0 && line.curvature.is_finite()) {
        return 0.0;
    }
    // The slope grows from -decrease: a rise this small cannot outweigh what was gained before it.
    const NEGLIGIBLE: f64 = 1e-6;
    let (mut low, mut low_slope) = (0.0, -line.decrease);
    let (mut high, (mut high_slope, noise)) = (1.0, end.unwrap_or_else(|| line.slope(1.0)));
    if high_slope <= NEGLIGIBLE * line.decrease + noise {
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
            if slope >= -0.1 * line.decrease {
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

//! The energy along a direction.

use nalgebra::SVector;
use stickslip::Matrix;
use stickslip::solvers::Energy;

use crate::DistributedMatrix;

/// The slope of `t -> J(v + t d)` over all processes.
pub(super) struct Line<'a, const C: usize> {
    energy: &'a Energy<'a, DistributedMatrix<C>, C>,
    direction: &'a [SVector<f64, C>],
    from: &'a [SVector<f64, C>],
    /// `d . (r - B v)` and `d . B d`.
    smooth: [f64; 2],
    rounding: f64,
}

/// The rounding errors of a slope, as a share of its terms.
const NOISE: f64 = 64.0 * f64::EPSILON;
/// A rise this small cannot outweigh what was gained before it.
const NEGLIGIBLE: f64 = 1e-6;

impl<'a, const C: usize> Line<'a, C> {
    /// From `v` along a direction, with the sums over this process of its products with the residual at `v`, of their
    /// sizes, and of its products with its image.
    pub(super) fn new(
        energy: &'a Energy<'a, DistributedMatrix<C>, C>,
        direction: &'a [SVector<f64, C>],
        from: &'a [SVector<f64, C>],
        sums: [f64; 3],
    ) -> Self {
        let mut all = sums;
        energy.operator.layout.world.sum_each(&mut all);
        let [decrease, size, curvature] = all;
        Self {
            energy,
            direction,
            from,
            smooth: [decrease, curvature],
            rounding: NOISE * size,
        }
    }

    fn slope(&self, t: f64) -> f64 {
        let mut slope = 0.0;
        for (k, &vertex) in self.energy.vertices.iter().enumerate() {
            let d = &self.direction[vertex];
            if d.iter().any(|&component| component != 0.0) {
                let at = self.from[vertex] + d * t;
                slope += self.energy.potentials.slope_along(k, &at, d).upper;
            }
        }
        let [decrease, curvature] = self.smooth;
        self.energy.operator.ranks().sum(slope) + t * curvature - decrease
    }

    /// A length at which the energy is no larger than at 0: 1 where it falls up to there.
    pub(super) fn length(&self) -> f64 {
        let (mut low, mut low_slope) = (0.0, self.slope(0.0));
        let (mut high, mut high_slope) = (1.0, self.slope(1.0));
        let descent = -low_slope;
        if high_slope <= (NEGLIGIBLE * descent).max(0.0) + self.rounding {
            return 1.0;
        }
        if !(descent > 0.0 && self.smooth[1].is_finite()) {
            return 0.0;
        }
        // Illinois variant of the secant: the bracket is kept, and a stale end loses half of its weight.
        for round in 0..60 {
            let secant = low + (high - low) * low_slope / (low_slope - high_slope);
            let halved = round % 4 == 3 || !secant.is_finite();
            let t = if halved { 0.5 * (low + high) } else { secant };
            let slope = self.slope(t);
            if slope <= 0.0 {
                if slope >= -0.1 * descent {
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
}

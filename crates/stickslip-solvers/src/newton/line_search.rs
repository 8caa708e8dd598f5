//! Inexact minimisation of the energy along a correction.

use std::ops::Range;

use nalgebra::SVector;
use stickslip_friction::Interval;

use super::models::{Friction, Models};
use super::system::Aim;
use crate::parts::gather_contact;

/// The energy along `from + t along`: its second-order model plus the remainder.
pub(super) struct Line<'a, const C: usize> {
    pub(super) friction: &'a Friction<'a, C>,
    pub(super) from: &'a [SVector<f64, C>],
    pub(super) along: &'a [SVector<f64, C>],
    pub(super) aim: Aim,
    /// At `from`.
    pub(super) models: &'a Models<C>,
}

impl<const C: usize> Line<'_, C> {
    /// The right-hand derivative at `t`. Near the solution the model's part vanishes exactly at `t = 1`, and the rest
    /// is a difference of neighbouring slopes: no large terms cancel. The second value is the bound of its rounding
    /// error.
    fn slope(&self, t: f64) -> (f64, f64) {
        let model = t * self.aim.curvature - self.aim.decrease;
        let slope = |places: Range<usize>, ()| {
            let mut slope = if places.start == 0 { model } else { 0.0 };
            let mut terms = 0.0;
            for k in places {
                let vertex = self.friction.vertices[k];
                let d = &self.along[vertex];
                if d.iter().all(|&component| component == 0.0) {
                    continue;
                }
                let at = self.from[vertex] + d * t;
                let linear = self.models.gradients[k].dot(d);
                let ahead = finite_end(self.friction.potentials.slope_along(k, &at, d));
                slope += ahead - linear - t * d.dot(&(self.models.hessians[k] * d));
                terms += linear.abs();
            }
            (slope, NOISE * terms)
        };
        let both = |a: (f64, f64), b: (f64, f64)| (a.0 + b.0, a.1 + b.1);
        gather_contact(self.friction.vertices.len(), (), &slope, &both)
    }
}

/// The right-hand slope; where the domain of a potential ends, the left-hand one: no projected direction leads beyond it.
fn finite_end(slopes: Interval) -> f64 {
    if slopes.upper.is_finite() {
        slopes.upper
    } else {
        slopes.lower
    }
}

/// The rounding error of a slope, relative to the sum of the terms of the difference.
pub(super) const NOISE: f64 = 64.0 * f64::EPSILON;

/// The share of the first slope by which the slope may rise over the whole step without further tests, and up to which
/// the whole step is taken if the energy falls by a good part of the model's decrease.
const NEGLIGIBLE: f64 = 1e-6;
const OVERSHOT: f64 = 0.3;
const SUFFICIENT: f64 = 0.1;

/// A `t` in `[0, 1]` at which the energy is lower: the whole step, a point where the energy still falls, or the
/// minimum. A caller that knows [`Line::slope`] at 1 passes it as `end`.
///
/// A small overshoot is worth the whole step: Newton's method continues after it.
pub(super) fn search<const C: usize>(line: &Line<'_, C>, end: Option<(f64, f64)>) -> f64 {
    // Not a direction of descent: rounding is all that is left of it.
    if !(line.aim.decrease > 0.0 && line.aim.curvature.is_finite()) {
        return 0.0;
    }
    let decrease = line.aim.decrease;
    let (mut low, mut low_slope) = (0.0, -decrease);
    let (mut high, (mut high_slope, noise)) = (1.0, end.unwrap_or_else(|| line.slope(1.0)));
    // The slope grows from -decrease: a rise this small cannot outweigh what was gained before it.
    if high_slope <= NEGLIGIBLE * decrease + noise {
        return 1.0;
    }
    if high_slope <= OVERSHOT * decrease {
        let (slope, _) = line.slope(0.5);
        // The slope is at most this before the middle, and at most that at the end behind it.
        if slope + high_slope <= -SUFFICIENT * decrease {
            return 1.0;
        }
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
            if slope >= -0.1 * decrease {
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

#[cfg(test)]
mod tests {
    use stickslip_friction::{ConvexPotential, DieterichRuina, Radial};
    use stickslip_state::LogTheta;

    use super::*;

    /// Steps of Newton's method for one vertex from `far` times the rate at which it comes to rest, which overshoot more
    /// the further they lead down: short ones are taken whole, and the energy falls over all.
    #[test]
    fn a_little_overshoot_is_taken_whole() {
        let law = DieterichRuina {
            a: 0.010,
            b: 0.015,
            reference_friction: 0.6,
            reference_velocity: 1e-6,
            slip_distance: 1e-5,
        };
        let potential = Radial {
            law,
            force: 1e5,
            state: LogTheta(2.0),
        };
        let (stiffness, rest) = (1e7, 1e-5);
        let model = |v: f64| {
            let model = potential.local_model(&SVector::from([v]));
            (model.gradient[0], model.hessian[(0, 0)])
        };
        let load = stiffness * rest + model(rest).0;
        let energy = |v: f64| {
            let phi = potential.value(&SVector::from([v]));
            0.5 * stiffness * v * v - load * v + phi
        };
        let friction = Friction {
            potentials: &vec![potential],
            vertices: &[0],
            fixed: &[[false]],
        };
        let mut lengths = Vec::new();
        for far in [0.3, 0.99, 1.01, 1.1, 1.3, 1.6, 1.9, 3.0] {
            let from = far * rest;
            let (gradient, hessian) = model(from);
            let step = (load - stiffness * from - gradient) / (stiffness + hessian);
            let mut models = Models::default();
            models.resize(1);
            (models.gradients[0][0], models.hessians[0][(0, 0)]) = (gradient, hessian);
            let square = step * step * (stiffness + hessian);
            let line = Line {
                friction: &friction,
                from: &[SVector::from([from])],
                along: &[SVector::from([step])],
                aim: Aim {
                    decrease: square,
                    curvature: square,
                },
                models: &models,
            };
            let length = search(&line, None);
            assert!(energy(from + length * step) < energy(from), "{far}");
            lengths.push(length);
        }
        let (whole, short) = lengths.split_at(5);
        assert!(whole.iter().all(|&length| length == 1.0), "{lengths:?}");
        assert!(short.iter().any(|&length| length < 1.0), "{lengths:?}");
    }
}

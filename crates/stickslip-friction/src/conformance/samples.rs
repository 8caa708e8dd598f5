//! Convexity and local models at sample points.

use nalgebra::SVector;

use super::FrictionViolation;
use crate::{ConvexPotential, difference::smooth, jacobi};

/// The axes, the diagonal and three more unit vectors.
pub(super) fn directions<const C: usize>() -> Vec<SVector<f64, C>> {
    let mut all: Vec<SVector<f64, C>> = (0..C)
        .map(|i| SVector::from_fn(|j, _| f64::from(u8::from(i == j))))
        .collect();
    all.push(SVector::repeat(1.0));
    for angle in [0.7, 2.3, 4.1] {
        all.push(SVector::from_fn(|j, _| {
            (angle * f64::from(u8::try_from(j + 1).unwrap_or(u8::MAX))).cos()
        }));
    }
    all.iter().map(|d| d / d.norm()).collect()
}

/// Rest, and points in all directions, 12 decades to either side of a speed.
fn points<const C: usize>(speed: f64) -> Vec<SVector<f64, C>> {
    let mut all = vec![SVector::zeros()];
    for exponent in [-12, -6, -3, -1, 0, 1, 3, 6, 12] {
        all.extend(
            directions::<C>()
                .iter()
                .map(|d| d * (speed * 10f64.powi(exponent))),
        );
    }
    all
}

pub(super) fn check_convexity<P: ConvexPotential<C> + ?Sized, const C: usize>(
    potential: &P,
    speed: f64,
) -> Result<(), FrictionViolation> {
    let points = points::<C>(speed);
    for v in &points {
        if potential.value(v).is_nan() {
            return Err(FrictionViolation::potential(
                "value",
                "a number, not",
                v.norm(),
                [f64::NAN; 2],
            ));
        }
    }
    for v in &points {
        let at_v = potential.value(v);
        for w in &points {
            let d = w - v;
            let at_w = potential.value(w);
            let slopes = potential.slope_along(v, &d);
            let ordered = slopes.lower <= slopes.upper;
            if !ordered {
                return Err(FrictionViolation::potential(
                    "lower slope",
                    "at most the upper slope",
                    v.norm(),
                    [slopes.lower, slopes.upper],
                ));
            }
            let noise = 1e-12 * (at_v.abs() + at_w.abs() + slopes.upper.abs()) + f64::MIN_POSITIVE;
            let (value, chord) = (potential.value(&(v + d * 0.5)), 0.5 * at_v + 0.5 * at_w);
            if value.is_nan() || value > chord + noise {
                return Err(FrictionViolation::NotConvex {
                    requirement: "at most the chord",
                    from: v.norm(),
                    to: w.norm(),
                    value,
                    bound: chord,
                });
            }
            let tangent = at_v + slopes.upper;
            if tangent > at_w + noise {
                return Err(FrictionViolation::NotConvex {
                    requirement: "at least the tangent",
                    from: v.norm(),
                    to: w.norm(),
                    value: at_w,
                    bound: tangent,
                });
            }
            let kept = potential.keep_smooth(v, &d);
            for (&component, &kept) in d.iter().zip(&kept) {
                let longer = kept.abs() > component.abs() * (1.0 + 4.0 * f64::EPSILON);
                if kept.is_nan() || longer || kept * component.signum() < 0.0 {
                    return Err(FrictionViolation::potential(
                        "component of keep_smooth",
                        "between 0 and that of the correction,",
                        v.norm(),
                        [kept, component],
                    ));
                }
            }
        }
    }
    Ok(())
}

pub(super) fn check_local_models<P: ConvexPotential<C> + ?Sized, const C: usize>(
    potential: &P,
    speed: f64,
) -> Result<(), FrictionViolation> {
    for v in points::<C>(speed) {
        let model = potential.local_model(&v);
        // Gradient and Hessian on the smooth components alone.
        let keep = SVector::<f64, C>::from_fn(|i, _| f64::from(u8::from(model.smooth[i])));
        let axes = || (0..C).filter(|&i| model.smooth[i]);
        let speed = v.norm();
        for d in directions::<C>() {
            let d = d.component_mul(&keep);
            let slopes = potential.slope_along(&v, &d);
            let gradient: f64 = axes().map(|i| model.gradient[i] * d[i]).sum();
            let noise = 1e-12 * axes().map(|i| model.gradient[i].abs()).sum::<f64>();
            if !(slopes.lower - noise <= gradient && gradient <= slopes.upper + noise) {
                return Err(FrictionViolation::potential(
                    "slope of the gradient",
                    "slope_along,",
                    speed,
                    [gradient, slopes.upper],
                ));
            }
        }
        let hessian = model.hessian.map_with_location(|i, j, h| {
            if model.smooth[i] && model.smooth[j] {
                h
            } else {
                0.0
            }
        });
        let size = hessian.amax();
        let asymmetry = (hessian - hessian.transpose()).amax();
        let eigenvalue = jacobi::eigen(&hessian).0.min();
        let rounding = 1e-13 * size;
        for (what, requirement, wrong, found) in [
            ("asymmetry of the Hessian", "at most", asymmetry, asymmetry),
            (
                "eigenvalue of the Hessian",
                "at least",
                -eigenvalue,
                eigenvalue,
            ),
        ] {
            // Not NaN either.
            let legal = wrong <= rounding;
            if !legal {
                return Err(FrictionViolation::potential(
                    what,
                    requirement,
                    speed,
                    [found, 0.0],
                ));
            }
        }
        if speed == 0.0 {
            continue;
        }
        for (i, j) in axes().flat_map(|i| axes().map(move |j| (i, j))) {
            // In units of the speed, so that nothing overflows.
            let gradient = |ratio: f64| {
                let mut w = v;
                w[j] += ratio * speed;
                let model = potential.local_model(&w);
                if model.smooth[i] && model.smooth[j] {
                    model.gradient[i]
                } else {
                    f64::NAN
                }
            };
            let noise = 1e-13 * (model.gradient.norm() + size * speed);
            let entry = hessian[(i, j)] * speed;
            if let Some((difference, uncertainty)) = smooth(gradient, 0.0, 1e-5, noise)
                && (entry - difference).abs() > uncertainty
            {
                return Err(FrictionViolation::potential(
                    "entry of the Hessian",
                    "the difference quotient",
                    speed,
                    [entry / speed, difference / speed],
                ));
            }
        }
    }
    Ok(())
}

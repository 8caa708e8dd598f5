//! The contract of a rate scheme as a check of any scheme.

mod oscillator;
mod stability;
mod stages;
mod symmetry;
mod violation;

use crate::{Motion, RateScheme, Weights};
use oscillator::Oscillator;
pub use violation::RateSchemeViolation;

/// Checks a scheme against the contract of [`RateScheme`]:
///
/// - over steps from 1e-12 to 1e6 s all weights are finite, `c_u` is positive, or zero for an explicit
///   scheme, which has a step limit, `c_a` is positive, or zero throughout for a scheme without inertia, and nothing is algorithmic
///   on unless the properties say so;
/// - stages lead through the step, one after the other;
/// - a constant velocity is reproduced, and with the exact new velocity of a smooth motion the
///   displacement of a step is wrong by `O(dt^2)`, also where the velocity is prescribed, the acceleration
///   by `O(dt)`;
/// - on a driven oscillator the order is that of the properties, and a symmetric scheme comes back;
/// - a step of the oscillator `u'' = -omega^2 u` has a spectral radius of at most one, for
///   `omega dt` from 1e-6 to 1e6 or up to the step limit (without inertia: of the relaxation
///   `u' = -omega u`).
///
/// ```
/// use stickslip_time::{Newmark, RateSchemeViolation, check_rate_scheme};
///
/// check_rate_scheme(&Newmark::AVERAGE_ACCELERATION)?;
/// // beta = 1/6 assumes a linear acceleration: stable for small steps only.
/// let linear = Newmark { beta: 1.0 / 6.0, gamma: 0.5 };
/// let violation = check_rate_scheme(&linear);
/// assert_eq!(violation.unwrap_err().property, "stability");
/// # Ok::<(), RateSchemeViolation>(())
/// ```
///
/// # Errors
/// The first [`RateSchemeViolation`] found.
pub fn check_rate_scheme<R: RateScheme + ?Sized>(scheme: &R) -> Result<(), RateSchemeViolation> {
    let inertia = scheme.update_formula(1.0).acceleration.new_velocity != 0.0;
    stages::check(scheme)?;
    for dt in decades(-12, 6) {
        check_weights(scheme, dt, inertia)?;
        check_constant_velocity(scheme, dt)?;
    }
    check_consistency(scheme, inertia)?;
    let limit = scheme.properties().stability_limit.unwrap_or(f64::INFINITY);
    for frequency in decades(-6, 6).filter(|frequency| *frequency < limit) {
        stability::check(scheme, frequency, inertia)?;
    }
    check_order(scheme, inertia)?;
    symmetry::check(scheme, inertia)
}

/// Three numbers per decade.
fn decades(first: i32, last: i32) -> impl Iterator<Item = f64> {
    (3 * first..=3 * last).map(|k| 10_f64.powf(f64::from(k) / 3.0))
}

/// The relative error of rounding alone.
const ROUNDING: f64 = 1e-12;

fn check_weights<R: RateScheme + ?Sized>(
    scheme: &R,
    dt: f64,
    inertia: bool,
) -> Result<(), RateSchemeViolation> {
    let (formula, properties) = (scheme.update_formula(dt), scheme.properties());
    let (c_u, c_a) = (
        formula.displacement.new_velocity,
        formula.acceleration.new_velocity,
    );
    let explicit = c_u == 0.0 && !properties.implicit && properties.stability_limit.is_some();
    for (quantity, value, allowed, requirement) in [
        (
            "c_u",
            c_u,
            c_u > 0.0 && properties.implicit || explicit,
            "finite and positive, or zero in an explicit scheme with a step limit",
        ),
        (
            "c_a",
            c_a,
            if inertia { c_a > 0.0 } else { c_a == 0.0 },
            "finite, and positive or zero as for dt = 1",
        ),
        (
            "a weight of what is carried on",
            size(formula.algorithmic),
            properties.has_algorithmic || formula.algorithmic == Weights::ZERO,
            "zero, since nothing is algorithmic",
        ),
        (
            "a weight of the displacement",
            size(formula.displacement),
            true,
            "finite",
        ),
        (
            "a weight of the acceleration",
            size(formula.acceleration),
            true,
            "finite",
        ),
        (
            "a weight of a prescribed displacement",
            size(formula.prescribed),
            true,
            "finite",
        ),
    ] {
        if !(allowed && value.is_finite()) {
            return Err(RateSchemeViolation {
                property: "weights",
                quantity,
                at: Some(("dt", dt)),
                value,
                requirement,
                bound: None,
            });
        }
    }
    Ok(())
}

/// The sum of the absolute weights; infinite or NaN if one of them is.
fn size(weights: Weights) -> f64 {
    let Weights {
        displacement,
        velocity,
        acceleration,
        algorithmic,
        new_velocity,
    } = weights;
    [
        displacement,
        velocity,
        acceleration,
        algorithmic,
        new_velocity,
    ]
    .map(f64::abs)
    .iter()
    .sum()
}

fn check_constant_velocity<R: RateScheme + ?Sized>(
    scheme: &R,
    dt: f64,
) -> Result<(), RateSchemeViolation> {
    let (u, v) = (0.3, -1.7 / dt);
    let from = Motion {
        displacement: u,
        velocity: v,
        ..Motion::default()
    };
    let formula = scheme.update_formula(dt);
    let to = formula.motion(from, v);
    for (quantity, value, expected, scale) in [
        ("displacement", to.displacement, u + dt * v, 2.0),
        (
            "prescribed displacement",
            formula.prescribed.of(from, v),
            u + dt * v,
            2.0,
        ),
        ("acceleration", to.acceleration, 0.0, 1.7 / (dt * dt)),
        (
            "what is carried on",
            to.algorithmic,
            0.0,
            1.7 / (dt * dt * dt),
        ),
    ] {
        let error = (value - expected).abs();
        if error.is_nan() || error > ROUNDING * scale {
            return Err(RateSchemeViolation {
                property: "constant velocity",
                quantity,
                at: Some(("dt", dt)),
                value,
                requirement: "equal to",
                bound: Some(expected),
            });
        }
    }
    Ok(())
}

/// The errors after one stage on `u = sin(t + 1)` with the exact velocity, on which `u` and `a` depend.
fn errors<R: RateScheme + ?Sized>(scheme: &R, dt: f64) -> [f64; 3] {
    let at = |t: f64| Motion {
        displacement: (t + 1.0).sin(),
        velocity: (t + 1.0).cos(),
        acceleration: -(t + 1.0).sin(),
        ..Motion::default()
    };
    let (exact, formula) = (at(dt), scheme.update_formula(dt));
    let to = formula.motion(at(0.0), exact.velocity);
    let prescribed = formula.prescribed.of(at(0.0), exact.velocity);
    [
        (to.displacement - exact.displacement).abs(),
        (prescribed - exact.displacement).abs(),
        (to.acceleration - exact.acceleration).abs(),
    ]
}

fn check_consistency<R: RateScheme + ?Sized>(
    scheme: &R,
    inertia: bool,
) -> Result<(), RateSchemeViolation> {
    let (long, short) = (1e-2, 1e-4_f64);
    let (coarse, fine) = (errors(scheme, long), errors(scheme, short));
    let components = [
        ("displacement", 2),
        ("prescribed displacement", 2),
        ("acceleration", 1),
    ];
    let count = if inertia { 3 } else { 2 };
    for (k, (quantity, expected)) in components.into_iter().enumerate().take(count) {
        let order = (coarse[k] / fine[k]).ln() / (long / short).ln();
        // Errors of two orders may cancel at one step size; at the other they are small then.
        let small = fine[k] <= short.powi(expected);
        let expected = f64::from(expected);
        if !(small || order > expected - 0.2) {
            return Err(RateSchemeViolation {
                property: "consistency",
                quantity,
                at: None,
                value: order,
                requirement: "of an order in dt of at least",
                bound: Some(expected),
            });
        }
    }
    Ok(())
}

/// Checks the order on `u = cos 2t` of a driven oscillator, or of a driven relaxation without inertia.
fn check_order<R: RateScheme + ?Sized>(
    scheme: &R,
    inertia: bool,
) -> Result<(), RateSchemeViolation> {
    let driven = Oscillator {
        mass: if inertia { 1.0 } else { 0.0 },
        damping: 0.4,
        stiffness: 3.0,
    };
    let error = |steps: usize| {
        let dt = 2.0 / steps as f64;
        let force = |t: f64| {
            let (sin, cos) = (2.0 * t).sin_cos();
            (driven.stiffness - 4.0 * driven.mass) * cos - 2.0 * driven.damping * sin
        };
        let mut motion = Motion {
            displacement: 1.0,
            acceleration: if inertia { -4.0 } else { 0.0 },
            ..Motion::default()
        };
        let mut worst = 0.0_f64;
        for n in 0..steps {
            let time = n as f64 * dt;
            motion = driven.step(scheme, motion, time, dt, force);
            worst = worst.max((motion.displacement - (2.0 * (time + dt)).cos()).abs());
        }
        worst
    };
    let (observed, claimed) = ((error(400) / error(800)).log2(), scheme.properties().order);
    if observed > claimed as f64 - 0.2 {
        Ok(())
    } else {
        Err(RateSchemeViolation {
            property: "order",
            quantity: "order observed on a driven oscillator",
            at: None,
            value: observed,
            requirement: "that of the properties,",
            bound: Some(claimed as f64),
        })
    }
}

//! The contract of a rate scheme as a function that any scheme can be put through.

use thiserror::Error;

use crate::{Coefficients, Motion, RateScheme};

/// How a scheme breaks the contract of [`RateScheme`], with the numbers that show it.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum RateSchemeViolation {
    /// A coefficient is not what a factor of a matrix has to be.
    #[error("dt = {dt:e}: {name} is {value}, not finite and {range}")]
    Coefficient {
        /// The time step \[s\].
        dt: f64,
        /// `c_u` or `c_a`.
        name: &'static str,
        /// Its value.
        value: f64,
        /// The range it has to be in.
        range: &'static str,
    },
    /// What is at rest at the origin is not predicted to stay there.
    #[error("dt = {dt:e}: from rest, {component} is predicted to be {value:e}")]
    LeavesRest {
        /// The time step \[s\].
        dt: f64,
        /// The component of the prediction.
        component: &'static str,
        /// The value predicted.
        value: f64,
    },
    /// The prediction of a combination is not the combination of the predictions.
    #[error("dt = {dt:e}: {component} of a combination is {found:e}, not {expected:e}")]
    NotLinear {
        /// The time step \[s\].
        dt: f64,
        /// The component of the prediction.
        component: &'static str,
        /// The value predicted.
        found: f64,
        /// The combination of the values predicted.
        expected: f64,
    },
    /// A motion of constant velocity is not reproduced.
    #[error("dt = {dt:e}: at constant velocity {component} is {found:e}, not {expected:e}")]
    ConstantVelocity {
        /// The time step \[s\].
        dt: f64,
        /// The component of the new motion.
        component: &'static str,
        /// What the scheme says.
        found: f64,
        /// What it is.
        expected: f64,
    },
    /// On a smooth motion the error of a step falls too slowly with the time step.
    #[error("{component} is of order {order:.2} in dt on a smooth motion, not {expected}")]
    NotConsistent {
        /// The component of the new motion.
        component: &'static str,
        /// The observed order.
        order: f64,
        /// The order from which the scheme converges.
        expected: f64,
    },
    /// The undamped oscillator gains amplitude without bound.
    #[error("omega dt = {frequency:e}: the oscillator grows by a factor of {growth} a step")]
    Unstable {
        /// Angular frequency times step.
        frequency: f64,
        /// The spectral radius of a step, above one.
        growth: f64,
    },
}

/// Puts a scheme through the contract of [`RateScheme`]:
///
/// - over steps from 1e-12 to 1e6 s, `c_u` is finite and positive, `c_a` finite and positive, or zero
///   throughout for a scheme without inertia;
/// - the prediction is linear in the motion, and rest stays at rest;
/// - a constant velocity is reproduced, and with the exact new velocity of a smooth motion the
///   displacement of a step is wrong by `O(dt^2)`, the acceleration by `O(dt)`;
/// - a step of the oscillator `u'' = -omega^2 u` has a spectral radius of at most one, for
///   `omega dt` from 1e-6 to 1e6 (without inertia: of the relaxation `u' = -omega u`).
///
/// ```
/// use stickslip_time::{Newmark, RateSchemeViolation, check_rate_scheme};
///
/// check_rate_scheme(&Newmark::AVERAGE_ACCELERATION)?;
/// // beta = 1/6 assumes a linear acceleration: stable for small steps only.
/// let linear = Newmark { beta: 1.0 / 6.0, gamma: 0.5 };
/// let violation = check_rate_scheme(&linear);
/// assert!(matches!(violation, Err(RateSchemeViolation::Unstable { .. })));
/// # Ok::<(), RateSchemeViolation>(())
/// ```
///
/// # Errors
/// The first [`RateSchemeViolation`] found.
pub fn check_rate_scheme<R: RateScheme + ?Sized>(scheme: &R) -> Result<(), RateSchemeViolation> {
    let inertia = scheme.coefficients(1.0).acceleration != 0.0;
    for dt in decades(-12, 6) {
        check_coefficients(scheme, dt, inertia)?;
        check_linearity(scheme, dt)?;
        check_constant_velocity(scheme, dt)?;
    }
    check_order(scheme, inertia)?;
    let limit = scheme.stability_limit().unwrap_or(f64::INFINITY);
    for frequency in decades(-6, 6).filter(|frequency| *frequency < limit) {
        check_stability(scheme, frequency, inertia)?;
    }
    Ok(())
}

/// Three numbers a decade.
fn decades(first: i32, last: i32) -> impl Iterator<Item = f64> {
    (3 * first..=3 * last).map(|k| 10_f64.powf(f64::from(k) / 3.0))
}

/// Relative errors that rounding alone explains.
const ROUNDING: f64 = 1e-12;

fn check_coefficients<R: RateScheme + ?Sized>(
    scheme: &R,
    dt: f64,
    inertia: bool,
) -> Result<(), RateSchemeViolation> {
    let Coefficients {
        displacement,
        acceleration,
    } = scheme.coefficients(dt);
    let positive = |value: f64| value > 0.0 && value.is_finite();
    let (allowed, range) = if inertia {
        (positive(acceleration), "positive")
    } else {
        (acceleration == 0.0, "zero as for dt = 1")
    };
    // An explicit scheme owns up to a limit.
    let explicit = displacement == 0.0 && scheme.stability_limit().is_some();
    for (name, value, allowed, range) in [
        (
            "c_u",
            displacement,
            positive(displacement) || explicit,
            "positive",
        ),
        ("c_a", acceleration, allowed, range),
    ] {
        if !allowed {
            return Err(RateSchemeViolation::Coefficient {
                dt,
                name,
                value,
                range,
            });
        }
    }
    Ok(())
}

/// The components of a prediction, and what is carried on to a velocity that depends on the old one,
/// named.
fn predict<R: RateScheme + ?Sized>(scheme: &R, dt: f64, from: Motion) -> [(&'static str, f64); 3] {
    let predicted = scheme.predict(dt, from);
    let carried = scheme.carry(dt, from, 0.4 * from.velocity);
    [
        ("displacement", predicted.displacement),
        ("acceleration", predicted.acceleration),
        ("what is carried on", carried.unwrap_or(0.0)),
    ]
}

fn check_linearity<R: RateScheme + ?Sized>(scheme: &R, dt: f64) -> Result<(), RateSchemeViolation> {
    for (component, value) in predict(scheme, dt, Motion::default()) {
        if value != 0.0 {
            return Err(RateSchemeViolation::LeavesRest {
                dt,
                component,
                value,
            });
        }
    }
    // Scaled so that no term of a scheme is lost beside the others.
    let motion = |[u, v, a, w]: [f64; 4]| Motion {
        displacement: u,
        velocity: v / dt,
        acceleration: a / (dt * dt),
        carried: w / (dt * dt * dt),
    };
    let (p, q) = ([0.7, -1.3, 0.9, 0.3], [-0.4, 0.6, 1.7, -1.1]);
    let sum = motion(std::array::from_fn(|i| 2.0 * p[i] - 3.0 * q[i]));
    let (p, q) = (motion(p), motion(q));
    let parts = predict(scheme, dt, p)
        .into_iter()
        .zip(predict(scheme, dt, q));
    for ((component, found), ((_, p), (_, q))) in predict(scheme, dt, sum).into_iter().zip(parts) {
        let expected = 2.0 * p - 3.0 * q;
        let scale = (2.0 * p).abs() + (3.0 * q).abs();
        let error = (found - expected).abs();
        if error.is_nan() || error > ROUNDING * scale {
            return Err(RateSchemeViolation::NotLinear {
                dt,
                component,
                found,
                expected,
            });
        }
    }
    Ok(())
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
    let to = (scheme.coefficients(dt)).motion(v, scheme.predict(dt, from));
    for (component, found, expected, scale) in [
        ("displacement", to.displacement, u + dt * v, 2.0),
        ("acceleration", to.acceleration, 0.0, 1.7 / (dt * dt)),
    ] {
        let error = (found - expected).abs();
        if error.is_nan() || error > ROUNDING * scale {
            return Err(RateSchemeViolation::ConstantVelocity {
                dt,
                component,
                found,
                expected,
            });
        }
    }
    Ok(())
}

/// Errors after one step of `u = sin(t + 1)` with the exact velocity, on which `u` and `a` depend.
fn errors<R: RateScheme + ?Sized>(scheme: &R, dt: f64) -> [f64; 2] {
    let at = |t: f64| Motion {
        displacement: (t + 1.0).sin(),
        velocity: (t + 1.0).cos(),
        acceleration: -(t + 1.0).sin(),
        ..Motion::default()
    };
    let exact = at(dt);
    let to = (scheme.coefficients(dt)).motion(exact.velocity, scheme.predict(dt, at(0.0)));
    [
        (to.displacement - exact.displacement).abs(),
        (to.acceleration - exact.acceleration).abs(),
    ]
}

fn check_order<R: RateScheme + ?Sized>(
    scheme: &R,
    inertia: bool,
) -> Result<(), RateSchemeViolation> {
    let (long, short) = (1e-2, 1e-4_f64);
    let (coarse, fine) = (errors(scheme, long), errors(scheme, short));
    let components = [("displacement", 2), ("acceleration", 1)];
    let count = if inertia { 2 } else { 1 };
    for (k, (component, expected)) in components.into_iter().enumerate().take(count) {
        let order = (coarse[k] / fine[k]).ln() / (long / short).ln();
        // Errors of two orders may cancel at one step size; at the other they are small then.
        let small = fine[k] <= short.powi(expected);
        let expected = f64::from(expected);
        if !(small || order > expected - 0.2) {
            return Err(RateSchemeViolation::NotConsistent {
                component,
                order,
                expected,
            });
        }
    }
    Ok(())
}

fn check_stability<R: RateScheme + ?Sized>(
    scheme: &R,
    frequency: f64,
    inertia: bool,
) -> Result<(), RateSchemeViolation> {
    let c = scheme.coefficients(1.0);
    let square = frequency * frequency;
    // The unknowns are u, v/omega, a/omega^2 and what is carried on over omega^2; a step of length
    // one of each gives a column.
    let step = |unit: usize| {
        let one_of = |k: usize| if k == unit { 1.0 } else { 0.0 };
        let from = Motion {
            displacement: one_of(0),
            velocity: frequency * one_of(1),
            acceleration: square * one_of(2),
            carried: square * one_of(3),
        };
        let predicted = scheme.predict(1.0, from);
        let velocity = if inertia {
            (-predicted.acceleration - square * predicted.displacement)
                / (c.acceleration + square * c.displacement)
        } else {
            -frequency * predicted.displacement / (1.0 + frequency * c.displacement)
        };
        let to = c.motion(velocity, predicted);
        [
            to.displacement,
            to.velocity / frequency,
            to.acceleration / square,
            scheme.carry(1.0, from, velocity).unwrap_or(0.0) / square,
        ]
    };
    let growth = spectral_radius(std::array::from_fn(step));
    if growth <= 1.0 + RADIUS_ERROR {
        Ok(())
    } else {
        Err(RateSchemeViolation::Unstable { frequency, growth })
    }
}

/// The accuracy of [`spectral_radius`], with norms of powers up to 1e40 at radius one.
const RADIUS_ERROR: f64 = 1e-7;

/// `norm(A^n)^(1/n)` with `n = 2^30`, by squaring; the matrix is brought to unit size each time.
fn spectral_radius<const N: usize>(mut matrix: [[f64; N]; N]) -> f64 {
    let mut logarithm = 0.0;
    let mut share = 1.0;
    for _ in 0..30 {
        let size = matrix.iter().flatten().fold(0.0_f64, |s, a| s.max(a.abs()));
        if size == 0.0 {
            return 0.0;
        }
        logarithm += share * size.ln();
        share *= 0.5;
        let unit = matrix.map(|column| column.map(|a| a / size));
        matrix = std::array::from_fn(|j| {
            std::array::from_fn(|i| (0..N).map(|k| unit[k][i] * unit[j][k]).sum())
        });
    }
    logarithm.exp()
}

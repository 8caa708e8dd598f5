//! Small disturbances of steady sliding, as linear stability predicts them, and energy in large
//! ones.

use std::f64::consts::SQRT_2;

use nalgebra::Complex;
use stickslip::Steps;
use stickslip::friction::FrictionLaw;
use stickslip::problems::spring_slider::{AGING, FRICTION, LoadPath, SpringSlider, steady_state};
use stickslip::state::LogTheta;

use super::{SLIP_DISTANCE, implicit};
use crate::Outcome;

/// That of the elastic slider \[Pa\].
const NORMAL_STRESS: f64 = 49_050.0;

/// The slider of the stability analysis: 2e-4 m/s, the parameters of the elastic slider.
fn oscillator(share: f64, mass: f64, damping: f64) -> SpringSlider {
    let critical =
        SpringSlider::critical_stiffness(NORMAL_STRESS, FRICTION.a, FRICTION.b, SLIP_DISTANCE);
    SpringSlider {
        stiffness: share * critical,
        normal_stress: NORMAL_STRESS,
        mass,
        damping,
        load: LoadPath::steady(RATE),
    }
}

const RATE: f64 = 2e-4;

/// The complex growth rate [1/s] of a small disturbance of steady sliding, measured.
///
/// A sum of `exp(s t)` and its conjugate satisfies `x(t + h) = p x(t) - q x(t - h)`, where `exp(s
/// h)` solves `z^2 = p z - q`. With `h` a quarter of a period, least squares over 2 s to 5 s give
/// both.
fn growth(slider: &SpringSlider, dt: f64) -> Outcome<Complex<f64>> {
    let rate = RATE * (1.0 + 1e-6);
    let scene = slider.scene(FRICTION, AGING, rate, steady_state(&AGING, RATE)?)?;
    let mut block = implicit(scene)?;
    let mut signal = Vec::new();
    let steps = Steps::constant(dt).count((5.0 / dt).round() as usize);
    block.run(&steps, |at| {
        if at.time > 2.0 {
            signal.push((at.velocity[0][0] / RATE).ln());
        }
    })?;
    let stride = (0.1 / dt).round() as usize;
    let (mut xx, mut xy, mut yy, mut xz, mut yz) = (0.0, 0.0, 0.0, 0.0, 0.0);
    for i in 2 * stride..signal.len() {
        let (x, y, z) = (signal[i - stride], -signal[i - 2 * stride], signal[i]);
        xx += x * x;
        xy += x * y;
        yy += y * y;
        xz += x * z;
        yz += y * z;
    }
    let determinant = xx * yy - xy * xy;
    let (p, q) = (
        (xz * yy - yz * xy) / determinant,
        (xx * yz - xy * xz) / determinant,
    );
    let largest = signal.iter().fold(0.0, |m: f64, x| m.max(x.abs()));
    assert!(largest < 1e-3, "not a small disturbance");
    let root = 0.5 * (Complex::new(p, 0.0) + Complex::new(p * p - 4.0 * q, 0.0).sqrt());
    Ok(root.ln() / (stride as f64 * dt))
}

/// The growth rate by linear stability, for `m u'' + eta u' + tau = K (x - u)`:
///
/// ```text
/// m V/L s^2 + m s^3 + (eta + a sigma/V) s^2 + [K + (eta + a sigma/V) V/L - b sigma/L] s
///     + K V/L = 0
/// ```
///
/// from `delta alpha = -(s/L)/(s + V/L) delta u`; by Newton's method from a root of the
/// quasi-static problem.
fn predicted(slider: &SpringSlider) -> Complex<f64> {
    let slip = RATE / SLIP_DISTANCE;
    let direct = slider.damping + FRICTION.a * slider.normal_stress / RATE;
    let linear =
        slider.stiffness + direct * slip - FRICTION.b * slider.normal_stress / SLIP_DISTANCE;
    let (cubic, square, constant) = (
        slider.mass,
        slider.mass * slip + direct,
        slider.stiffness * slip,
    );
    let mut s = Complex::new(0.0, 10.0 * SQRT_2);
    for _ in 0..50 {
        let value = ((s * cubic + square) * s + linear) * s + constant;
        let slope = (s * (3.0 * cubic) + 2.0 * square) * s + linear;
        s -= value / slope;
    }
    s
}

/// The real part changes sign at `(b - a) sigma/L`, where the imaginary one is `sqrt((b - a)/a)
/// V/L`.
#[test]
fn oscillations_grow_below_the_critical_stiffness() -> Outcome {
    for (share, expected) in [
        (0.8, 1.0),
        (0.95, 0.25),
        (1.0, 0.0),
        (1.05, -0.25),
        (1.2, -1.0),
    ] {
        let slider = oscillator(share, 0.0, 0.0);
        let rate = growth(&slider, 1e-3)?;
        let tolerance = f64::max(0.01 * f64::abs(expected), 0.0025);
        assert!((rate.re - expected).abs() < tolerance, "{share}: {rate}");
        assert!((predicted(&slider).re - expected).abs() < 1e-12);
        if share == 1.0 {
            assert!((rate.im - 14.142).abs() < 0.01 * 14.142, "{rate}");
        }
    }
    Ok(())
}

/// Radiation damping and inertia, alone and together, move the rate as the characteristic equation
/// says, and the error of the measured rate is of second order in the step.
#[test]
fn damping_and_inertia_change_the_growth_rate() -> Outcome {
    let direct = FRICTION.a * NORMAL_STRESS / RATE;
    for (share, mass, damping) in [
        (0.8, 0.0, 0.1 * direct),
        (0.8, 0.0, 0.02 * direct),
        (0.9, 4e3, 0.0),
        (1.1, 4e3, 0.0),
        (0.8, 2e3, 0.05 * direct),
    ] {
        let slider = oscillator(share, mass, damping);
        let plain = predicted(&oscillator(share, 0.0, 0.0));
        let expected = predicted(&slider);
        let error = |dt| -> Outcome<f64> { Ok((growth(&slider, dt)? - expected).norm()) };
        let (coarse, fine) = (error(2e-3)?, error(1e-3)?);
        assert!((expected - plain).norm() > 0.1, "{expected}, {plain}");
        assert!(fine < 0.01, "{expected}: {fine:e}");
        assert!(
            (3.5..4.5).contains(&(coarse / fine)),
            "{coarse:e}, {fine:e}"
        );
    }
    Ok(())
}

/// Newmark's scheme: the change of energy is the way times the mean of the forces at its two ends.
#[test]
fn energy_changes_by_work_friction_and_viscous_loss() -> Outcome {
    let slider = SpringSlider {
        mass: 4e3,
        damping: 3e5,
        ..oscillator(0.7, 0.0, 0.0)
    };
    let rate = 3.0 * RATE;
    let mut block = implicit(slider.scene(FRICTION, AGING, rate, steady_state(&AGING, RATE)?)?)?;
    let mut last: Option<(f64, f64, [f64; 3])> = None;
    let (mut balance, mut supplied, mut viscous) = (0.0, 0.0, 0.0);
    let (mut slowest, mut fastest) = (f64::INFINITY, 0_f64);
    for _ in 0..4000 {
        block.step(5e-4)?;
        let at = block.snapshot();
        let (u, v) = (at.displacement[0][0], at.velocity[0][0]);
        (slowest, fastest) = (slowest.min(v), fastest.max(v));
        let energy = 0.5 * (slider.mass * v * v + slider.stiffness * u * u);
        let forces = [
            slider.stiffness * slider.load.position(at.time),
            slider.normal_stress * FRICTION.coefficient(v, LogTheta(at.contact(0).state(0))),
            slider.damping * v,
        ];
        if let Some((u_old, energy_old, old)) = last {
            let work = |k: usize| 0.5 * (u - u_old) * (forces[k] + old[k]);
            let imbalance = energy - energy_old - work(0) + work(1) + work(2);
            let scale = work(0).abs() + work(1).abs() + work(2).abs() + 1e-3 * energy;
            assert!(imbalance.abs() < 1e-12 * scale, "{imbalance:e}, {scale:e}");
            balance += energy - energy_old + work(1) + work(2);
            supplied += work(0);
            viscous += work(2);
        }
        last = Some((u, energy, forces));
    }
    assert!(fastest > 2.0 * slowest, "{slowest:e}, {fastest:e}");
    assert!(viscous > 1e-4 * supplied, "{viscous:e}, {supplied:e}");
    assert!((balance - supplied).abs() < 1e-12 * supplied.abs());
    Ok(())
}

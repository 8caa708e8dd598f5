//! Observed orders on a damped, driven oscillator with a known solution.

use stickslip_time::{BackwardEuler, Motion, Newmark, QuasiStatic, RateScheme};

/// Largest displacement error on [0, 2] of `m u'' + 0.4 u' + 3 u = f`, `u = cos 2t`.
fn error(scheme: &dyn RateScheme, mass: f64, steps: usize) -> f64 {
    let dt = 2.0 / steps as f64;
    let c = scheme.coefficients(dt);
    let mut motion = Motion {
        displacement: 1.0,
        velocity: 0.0,
        acceleration: -4.0,
    };
    let mut worst = 0.0_f64;
    for n in 1..=steps {
        let t = n as f64 * dt;
        let (cos, sin) = ((2.0 * t).cos(), (2.0 * t).sin());
        let force = -4.0 * mass * cos - 0.8 * sin + 3.0 * cos;
        let predicted = scheme.predict(dt, motion);
        let right = force - mass * predicted.acceleration - 3.0 * predicted.displacement;
        motion = c.motion(
            right / (mass * c.acceleration + 0.4 + 3.0 * c.displacement),
            predicted,
        );
        worst = worst.max((motion.displacement - cos).abs());
    }
    worst
}

fn order(scheme: &dyn RateScheme, mass: f64) -> f64 {
    (error(scheme, mass, 400) / error(scheme, mass, 800)).log2()
}

#[test]
fn newmark_is_of_second_order() {
    let newmark = Newmark::AVERAGE_ACCELERATION;
    assert!((order(&newmark, 1.0) - 2.0).abs() < 0.05);
    assert!((order(&QuasiStatic(newmark), 0.0) - 2.0).abs() < 0.05);
}

#[test]
fn backward_euler_is_of_first_order() {
    assert!((order(&BackwardEuler, 1.0) - 1.0).abs() < 0.05);
    assert!((order(&QuasiStatic(BackwardEuler), 0.0) - 1.0).abs() < 0.05);
}

#[test]
fn quasi_static_ignores_mass_and_acceleration() {
    let scheme = QuasiStatic(Newmark::AVERAGE_ACCELERATION);
    let from = Motion {
        displacement: 1.0,
        velocity: 2.0,
        acceleration: 1e9,
    };
    assert_eq!(scheme.coefficients(0.1).acceleration, 0.0);
    assert_eq!(scheme.predict(0.1, from).acceleration, 0.0);
    assert_eq!(scheme.predict(0.1, from).displacement, 1.0 + 0.05 * 2.0);
}

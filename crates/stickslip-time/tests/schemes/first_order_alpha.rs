//! Generalised-alpha for systems of first order: order and damping.

use stickslip_time::{FirstOrderAlpha, Motion, RateScheme};

/// `u' = v`, `v = cos t`, by steps that alternate in size.
fn error(radius: f64, steps: usize) -> f64 {
    let scheme = FirstOrderAlpha {
        spectral_radius: radius,
    };
    let dt = 1.0 / steps as f64;
    let (mut time, mut now) = (
        0.0_f64,
        Motion {
            velocity: 1.0,
            ..Motion::default()
        },
    );
    for n in 0..steps {
        let dt = if n % 2 == 0 { 1.5 * dt } else { 0.5 * dt };
        time += dt;
        now = scheme.update_formula(dt).motion(now, time.cos());
    }
    (now.displacement - time.sin()).abs()
}

#[test]
fn is_of_second_order_in_steps_of_any_size() {
    for radius in [0.0, 0.5, 0.8, 1.0] {
        let order = (error(radius, 100) / error(radius, 200)).log2();
        assert!((order - 2.0).abs() < 0.1, "{radius}: {order}");
    }
}

/// A displacement that forces prescribe, as under friction that does not depend on the rate: what is left of an
/// error of the velocity falls by the spectral radius in each step.
#[test]
fn damps_a_velocity_that_nothing_resists() {
    for radius in [0.0, 0.5, 0.8] {
        let formula = FirstOrderAlpha {
            spectral_radius: radius,
        }
        .update_formula(0.1);
        let mut now = Motion {
            velocity: 1.0,
            ..Motion::default()
        };
        let mut largest = 1.0_f64;
        for n in 0..100 {
            let left = -formula.displacement.of_old(now);
            now = formula.motion(now, left / formula.displacement.new_velocity);
            largest = if n < 50 {
                0.0
            } else {
                largest.max(now.velocity.abs())
            };
        }
        assert!(
            largest <= 60.0 * radius.powi(50) + 1e-300,
            "{radius}: {largest}"
        );
    }
}

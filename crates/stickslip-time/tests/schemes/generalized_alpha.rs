//! The formulas of generalised-alpha.

use proptest::prelude::*;
use stickslip_time::{GeneralizedAlpha, Motion, RateScheme, TimeError};

proptest! {
    #[test]
    fn satisfies_its_defining_equations(
        radius in 0.0..=1.0_f64, dt in 1e-6..1e3_f64,
        u in -1.0..1.0_f64, v in -1.0..1.0_f64, a in -1.0..1.0_f64, w in -1.0..1.0_f64,
        new in -1.0..1.0_f64,
    ) {
        let scheme = GeneralizedAlpha { spectral_radius: radius };
        let algorithmic = (w - a) / dt;
        let from = Motion { displacement: u, velocity: v, acceleration: a, algorithmic };
        let to = scheme.update_formula(dt).motion(from, new);
        let w_new = to.acceleration + dt * to.algorithmic;
        let am = (2.0 * radius - 1.0) / (radius + 1.0);
        let af = radius / (radius + 1.0);
        let gamma = 0.5 - am + af;
        let beta = (1.0 - am + af).powi(2) / 4.0;
        let rate = v + dt * ((1.0 - gamma) * w + gamma * w_new);
        prop_assert!((rate - new).abs() < 1e-10 * (1.0 + dt));
        let place = u + dt * v + dt * dt * ((0.5 - beta) * w + beta * w_new);
        let scale = 1.0 + dt * dt * (1.0 + w_new.abs());
        prop_assert!((place - to.displacement).abs() < 1e-12 * scale);
        let forces = (1.0 - am) * w_new + am * w - (1.0 - af) * to.acceleration - af * a;
        prop_assert!(forces.abs() < 1e-12 * (4.0 + w_new.abs() + to.acceleration.abs()));
    }
}

#[test]
fn rejects_a_radius_outside_of_its_range() {
    for spectral_radius in [-0.1, 1.1, f64::NAN] {
        let refused = GeneralizedAlpha { spectral_radius }.validate();
        let TimeError {
            parameter, value, ..
        } = refused.expect_err("accepted");
        assert_eq!(
            (parameter, value.to_bits()),
            ("spectral_radius", spectral_radius.to_bits())
        );
    }
}

/// The largest energy of an oscillator over that of its start, less one, by steps of `angle` periods over 2 pi, from all
/// phases.
fn largest_gain(angle: f64) -> f64 {
    let formula = GeneralizedAlpha::default().update_formula(1.0);
    let square = angle * angle;
    let energy = |at: Motion| at.velocity.powi(2) + square * at.displacement.powi(2);
    let mut largest = 0.0_f64;
    for phase in 0..90 {
        let (sin, cos) = (std::f64::consts::PI * f64::from(phase) / 90.0).sin_cos();
        let mut at = Motion {
            displacement: cos / angle,
            velocity: sin,
            acceleration: -angle * cos,
            algorithmic: 0.0,
        };
        for _ in 0..200 {
            // The new velocity at which the acceleration balances the spring.
            let lacking = |v: f64| {
                let to = formula.motion(at, v);
                to.acceleration + square * to.displacement
            };
            let (rest, one) = (lacking(0.0), lacking(1.0));
            at = formula.motion(at, rest / (rest - one));
            largest = largest.max(energy(at) - 1.0);
        }
    }
    largest
}

/// The energy of the documentation: of a wave that the step resolves it hardly exceeds that of the start.
#[test]
fn the_energy_of_a_resolved_wave_hardly_grows() {
    assert!(largest_gain(0.1) < 1e-7);
    assert!(largest_gain(0.7) < 1e-4);
    let coarse = [1.0, 2.0, 5.0].map(largest_gain);
    for (gain, bound) in coarse.into_iter().zip([3e-4, 3e-3, 3e-2]) {
        assert!(gain < bound && gain > bound / 2.0, "{gain:e}, {bound:e}");
    }
}

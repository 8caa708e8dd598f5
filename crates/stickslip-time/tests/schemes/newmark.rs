//! Newmark's formulas.

use proptest::prelude::*;
use stickslip_time::{Motion, Newmark, RateScheme, TimeError};

proptest! {
    #[test]
    fn satisfies_both_defining_equations(
        beta in 0.01..1.0_f64, gamma in 0.01..1.0_f64, dt in 1e-6..1e3_f64,
        u in -1.0..1.0_f64, v in -1.0..1.0_f64, a in -1.0..1.0_f64, new in -1.0..1.0_f64,
    ) {
        let scheme = Newmark { beta, gamma };
        let from = Motion { displacement: u, velocity: v, acceleration: a, algorithmic: 0.0 };
        let to = scheme.update_formula(dt).motion(from, new);
        let rate = v + dt * ((1.0 - gamma) * a + gamma * to.acceleration);
        let place = u + dt * v + dt * dt * ((0.5 - beta) * a + beta * to.acceleration);
        prop_assert!((rate - new).abs() < 1e-10 * (1.0 + dt));
        let scale = 1.0 + dt * dt * (1.0 + to.acceleration.abs());
        prop_assert!((place - to.displacement).abs() < 1e-12 * scale);
    }
}

#[test]
fn rejects_an_explicit_member() {
    let explicit = Newmark {
        beta: 0.0,
        gamma: 0.5,
    };
    let Err(TimeError {
        scheme,
        parameter,
        range,
        value,
        ..
    }) = explicit.validate()
    else {
        panic!("accepted");
    };
    assert_eq!((scheme, parameter, range), ("Newmark", "beta", "(0, 1]"));
    assert_eq!(value, 0.0);
    assert!(
        Newmark {
            beta: 0.25,
            gamma: f64::NAN
        }
        .validate()
        .is_err()
    );
}

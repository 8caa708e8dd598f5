//! The composite law of Sato, Nakatani and Ando.

use proptest::prelude::*;
use stickslip_state::{Dieterich, LogTheta, Ruina, Sato, StateLaw, check_state_law};

use crate::common::{cases, decades, log_theta};

const SLIP_DISTANCE: f64 = 1e-5;

#[test]
fn the_law_conforms() {
    let ordinary = [-20.0, -10.0, -1.0, 0.0, 2.0, 20.0];
    let extreme = [-800.0, -300.0, -40.0, 40.0, 300.0, 800.0];
    for values in [ordinary, extreme] {
        let states = values.map(LogTheta);
        for slip_distance in [1e-12, 1e-5, 1e-2, 1.0] {
            for threshold in [1e-4, Sato::THRESHOLD, 1.0] {
                let law = Sato {
                    slip_distance,
                    threshold,
                };
                check_state_law(&law, &states).unwrap_or_else(|e| panic!("{law:?}: {e}"));
            }
        }
    }
}

#[test]
fn unusable_parameters_are_refused() {
    for bad in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let law = Sato {
            threshold: bad,
            ..Sato::new(SLIP_DISTANCE)
        };
        assert!(law.validate().is_err() && Sato::new(bad).validate().is_err());
    }
}

/// Steps of second order against the classical Runge-Kutta method for `ln theta` by the published law.
#[test]
fn steps_are_of_second_order() {
    let law = Sato::new(SLIP_DISTANCE);
    for (rate, theta, time) in [
        (0.0, 1.0, 10.0),
        (1e-9, 1.0, 300.0),
        (1e-6, 100.0, 5.0),
        (1e-6, 0.01, 3.0),
    ] {
        let f = |alpha: f64| {
            let ratio = rate * f64::exp(alpha) / SLIP_DISTANCE;
            let slip = if ratio > 0.0 { ratio * ratio.ln() } else { 0.0 };
            (f64::exp(-ratio / 0.01) - slip) / f64::exp(alpha)
        };
        let h = time / 40_000.0;
        let want = (0..40_000).fold(f64::ln(theta), |x, _| {
            let k1 = f(x);
            let k2 = f(x + 0.5 * h * k1);
            let k3 = f(x + 0.5 * h * k2);
            x + h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + f(x + h * k3))
        });
        let errors = [128, 256, 512].map(|steps| {
            let dt = time / f64::from(steps);
            let end = (0..steps).fold(LogTheta(theta.ln()), |state, _| {
                law.advance_at_constant_rate(state, rate, dt)
                    .expect("a step")
            });
            (end.0 - want).abs()
        });
        for pair in errors.windows(2) {
            let order = (pair[0] / pair[1]).log2();
            assert!(order > 1.8 || pair[1] < 1e-11, "{rate} {theta}: {errors:?}");
        }
    }
}

proptest! {
    #![proptest_config(cases(2000))]

    /// Aging far below the threshold, the slip law far above; between both elsewhere.
    #[test]
    fn the_law_has_both_limits(ratio in decades(-12.0..4.0), rate in decades(-14.0..1.0)) {
        let law = Sato::new(SLIP_DISTANCE);
        let alpha = LogTheta((ratio * SLIP_DISTANCE / rate).ln());
        let theta = alpha.0.exp();
        let (found, aging, slip) = (
            law.evolution(alpha, rate) * theta,
            1.0,
            Ruina { slip_distance: SLIP_DISTANCE }.evolution(alpha, rate) * theta,
        );
        // The logarithm of W is a difference of two.
        let rounding = 1e-13 * (1.0 + ratio);
        prop_assert!(found >= slip - rounding && found <= slip + aging + rounding);
        if ratio < 1e-9 {
            let whole = Dieterich { slip_distance: SLIP_DISTANCE }.evolution(alpha, rate) * theta;
            prop_assert!((found - whole).abs() < 200.0 * ratio + ratio * ratio.ln().abs() + rounding);
        }
        if ratio > 0.4 {
            prop_assert!((found - slip).abs() < 1e-15 + rounding);
        }
    }

    #[test]
    fn steps_of_any_size_are_finite(
        from in log_theta(), rate in prop_oneof![Just(0.0), decades(-30.0..2.0)], dt in decades(-9.0..15.5), beta in decades(-4.0..1.0),
    ) {
        let law = Sato { slip_distance: SLIP_DISTANCE, threshold: beta };
        for to in [law.advance(LogTheta(from), rate, dt), law.advance_at_constant_rate(LogTheta(from), rate, dt)] {
            let to = to.expect("a step");
            let slopes = [
                law.advance_rate_slope(LogTheta(from), to, rate, dt),
                law.advance_at_constant_rate_rate_slope(LogTheta(from), to, rate, dt),
            ];
            prop_assert!(to.0.is_finite() && slopes.iter().all(|slope| slope.is_finite()), "{to:?} {slopes:?}");
        }
    }
}

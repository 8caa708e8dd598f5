//! Closed forms against the generic step, and what every state law must satisfy.

use crate::common::{WithoutExact, cases, decades, log_theta};
use proptest::prelude::*;
use stickslip_state::{
    Dieterich, Discontinuous, LogTheta, Ruina, StateError, StateLaw, StateVariable, Theta,
};

fn stepped<T: StateLaw>(law: &T, from: f64, slip_rate: f64, dt: f64) -> f64 {
    law.advance(T::State::from_value(from), slip_rate, dt)
        .expect("a step")
        .value()
}

fn exact<T: StateLaw>(law: &T, from: f64, slip_rate: f64, dt: f64) -> f64 {
    law.advance_exact(T::State::from_value(from), slip_rate, dt)
        .expect("a closed form")
        .value()
}

fn slip_rate() -> impl Strategy<Value = f64> {
    prop_oneof![
        Just(0.0),
        Just(5e-324),
        Just(1e-310),
        decades(-300.0..10.0),
        decades(-12.0..0.0)
    ]
}

/// The shift of the root of `alpha - from - dt g` by rounding, for a law with `slope = dg/dalpha`.
fn noise(terms: &[f64], dt: f64, slope: f64) -> f64 {
    terms.iter().map(|t| t.abs()).sum::<f64>() * f64::EPSILON / (1.0 - dt * slope)
}

/// The closed form is a difference of two logarithms, `ln dt` and another one near it, where the change is large.
fn dieterich_agrees(
    from: f64,
    slip_rate: f64,
    dt: f64,
    slip_distance: f64,
) -> Result<(), TestCaseError> {
    let law = Dieterich { slip_distance };
    let alpha = stepped(&law, from, slip_rate, dt);
    let generic = stepped(&WithoutExact(law), from, slip_rate, dt);
    let aged = dt * (-alpha).exp();
    let slope = law.evolution_state_slope(LogTheta(alpha), slip_rate);
    let terms = [alpha, from, aged, dt * slip_rate / slip_distance];
    let noise = noise(&terms, dt, slope);
    let logarithms = 2.0 * f64::EPSILON * dt.ln().abs();
    let bound = 4.0 * noise + 8.0 * f64::EPSILON * alpha.abs() + logarithms;
    prop_assert!(
        (alpha - generic).abs() <= bound,
        "{alpha} {generic} {bound:e}"
    );
    Ok(())
}

#[test]
fn dieterich_agrees_where_two_logarithms_cancel() {
    let (from, slip_rate) = (18.93584119799503, 6.745159354116282e-5);
    let agrees = dieterich_agrees(from, slip_rate, 7629.859174996456, 6.185931544897355e-5);
    assert!(agrees.is_ok(), "{agrees:?}");
}

proptest! {
    #![proptest_config(cases(2000))]

    #[test]
    fn dieterich_agrees_with_the_generic_step(
        from in log_theta(), slip_rate in slip_rate(), dt in decades(-12.0..6.0),
        slip_distance in decades(-12.0..0.0),
    ) {
        dieterich_agrees(from, slip_rate, dt, slip_distance)?;
    }

    #[test]
    fn ruina_agrees_with_the_generic_step(
        from in log_theta(), slip_rate in slip_rate(), dt in decades(-12.0..6.0),
        slip_distance in decades(-12.0..0.0),
    ) {
        let law = Ruina { slip_distance };
        let alpha = stepped(&law, from, slip_rate, dt);
        let generic = stepped(&WithoutExact(law), from, slip_rate, dt);
        let c = dt * slip_rate / slip_distance;
        let pull = if c > 0.0 { c * (slip_rate / slip_distance).ln() } else { 0.0 };
        let noise = noise(&[alpha, from, pull, c * alpha], dt, -slip_rate / slip_distance);
        prop_assert!((alpha - generic).abs() <= 4.0 * noise + 8.0 * f64::EPSILON * alpha.abs(), "{alpha} {generic} {noise:e}");
    }

    #[test]
    fn discontinuous_agrees_with_the_generic_step(
        from in decades(-13.0..13.0), slip_rate in slip_rate(), dt in decades(-12.0..6.0),
    ) {
        let theta = stepped(&Discontinuous, from, slip_rate, dt);
        let generic = stepped(&WithoutExact(Discontinuous), from, slip_rate, dt);
        let noise = noise(&[theta, from, dt * slip_rate], 0.0, 0.0);
        prop_assert!((theta - generic).abs() <= 4.0 * noise, "{theta} {generic}");
    }

    #[test]
    fn exact_steps_compose(
        from in log_theta(), slip_rate in slip_rate(), dt in decades(-12.0..6.0),
        fraction in 0.0..1.0, slip_distance in decades(-12.0..0.0),
    ) {
        let (first, second) = (fraction * dt, (1.0 - fraction) * dt);
        let c = dt * slip_rate / slip_distance;
        let tolerance = 1e-14 * (from.abs() + 100.0 + c.min(1e3));
        macro_rules! check {
            ($law:expr, $from:expr, $tolerance:expr) => {
                let (whole, halves) = (exact(&$law, $from, slip_rate, dt),
                    exact(&$law, exact(&$law, $from, slip_rate, first), slip_rate, second));
                prop_assert!((whole - halves).abs() <= $tolerance, "{whole} {halves}");
            };
        }
        check!(Dieterich { slip_distance }, from, tolerance);
        check!(Ruina { slip_distance }, from, 10.0 * tolerance);
        let theta = from.abs();
        check!(Discontinuous, theta, 1e-15 * (theta + dt * slip_rate));
    }

    #[test]
    fn order_is_preserved(
        from in log_theta(), slip_rate in slip_rate(), dt in decades(-12.0..6.0),
        distance in decades(-9.0..2.0), slip_distance in decades(-12.0..0.0),
    ) {
        macro_rules! check {
            ($law:expr) => {
                for step in [stepped, exact] {
                    let (low, high) = (step(&$law, from, slip_rate, dt), step(&$law, from + distance, slip_rate, dt));
                    prop_assert!(low <= high + 1e-15 * (low.abs() + from.abs()), "{low} {high}");
                }
            };
        }
        check!(Dieterich { slip_distance });
        check!(Ruina { slip_distance });
        check!(Discontinuous);
        // Dieterich's state also falls with the slip rate.
        let law = Dieterich { slip_distance };
        for step in [stepped, exact] {
            let (slow, fast) = (step(&law, from, slip_rate, dt), step(&law, from, slip_rate * (1.0 + distance), dt));
            prop_assert!(fast <= slow + 1e-14 * (slow.abs() + from.abs()), "{slow} {fast}");
        }
    }

    #[test]
    fn slopes_match_differences(alpha in -20.0..20.0f64, slip_rate in slip_rate()) {
        fn check<T: StateLaw>(law: &T, at: f64, slip_rate: f64) -> (f64, f64) {
            let h = 1e-5;
            let g = |x| law.evolution(T::State::from_value(x), slip_rate);
            ((g(at + h) - g(at - h)) / (2.0 * h), law.evolution_state_slope(T::State::from_value(at), slip_rate))
        }
        let slip_distance = 1e-5;
        for (difference, slope) in [
            check(&Dieterich { slip_distance }, alpha, slip_rate),
            check(&Ruina { slip_distance }, alpha, slip_rate),
        ] {
            let tolerance = 1e-8 * slope.abs() + 1e-9 * slip_rate / slip_distance + 1e-9;
            prop_assert!((difference - slope).abs() <= tolerance, "{difference} {slope}");
            prop_assert!(slope <= 0.0);
        }
    }
}

#[test]
fn at_rest_only_dieterich_ages() {
    let slip_distance = 1e-5;
    for from in [-800.0, -1.0, 0.0, 1.0, 800.0] {
        for dt in [0.0, 1e-12, 1.0, 1e6] {
            for step in [stepped, exact] {
                assert_eq!(step(&Ruina { slip_distance }, from, 0.0, dt), from);
            }
            assert_eq!(exact(&Discontinuous, from, 0.0, dt), from);
            let aged = exact(&Dieterich { slip_distance }, from, 0.0, dt);
            assert!(aged >= from && aged >= dt.ln());
        }
        assert_eq!(stepped(&Dieterich { slip_distance }, from, 1.0, 0.0), from);
    }
}

#[test]
fn long_steps_end_in_the_steady_state() {
    let (slip_distance, slip_rate) = (1e-5, 1e-3);
    for step in [stepped, stepped, exact] {
        assert!(
            (step(&Dieterich { slip_distance }, 5.0, slip_rate, 1e18) + 100f64.ln()).abs() < 1e-14
        );
    }
    assert!((exact(&Ruina { slip_distance }, 5.0, slip_rate, 1e18) + 100f64.ln()).abs() < 1e-14);
    assert_eq!(stepped(&Discontinuous, 5.0, slip_rate, 1e18), 1e3);
}

#[test]
fn exact_steps_solve_the_equation() {
    let (slip_distance, slip_rate, dt) = (1e-5, 1e-6, 1e-4);
    for from in [-3.0, 0.0, 3.0] {
        macro_rules! check {
            ($law:expr) => {
                let ahead = exact(&$law, from, slip_rate, dt);
                let middle = exact(&$law, from, slip_rate, dt / 2.0);
                let rate = $law.evolution(LogTheta(middle), slip_rate);
                assert!((ahead - from - dt * rate).abs() < 1e-8 * (dt * rate).abs());
            };
        }
        check!(Ruina { slip_distance });
    }
    // Dieterich through theta' = 1 - V theta / L, whose midpoint error is (V dt / L)^2 / 24.
    let theta = |dt: f64| exact(&Dieterich { slip_distance }, 3.0, slip_rate, dt).exp();
    let rate = 1.0 - slip_rate * theta(dt / 2.0) / slip_distance;
    assert!((theta(dt) - theta(0.0) - dt * rate).abs() < 1e-12);
}

#[test]
fn bad_input_is_an_error_with_its_numbers() {
    for value in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert!(matches!(
            Dieterich {
                slip_distance: value
            }
            .validate(),
            Err(StateError::Value {
                what: "slip_distance",
                requirement: "finite and positive",
                ..
            })
        ));
        assert!(
            Ruina {
                slip_distance: value
            }
            .validate()
            .is_err()
        );
    }
    assert_eq!(
        Dieterich {
            slip_distance: 1e-5
        }
        .validate(),
        Ok(())
    );
    assert_eq!(Discontinuous.validate(), Ok(()));

    let law: Box<dyn StateLaw<State = LogTheta>> = Box::new(Dieterich {
        slip_distance: 1e-5,
    });
    let generic = WithoutExact(&law);
    for law in [&law as &dyn StateLaw<State = LogTheta>, &generic] {
        let from = LogTheta(0.0);
        assert_eq!(
            law.advance(from, -1.0, 1.0),
            Err(StateError::Value {
                what: "slip rate [m/s]",
                requirement: "finite and non-negative",
                value: -1.0
            })
        );
        assert!(law.advance(from, f64::INFINITY, 1.0).is_err());
        assert_eq!(
            law.advance(from, 1.0, -1.0),
            Err(StateError::Value {
                what: "time step [s]",
                requirement: "finite and non-negative",
                value: -1.0
            })
        );
        assert!(law.advance(from, 1.0, f64::NAN).is_err());
    }
    let error = generic
        .advance(LogTheta(f64::NAN), 1e-6, 0.5)
        .expect_err("NaN");
    assert_eq!(
        error.to_string(),
        "state NaN cannot be advanced by 0.5 s at 1e-6 m/s: the residual is NaN at state NaN; reduce dt"
    );
}

#[test]
fn state_variables_convert() {
    assert_eq!(LogTheta::from(Theta(1.0)), LogTheta(0.0));
    assert_eq!(Theta::from(LogTheta(0.0)), Theta(1.0));
    assert_eq!(Theta::from_value(2.0).value(), 2.0);
    assert_eq!(().value(), 0.0);
    assert_eq!(().advance((), 1.0, 1.0), Ok(()));
}

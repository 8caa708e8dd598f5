//! Closed forms against the generic solver, functions against their derivatives.

use crate::common::{Generic, SLIDER, cases, decades, default_slope_error};
use proptest::prelude::*;
use stickslip_friction::{
    DieterichRuina, FrictionLaw, Nodal, RegularizedDieterichRuina, StateDependentTresca, Tresca,
};
use stickslip_state::{LogTheta, Theta};

const TRESCA: StateDependentTresca = StateDependentTresca {
    reference_friction: 0.6,
    b: 0.015,
    reference_velocity: 1e-6,
    slip_distance: 1e-5,
};

/// The state at which the cut-off rate has a given logarithm.
fn at_cutoff(law: &DieterichRuina, ln_cutoff_rate: f64) -> LogTheta {
    let strength = (law.reference_velocity.ln() - ln_cutoff_rate) * law.a;
    let aging = (law.reference_velocity / law.slip_distance).ln();
    LogTheta((strength - law.reference_friction) / law.b - aging)
}

fn ln_cutoff_rate() -> impl Strategy<Value = f64> {
    prop_oneof![-1000.0..1000.0, -100.0..0.0]
}

/// A number that is no nearer to a kink than a step of a difference.
fn beside(kink: f64, below: f64, above: f64) -> impl Strategy<Value = f64> {
    prop_oneof![kink - below..kink - 0.05, kink + 0.05..kink + above]
}

/// The state at which `TRESCA` loses its friction: `alpha = ln(L/V0) - mu0/b`.
const FRICTIONLESS: f64 = std::f64::consts::LN_10 - 40.0;

/// The closed form against the default, at a rate `V` and a state with `ln(V/Vm) = t`.
fn check_state_slope(ln_rate: f64, t: f64) -> Result<(), TestCaseError> {
    let state = at_cutoff(&SLIDER, ln_rate - t);
    let rate = ln_rate.exp();
    let closed = SLIDER.coefficient_state_slope(rate, state);
    prop_assert_eq!(closed, if t > 0.0 { SLIDER.b } else { 0.0 });
    let coefficient = SLIDER.coefficient(rate, state);
    let aging = SLIDER.b * (state.0 - 10f64.ln());
    // Roundings of the age, its weight, the sum with mu0, its share of a, the sum with the rate and the product;
    // that of the logarithm of the rate is the same at all states.
    let strength = (SLIDER.reference_friction + aging).abs();
    let noise = f64::EPSILON * (aging.abs() + strength + coefficient);
    let bound = default_slope_error(state.0, (closed, coefficient), noise);
    let default = Generic(SLIDER).coefficient_state_slope(rate, state);
    prop_assert!(
        (closed - default).abs() <= bound,
        "{closed} {default} {bound:e}"
    );
    Ok(())
}

proptest! {
    #![proptest_config(cases(3000))]

    #[test]
    fn slip_rates_balance(
        ln_cutoff in ln_cutoff_rate(), viscosity in decades(-8.0..12.0),
        drive in prop_oneof![decades(-12.0..4.0), 0.0..3.0], a in decades(-4.0..-1.0),
    ) {
        let law = DieterichRuina { a, ..SLIDER };
        let state = at_cutoff(&law, ln_cutoff);
        let rate = law.slip_rate(viscosity, drive, state);
        prop_assert!(rate >= 0.0 && rate.is_finite());
        if rate == 0.0 {
            prop_assert!(drive <= law.coefficient(0.0, state) * (1.0 + 1e-12) + 1e-12);
        } else {
            let residual = viscosity * rate + law.coefficient(rate, state) - drive;
            // The terms of the sum, and what a rounding of ln V does.
            let size = drive + a * (ln_cutoff.abs() + rate.ln().abs() + 30.0);
            prop_assert!(residual.abs() <= 8.0 * f64::EPSILON * size, "{residual:e} {size:e} V {rate:e}");
        }
    }

    #[test]
    fn closed_form_agrees_with_the_generic_solver(
        ln_cutoff in ln_cutoff_rate(), viscosity in decades(-8.0..12.0),
        drive in prop_oneof![decades(-12.0..4.0), 0.0..3.0], a in decades(-4.0..-1.0),
    ) {
        let law = DieterichRuina { a, ..SLIDER };
        let state = at_cutoff(&law, ln_cutoff);
        let closed = law.slip_rate(viscosity, drive, state);
        let generic = Generic(law).slip_rate(viscosity, drive, state);
        let noise = drive / a + ln_cutoff.abs() + closed.max(f64::MIN_POSITIVE).ln().abs() + 30.0;
        let tolerance = 1e-14 * noise * closed + 1e-307;
        prop_assert!((closed - generic).abs() <= tolerance, "{closed:e} {generic:e}");
    }

    #[test]
    fn tresca_agrees_with_the_generic_solver(
        alpha in -100.0..100.0f64, viscosity in decades(-8.0..12.0), drive in 0.0..3.0f64,
    ) {
        let tresca = Tresca { coefficient: 0.6 };
        let (x, y) = (tresca.slip_rate(viscosity, drive, ()), Generic(tresca).slip_rate(viscosity, drive, ()));
        prop_assert!((x - y).abs() <= 1e-13 * (x + 1.0 / viscosity), "{x:e} {y:e}");
        let state = LogTheta(alpha);
        let (x, y) = (TRESCA.slip_rate(viscosity, drive, state), Generic(TRESCA).slip_rate(viscosity, drive, state));
        prop_assert!((x - y).abs() <= 1e-13 * (x + 1.0 / viscosity), "{x:e} {y:e}");
    }

    #[test]
    fn slopes_and_potentials_match_differences(ln_cutoff in -300.0..0.0f64, t in prop_oneof![-3.0..-1e-3f64, 1e-3..30.0]) {
        let state = at_cutoff(&SLIDER, ln_cutoff);
        let rate = (ln_cutoff + t).exp();
        let h = 1e-4 * rate;
        let slope = (SLIDER.coefficient(rate + h, state) - SLIDER.coefficient(rate - h, state)) / (2.0 * h);
        prop_assert!((slope - SLIDER.coefficient_rate_slope(rate, state)).abs() <= 1e-7 * 0.01 / rate);
        let force = (SLIDER.potential(rate + h, state) - SLIDER.potential(rate - h, state)) / (2.0 * h);
        let mu = SLIDER.coefficient(rate, state);
        prop_assert!((force - mu).abs() <= 1e-8 * (mu + 0.01), "{force} {mu}");
    }

    #[test]
    fn state_slopes_match_the_default(
        ln_rate in prop_oneof![-700.0..700.0f64, -100.0..0.0], t in beside(0.0, 30.0, 60.0),
        alpha in beside(FRICTIONLESS, 60.0, 140.0),
    ) {
        check_state_slope(ln_rate, t)?;
        let rate = ln_rate.exp();
        let (state, aging) = (LogTheta(alpha), alpha - 10f64.ln());
        let closed = TRESCA.coefficient_state_slope(rate, state);
        prop_assert_eq!(closed, if alpha > FRICTIONLESS { TRESCA.b } else { 0.0 });
        let coefficient = TRESCA.coefficient(rate, state);
        // Roundings of the age, its weight and the sum.
        let noise = 0.5 * f64::EPSILON * (2.0 * TRESCA.b * aging.abs() + coefficient);
        let bound = default_slope_error(alpha, (closed, coefficient), noise);
        let default = Generic(TRESCA).coefficient_state_slope(rate, state);
        prop_assert!((closed - default).abs() <= bound, "{closed} {default} {bound:e}");
        prop_assert_eq!(Tresca { coefficient: 0.6 }.coefficient_state_slope(rate, ()), 0.0);
        prop_assert_eq!(Generic(Tresca { coefficient: 0.6 }).coefficient_state_slope(rate, ()), 0.0);
    }

    /// A state that is a time has no scale but its own.
    #[test]
    fn state_slopes_of_times_are_relative(theta in decades(-20.0..20.0)) {
        struct Logarithmic;
        impl FrictionLaw for Logarithmic {
            type State = Theta;
            fn coefficient(&self, _: f64, Theta(theta): Theta) -> f64 {
                0.015 * (theta * 1e30).ln()
            }
            fn coefficient_rate_slope(&self, _: f64, _: Theta) -> f64 {
                0.0
            }
            fn potential(&self, slip_rate: f64, state: Theta) -> f64 {
                slip_rate * self.coefficient(slip_rate, state)
            }
        }
        let slope = Logarithmic.coefficient_state_slope(1.0, Theta(theta));
        prop_assert!((slope * theta / 0.015 - 1.0).abs() < 1e-6, "{slope:e}");
    }

    #[test]
    fn coefficients_are_monotone_and_potentials_convex(
        ln_cutoff in ln_cutoff_rate(), slow in decades(-300.0..2.0), ratio in decades(0.0..20.0),
    ) {
        let state = at_cutoff(&SLIDER, ln_cutoff);
        let fast = slow * ratio;
        let (mu, nu) = (SLIDER.coefficient(slow, state), SLIDER.coefficient(fast, state));
        prop_assert!(0.0 <= mu && mu <= nu);
        prop_assert!(SLIDER.coefficient(0.0, state) <= mu);
        let (p, q) = (SLIDER.potential(slow, state), SLIDER.potential(fast, state));
        let rounding = 1e-13 * (ln_cutoff.abs() + 700.0) * fast * 0.01;
        prop_assert!(p + mu * (fast - slow) <= q + rounding);
        prop_assert!(q - nu * (fast - slow) <= p + rounding);
    }
}

/// States next to zero, whose own size is no scale for a difference.
#[test]
fn state_slopes_match_the_default_next_to_zero() -> Result<(), TestCaseError> {
    check_state_slope(-70.35025432715237 + 1.1612928740908555, 1.1612928740908555)?;
    for t in [-1.0, 0.06, 1.0, 30.0] {
        for state in [-1e-3, -1e-9, 0.0, 1e-15, 1e-6, 0.1] {
            check_state_slope(SLIDER.ln_cutoff_rate(LogTheta(state)) + t, t)?;
        }
    }
    Ok(())
}

#[test]
fn the_potential_does_not_cancel_at_the_cutoff() {
    // ln Vm = 0 exactly, so that ln(V/Vm) is known.
    let law = DieterichRuina {
        a: 1.0,
        b: 0.0,
        reference_friction: 0.0,
        reference_velocity: 1.0,
        slip_distance: 1.0,
    };
    for t in [1e-100, 1e-15, 1e-9, 1e-3, 0.1, 0.2499, 0.2501, 0.5] {
        let rate = 1.0 + t;
        let t = rate - 1.0;
        // (1 + t) ln(1 + t) - t as its series.
        let series: f64 = (2..60)
            .rev()
            .map(|n| {
                let sign = if n % 2 == 0 { 1.0 } else { -1.0 };
                sign * f64::powi(t, n) / f64::from(n * (n - 1))
            })
            .sum();
        let potential = law.potential(rate, LogTheta(0.0));
        assert!(
            (potential - series).abs() <= 4e-15 * series,
            "{t}: {potential:e} {series:e}"
        );
    }
    assert_eq!(law.potential(0.5, LogTheta(0.0)), 0.0);
}

#[test]
fn extreme_states_stick_or_slide_freely() {
    let stuck = at_cutoff(&SLIDER, -1000.0);
    assert!(SLIDER.ln_cutoff_rate(stuck) < -999.0);
    assert_eq!(SLIDER.slip_rate(1.0, 1.0, stuck), 0.0);
    assert!(SLIDER.coefficient(0.0, stuck) > 1.0);
    assert_eq!(SLIDER.coefficient_rate_slope(0.0, stuck), f64::INFINITY);
    assert_eq!(SLIDER.potential(0.0, stuck), 0.0);
    let free = at_cutoff(&SLIDER, 1000.0);
    assert_eq!(SLIDER.slip_rate(2.0, 1.0, free), 0.5);
    assert_eq!(SLIDER.coefficient(1e10, free), 0.0);
    // At ordinary states there is no friction at rest.
    let ordinary = LogTheta(-10.0);
    assert_eq!(SLIDER.coefficient(0.0, ordinary), 0.0);
    assert_eq!(SLIDER.coefficient_rate_slope(0.0, ordinary), 0.0);
    assert_eq!(SLIDER.slip_rate(1e6, 0.0, ordinary), 0.0);
}

#[test]
fn bad_parameters_are_errors_with_their_numbers() {
    assert_eq!(SLIDER.validate(), Ok(()));
    assert_eq!(TRESCA.validate(), Ok(()));
    for bad in [-1.0, f64::NAN, f64::INFINITY] {
        for law in [
            DieterichRuina { a: bad, ..SLIDER },
            DieterichRuina { b: bad, ..SLIDER },
            DieterichRuina {
                reference_friction: bad,
                ..SLIDER
            },
            DieterichRuina {
                reference_velocity: bad,
                ..SLIDER
            },
            DieterichRuina {
                slip_distance: bad,
                ..SLIDER
            },
        ] {
            assert!(law.validate().is_err(), "{law:?}");
        }
        assert!(Tresca { coefficient: bad }.validate().is_err());
        assert!(
            StateDependentTresca { b: bad, ..TRESCA }
                .validate()
                .is_err()
        );
        assert!(
            StateDependentTresca {
                slip_distance: bad,
                ..TRESCA
            }
            .validate()
            .is_err()
        );
    }
    let error = DieterichRuina { a: 0.0, ..SLIDER }
        .validate()
        .expect_err("a = 0");
    assert_eq!((error.what, error.value), ("a", 0.0));
    assert_eq!(error.to_string(), "a must be finite and positive, is 0");
}

#[test]
fn laws_work_behind_pointers() {
    let state = LogTheta(2.0);
    let boxed: Box<dyn FrictionLaw<State = LogTheta>> = Box::new(SLIDER);
    assert_eq!(
        boxed.slip_rate(1e3, 0.7, state),
        SLIDER.slip_rate(1e3, 0.7, state)
    );
    assert_eq!(
        FrictionLaw::coefficient(&&boxed, 1e-3, state),
        SLIDER.coefficient(1e-3, state)
    );
    let laws: Nodal<Box<dyn FrictionLaw<State = LogTheta>>> =
        vec![boxed, Box::new(TRESCA) as _].into();
    assert_eq!(laws.count(), Some(2));
    assert!(laws.iter().all(|law| law.validate().is_ok()));
    assert_eq!(laws.at(1).coefficient_rate_slope(1.0, state), 0.0);
}

#[test]
fn a_coefficient_that_is_nan_gives_nan() {
    let law = Generic(Tresca {
        coefficient: f64::NAN,
    });
    assert!(law.slip_rate(1.0, 1.0, ()).is_nan());
}

proptest! {
    /// Where all of them hold, the laws of one set of parameters agree: the regularised one at rates far above
    /// its cutoff, the one without rates at the reference rate; steady friction is that of the steady state.
    #[test]
    fn laws_of_the_same_parameters_agree(ln_rate in -25.0_f64..2.0, alpha in -5.0_f64..10.0) {
        let rate = ln_rate.exp();
        let state = LogTheta(alpha);
        let cut = SLIDER.coefficient(rate, state);
        // The cutoff is 1e-300 of these rates or less once friction is well above zero.
        if cut > 0.1 {
            let regular = RegularizedDieterichRuina::from(SLIDER).coefficient(rate, state);
            prop_assert!((cut - regular).abs() < 1e-8, "{cut}, {regular}");
        }
        let fixed = StateDependentTresca::from(SLIDER).coefficient(rate, state);
        let reference = SLIDER.coefficient(SLIDER.reference_velocity, state);
        prop_assert!((fixed - reference).abs() < 1e-14);
        let steady = LogTheta((SLIDER.slip_distance / rate).ln());
        let steady_coefficient = SLIDER.steady_coefficient(rate);
        prop_assert!((SLIDER.coefficient(rate, steady) - steady_coefficient).abs() < 1e-13);
    }
}

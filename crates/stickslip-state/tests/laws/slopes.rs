//! Slopes of steps against the defaults and differences, and the second-order default step.

use crate::common::{PerrinRiceZheng, WithoutExact, cases, decades, log_theta};
use proptest::prelude::*;
use stickslip_state::{Dieterich, Discontinuous, LogTheta, Ruina, StateLaw, StateVariable, Theta};

/// The law with its steps in closed form and its slopes by the defaults.
struct WithoutSlopes<T>(T);

impl<T: StateLaw> StateLaw for WithoutSlopes<T> {
    type State = T::State;

    fn evolution(&self, state: T::State, slip_rate: f64) -> f64 {
        self.0.evolution(state, slip_rate)
    }

    fn evolution_state_slope(&self, state: T::State, slip_rate: f64) -> f64 {
        self.0.evolution_state_slope(state, slip_rate)
    }

    fn advance(
        &self,
        from: T::State,
        slip_rate: f64,
        dt: f64,
    ) -> Result<T::State, stickslip_state::StateError> {
        self.0.advance(from, slip_rate, dt)
    }

    fn advance_exact(&self, from: T::State, slip_rate: f64, dt: f64) -> Option<T::State> {
        self.0.advance_exact(from, slip_rate, dt)
    }
}

fn euler<T: StateLaw>(law: &T, from: f64, rate: f64, dt: f64) -> f64 {
    law.advance(T::State::from_value(from), rate, dt)
        .expect("a step")
        .value()
}

fn second_order<T: StateLaw>(law: &T, from: f64, rate: f64, dt: f64) -> f64 {
    law.advance_at_constant_rate(T::State::from_value(from), rate, dt)
        .expect("a step")
        .value()
}

/// `V dalpha/dV` by the closed form, by the default, and by a difference of the step itself.
fn euler_slopes<T: StateLaw>(law: &T, from: f64, rate: f64, dt: f64) -> [f64; 3] {
    let (start, to) = (T::State::from_value(from), euler(law, from, rate, dt));
    let to = T::State::from_value(to);
    let h = 1e-5 * rate;
    let (low, high) = (rate - h, rate + h);
    let difference = (euler(law, from, high, dt) - euler(law, from, low, dt)) / (high - low);
    [
        rate * law.advance_rate_slope(start, to, rate, dt),
        rate * WithoutSlopes(law).advance_rate_slope(start, to, rate, dt),
        rate * difference,
    ]
}

fn constant_rate_slopes<T: StateLaw>(law: &T, from: f64, rate: f64, dt: f64) -> [f64; 2] {
    let start = T::State::from_value(from);
    let to = T::State::from_value(second_order(law, from, rate, dt));
    [
        rate * law.advance_at_constant_rate_rate_slope(start, to, rate, dt),
        rate * WithoutSlopes(law).advance_at_constant_rate_rate_slope(start, to, rate, dt),
    ]
}

/// The rounding error of a central difference with a relative step of 1e-5, for a sum of such terms.
fn noise(terms: &[f64]) -> f64 {
    2e-10 * terms.iter().map(|t| t.abs()).sum::<f64>()
}

proptest! {
    #![proptest_config(cases(3000))]

    #[test]
    fn euler_slopes_match(
        from in log_theta(), rate in decades(-300.0..10.0), dt in decades(-12.0..6.0),
        slip_distance in decades(-12.0..0.0),
    ) {
        let x = dt * rate / slip_distance;
        let pull = (rate / slip_distance).ln();
        let law = Dieterich { slip_distance };
        let to = euler(&law, from, rate, dt);
        let omega = (dt.ln() - to).exp();
        let [closed, default, difference] = euler_slopes(&law, from, rate, dt);
        let share = (x / (1.0 + omega)).min(1.0);
        let by_theorem = if omega.is_finite() { noise(&[(omega + x) / (1.0 + omega)]) } else { 1.0 };
        prop_assert!((closed - default).abs() <= by_theorem, "{closed:e} {default:e}");
        // Worn states are the difference from - x.
        let worn = from / (1.0 + omega);
        // h^2/6 times the third derivative in ln V, with d^2 alpha/dx^2 = omega/(1 + omega)^3.
        let bend = if omega.is_finite() { omega / (1.0 + omega).powi(3) } else { 0.0 };
        let truncation = 2e-11 * bend * (3.0 * x * x + x * x * x);
        prop_assert!((closed - difference).abs() <= noise(&[share, to, dt.ln(), worn]) + truncation, "{closed:e} {difference:e}");
        prop_assert!(closed <= 0.0);

        let law = Ruina { slip_distance };
        let to = euler(&law, from, rate, dt);
        let [closed, default, difference] = euler_slopes(&law, from, rate, dt);
        let terms = noise(&[x * (1.0 + pull.abs() + to.abs()) / (1.0 + x), 1e-3 * closed]);
        prop_assert!((closed - default).abs() <= terms, "{closed:e} {default:e}");
        prop_assert!((closed - difference).abs() <= terms + noise(&[to]), "{closed:e} {difference:e}");
    }

    #[test]
    fn slopes_at_constant_rate_match(
        from in log_theta(), rate in decades(-300.0..10.0), dt in decades(-12.0..6.0),
        slip_distance in decades(-12.0..0.0),
    ) {
        let x = dt * rate / slip_distance;
        let pull = (rate / slip_distance).ln();
        let dieterich = Dieterich { slip_distance };
        let to = second_order(&dieterich, from, rate, dt);
        let [closed, default] = constant_rate_slopes(&dieterich, from, rate, dt);
        // Where the worn and the healed part meet the third derivative in ln V is some x^3.
        let truncation = 2e-12 * x.min(2000.0).powi(3);
        prop_assert!((closed - default).abs() <= noise(&[to, from, 1.0]) + truncation, "{closed:e} {default:e}");
        prop_assert!(closed <= 0.0);

        let ruina = Ruina { slip_distance };
        let [closed, default] = constant_rate_slopes(&ruina, from, rate, dt);
        prop_assert!((closed - default).abs() <= noise(&[from, pull]), "{closed:e} {default:e}");
    }

    #[test]
    fn the_discontinuous_law_moves_with_the_rate(
        from in decades(-13.0..13.0), rate in decades(-13.0..10.0), dt in decades(-12.0..6.0),
    ) {
        let to = euler(&Discontinuous, from, rate, dt);
        let slope = Discontinuous.advance_rate_slope(Theta(from), Theta(to), rate, dt);
        let next = 1e-5 * rate;
        // Not across the corner where the way just suffices.
        let arrives = |rate: f64| (from - rate.recip()).abs() <= dt * rate;
        let turns = (from < (rate - next).recip()) != (from < (rate + next).recip());
        let corner = arrives(rate - next) != arrives(rate + next) || turns && !arrives(rate);
        let difference = (euler(&Discontinuous, from, rate + next, dt)
            - euler(&Discontinuous, from, rate - next, dt)) / (2.0 * next);
        prop_assert!(corner || (slope - difference).abs() * rate <= noise(&[to, dt * rate]), "{slope:e} {difference:e}");
        prop_assert_eq!(slope, Discontinuous.advance_at_constant_rate_rate_slope(Theta(from), Theta(to), rate, dt));
    }

    #[test]
    fn slopes_are_finite_everywhere(
        from in log_theta(),
        rate in prop_oneof![Just(0.0), Just(5e-324), Just(1e-310), decades(-300.0..10.0)],
        dt in prop_oneof![decades(-12.0..6.0), decades(6.0..280.0)],
        slip_distance in decades(-12.0..0.0),
    ) {
        fn check<T: StateLaw>(law: &T, from: f64, rate: f64, dt: f64) -> Result<(), TestCaseError> {
            let start = T::State::from_value(from);
            let to = law.advance(start, rate, dt).expect("a step");
            prop_assert!(law.advance_rate_slope(start, to, rate, dt).is_finite());
            let to = law.advance_at_constant_rate(start, rate, dt).expect("a step");
            prop_assert!(to.value().is_finite(), "{to:?}");
            prop_assert!(law.advance_at_constant_rate_rate_slope(start, to, rate, dt).is_finite());
            Ok(())
        }
        check(&Dieterich { slip_distance }, from, rate, dt)?;
        check(&Ruina { slip_distance }, from, rate, dt)?;
        check(&Discontinuous, from.abs(), rate, dt)?;
    }
}

#[test]
fn slopes_at_rest_are_those_from_the_right() {
    let law = Dieterich {
        slip_distance: 1e-5,
    };
    for from in [-700.0, -10.0, 0.0, 10.0, 700.0] {
        for dt in [1e-12, 1e-3, 1e6] {
            let to = LogTheta(euler(&law, from, 0.0, dt));
            let closed = law.advance_rate_slope(LogTheta(from), to, 0.0, dt);
            let default = WithoutSlopes(law).advance_rate_slope(LogTheta(from), to, 0.0, dt);
            assert!(
                (closed - default).abs() <= 1e-6 * closed.abs(),
                "{from} {dt}: {closed:e} {default:e}"
            );
        }
    }
    let to = LogTheta(second_order(&law, 2.0, 0.0, 1.0));
    let closed = law.advance_at_constant_rate_rate_slope(LogTheta(2.0), to, 0.0, 1.0);
    let default =
        WithoutSlopes(law).advance_at_constant_rate_rate_slope(LogTheta(2.0), to, 0.0, 1.0);
    assert!(
        (closed / default - 1.0).abs() < 1e-6,
        "{closed:e} {default:e}"
    );
    // theta' = 1 - (V theta / 2L)^2 has none.
    let law = PerrinRiceZheng {
        slip_distance: 1e-5,
    };
    for from in [1e-5, 1.0, 1e3] {
        let to = Theta(euler(&law, from, 0.0, 1.0));
        assert!(law.advance_rate_slope(Theta(from), to, 0.0, 1.0).abs() < 1e-2 * from / 1e-5);
    }
    // Ruina's is -ln V, and the same below the smallest normal rate.
    let law = Ruina { slip_distance: 1.0 };
    let at = |rate| law.advance_rate_slope(LogTheta(0.0), LogTheta(0.0), rate, 1.0);
    assert_eq!(at(0.0), at(f64::MIN_POSITIVE));
    assert!((at(1e-300) - (300.0 * 10f64.ln() - 1.0)).abs() < 1e-10);
    assert_eq!(().advance_rate_slope((), (), 1.0, 1.0), 0.0);
    assert_eq!(
        ().advance_at_constant_rate_rate_slope((), (), 1.0, 1.0),
        0.0
    );
}

#[test]
fn the_slope_of_a_user_law_is_that_of_its_step() {
    let law = PerrinRiceZheng {
        slip_distance: 1e-5,
    };
    for from in [1e-5, 1.0, 1e3] {
        for rate in [1e-12, 1e-6, 1e-3, 1.0] {
            for dt in [1e-6, 1e-2, 1e2] {
                let [slope, _, difference] = euler_slopes(&law, from, rate, dt);
                let to = euler(&law, from, rate, dt);
                assert!(
                    (slope - difference).abs() <= noise(&[to, slope]),
                    "{from} {rate} {dt}: {slope:e} {difference:e}"
                );
            }
        }
    }
}

/// Errors at time 1 with 16, 32, ... steps, against a solution known otherwise.
fn orders<T: StateLaw>(law: &T, from: f64, rate: f64, want: f64) -> Vec<f64> {
    let errors: Vec<f64> = [64, 128, 256]
        .map(|steps| {
            let dt = 1.0 / f64::from(steps);
            let end = (0..steps).fold(from, |x, _| second_order(law, x, rate, dt));
            (end - want).abs()
        })
        .into();
    errors
        .windows(2)
        .map(|pair| (pair[0] / pair[1]).log2())
        .collect()
}

#[test]
fn the_default_at_constant_rate_is_of_second_order() {
    let slip_distance = 1e-5;
    let mut measured = Vec::new();
    for (from, rate) in [(-1.0, 1e-5), (2.0, 3e-5), (0.5, 0.0)] {
        let law = Dieterich { slip_distance };
        let want = second_order(&law, from, rate, 1.0);
        measured.extend(orders(&WithoutExact(law), from, rate, want));
    }
    for (from, rate) in [(-1.0, 1e-5), (2.0, 3e-5)] {
        let law = Ruina { slip_distance };
        let want = second_order(&law, from, rate, 1.0);
        measured.extend(orders(&WithoutExact(law), from, rate, want));
    }
    for (from, rate) in [(0.1, 1e-5), (1.0, 1e-5)] {
        let law = PerrinRiceZheng { slip_distance };
        let r = rate / (2.0 * slip_distance);
        let want = (r + (r * from).atanh()).tanh() / r;
        measured.extend(orders(&law, from, rate, want));
    }
    println!("{measured:?}");
    for order in measured {
        assert!((1.9..2.1).contains(&order), "{order}");
    }
}

#[test]
fn stiff_steps_end_in_the_steady_state() {
    let (slip_distance, rate) = (1e-5, 1e-3);
    for dt in [1e6, 1e12, 1e18] {
        for from in [-20.0, 0.0, 20.0] {
            let alpha = second_order(&WithoutExact(Ruina { slip_distance }), from, rate, dt);
            assert!(
                (alpha + 100f64.ln()).abs() < 25.0 * slip_distance / (rate * dt),
                "{alpha}"
            );
            let alpha = second_order(&WithoutExact(Dieterich { slip_distance }), from, rate, dt);
            assert!((alpha + 100f64.ln()).abs() < 1e-6, "{alpha}");
        }
        for from in [0.0, 1e-5, 1.0, 1e3, 1e9] {
            let theta = second_order(&PerrinRiceZheng { slip_distance }, from, rate, dt);
            assert!((theta - 0.02).abs() < 1e-7, "{from} {dt}: {theta}");
        }
    }
}

#[test]
fn the_default_never_passes_the_steady_state() {
    let law = PerrinRiceZheng {
        slip_distance: 1e-5,
    };
    for from in [0.0, 1e-5, 0.3, 1.0, 5.0, 1e3] {
        for exponent in -60..60 {
            let dt = 10f64.powf(0.1 * f64::from(exponent));
            let theta = second_order(&law, from, 1e-5, dt);
            let (low, high) = if from < 2.0 { (from, 2.0) } else { (2.0, from) };
            let rounding = 1e-14 * high;
            assert!(
                low - rounding <= theta && theta <= high + rounding,
                "{from} {dt}: {theta}"
            );
        }
    }
}

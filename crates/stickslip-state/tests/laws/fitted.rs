//! The laws that experiments are fitted with, against their differential equations in `theta`.

use crate::common::{WithoutExact, cases, decades, log_theta};
use proptest::prelude::*;
use stickslip_state::{
    Dieterich, KatoTullis, LogTheta, Nagata, PerrinRiceZheng, Ruina, StateLaw, check_state_law,
};

const SLIP_DISTANCE: f64 = 1e-5;
const PERRIN: PerrinRiceZheng = PerrinRiceZheng {
    slip_distance: SLIP_DISTANCE,
};
const KATO: KatoTullis = KatoTullis {
    slip_distance: SLIP_DISTANCE,
    aging_velocity: 1e-8,
};
const NAGATA: Nagata = Nagata {
    slip_distance: SLIP_DISTANCE,
    stress_weight: 2.0,
    rate_over_state: 0.8,
    reference_velocity: 1e-6,
};

#[test]
fn they_conform() {
    for values in [
        &[-20.0, -10.0, -1.0, 0.0, 1e-9, 2.0, 20.0][..],
        &[-800.0, -300.0, -40.0, 40.0, 300.0, 800.0],
    ] {
        let states: Vec<LogTheta> = values.iter().copied().map(LogTheta).collect();
        for slip_distance in [1e-12, 1e-5, 1e-2, 1.0] {
            let law = PerrinRiceZheng { slip_distance };
            check_state_law(&law, &states).unwrap_or_else(|e| panic!("{law:?}: {e}"));
            check_state_law(&WithoutExact(law), &states).unwrap_or_else(|e| panic!("{law:?}: {e}"));
            for aging_velocity in [1e-12, 1e-8, 1.0] {
                let law = KatoTullis {
                    slip_distance,
                    aging_velocity,
                };
                check_state_law(&law, &states).unwrap_or_else(|e| panic!("{law:?}: {e}"));
            }
            for (stress_weight, rate_over_state) in [(2.0, 0.8), (1e-3, 0.1), (10.0, 1.0)] {
                let law = Nagata {
                    slip_distance,
                    stress_weight,
                    rate_over_state,
                    reference_velocity: 1e-6,
                };
                check_state_law(&law, &states).unwrap_or_else(|e| panic!("{law:?}: {e}"));
            }
        }
    }
}

#[test]
fn parameters_out_of_range_are_refused() {
    for bad in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert!(PerrinRiceZheng { slip_distance: bad }.validate().is_err());
        assert!(
            KatoTullis {
                slip_distance: bad,
                ..KATO
            }
            .validate()
            .is_err()
        );
        assert!(
            KatoTullis {
                aging_velocity: bad,
                ..KATO
            }
            .validate()
            .is_err()
        );
        for law in [
            Nagata {
                slip_distance: bad,
                ..NAGATA
            },
            Nagata {
                stress_weight: bad,
                ..NAGATA
            },
            Nagata {
                rate_over_state: bad,
                ..NAGATA
            },
            Nagata {
                reference_velocity: bad,
                ..NAGATA
            },
        ] {
            assert!(law.validate().is_err(), "{law:?}");
        }
    }
}

/// The classical Runge-Kutta method for `y' = f(t, y)`.
fn runge_kutta(f: impl Fn(f64, f64) -> f64, start: f64, time: f64, steps: u32) -> f64 {
    let h = time / f64::from(steps);
    (0..steps).fold(start, |y, n| {
        let t = h * f64::from(n);
        let k1 = f(t, y);
        let k2 = f(t + 0.5 * h, y + 0.5 * h * k1);
        let k3 = f(t + 0.5 * h, y + 0.5 * h * k2);
        let k4 = f(t + h, y + h * k3);
        y + h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4)
    })
}

/// The solution of `y' = f(t, y)` and what it is wrong by: an error of fourth order is a fifteenth of its change with
/// half the step; rounding adds some units a step.
fn solution(f: impl Fn(f64, f64) -> f64, start: f64, time: f64) -> (f64, f64) {
    const STEPS: u32 = 20_000;
    let coarse = runge_kutta(&f, start, time, STEPS);
    let fine = runge_kutta(&f, start, time, 2 * STEPS);
    let rounding = 2.0 * f64::from(STEPS) * f64::EPSILON * fine.abs().max(start.abs());
    (fine, (coarse - fine).abs() + rounding)
}

/// Rates, ages before and times of several changes of the contact.
const RUNS: [(f64, f64, f64); 6] = [
    (0.0, 1.0, 10.0),
    (1e-9, 1.0, 100.0),
    (1e-6, 100.0, 5.0),
    (1e-6, 0.1, 30.0),
    (1e-4, 1.0, 0.3),
    (3e-5, 20.0, 0.1),
];

#[test]
fn perrin_rice_and_zheng_is_solved_exactly() {
    for (rate, theta, time) in RUNS {
        let f = |_, y: f64| 1.0 - (rate * y / (2.0 * SLIP_DISTANCE)).powi(2);
        let (want, error) = solution(f, theta, time);
        let LogTheta(alpha) = PERRIN
            .advance_exact(LogTheta(theta.ln()), rate, time)
            .expect("a closed form");
        assert!(
            (alpha.exp() - want).abs() <= error,
            "{rate} {theta} {time}: {} {want} {error:e}",
            alpha.exp()
        );
    }
}

#[test]
fn kato_and_tullis_is_solved_to_second_order() {
    for (rate, theta, time) in RUNS {
        let f = |_, y: f64| {
            let x = rate * y / SLIP_DISTANCE;
            let slip = if x > 0.0 { x * x.ln() } else { 0.0 };
            (-rate / KATO.aging_velocity).exp() - slip
        };
        let (want, error) = solution(f, theta, time);
        let errors = [64, 128, 256].map(|steps| {
            let dt = time / f64::from(steps);
            let end = (0..steps).fold(LogTheta(theta.ln()), |state, _| {
                KATO.advance_at_constant_rate(state, rate, dt)
                    .expect("a step")
            });
            (end.0.exp() - want).abs()
        });
        for pair in errors.windows(2) {
            let order = (pair[0] / pair[1]).log2();
            assert!(
                order > 1.8 || pair[1] <= error,
                "{rate} {theta} {time}: {errors:?} {error:e}"
            );
        }
    }
}

#[test]
fn kato_and_tullis_ages_slowly_and_slips_fast() {
    // x ln x = 1 in slow sliding, x = 1 in fast sliding.
    let steady = |rate| {
        KATO.advance(LogTheta(0.0), rate, 1e30)
            .expect("a step")
            .0
            .exp()
    };
    let x = steady(1e-14) * 1e-14 / SLIP_DISTANCE;
    assert!((x * x.ln() - 1.0).abs() < 1e-5, "{x}");
    assert!((steady(1e-6) * 1e-6 / SLIP_DISTANCE - 1.0).abs() < 1e-13);
}

/// Slip rates that go up and down, under which stress does too.
fn rate_at(time: f64) -> f64 {
    1e-6 * (2.0 * (3.0 * time).sin()).exp()
}

#[test]
fn nagata_is_the_law_with_the_stress_rate() {
    let (a, b, c) = (0.008, 0.01, NAGATA.stress_weight);
    assert_eq!(NAGATA.rate_over_state, a / b);
    for theta in [0.1, 10.0, 1e3] {
        // theta' = 1 - V theta/L - (c/b) theta (a V'/V + b theta'/theta).
        let f = |time: f64, y: f64| {
            let growth = 6.0 * (3.0 * time).cos();
            (1.0 - rate_at(time) * y / SLIP_DISTANCE - c * a / b * y * growth) / (1.0 + c)
        };
        let (want, error) = solution(f, theta, 2.0);
        let g = |time, alpha| NAGATA.evolution(LogTheta(alpha), rate_at(time));
        let (alpha, alpha_error) = solution(g, NAGATA.state(theta, rate_at(0.0)).0, 2.0);
        let got = NAGATA.ln_theta(LogTheta(alpha), rate_at(2.0)).exp();
        let bound = error + alpha_error * want + 64.0 * f64::EPSILON * want;
        assert!((got - want).abs() <= bound, "{got} {want} {bound:e}");
    }
    // At constant rate in closed form.
    for (rate, theta, time) in RUNS.into_iter().filter(|run| run.0 > 0.0) {
        let f = |_, y: f64| (1.0 - rate * y / SLIP_DISTANCE) / (1.0 + c);
        let (want, error) = solution(f, theta, time);
        let alpha = NAGATA
            .advance_exact(NAGATA.state(theta, rate), rate, time)
            .expect("a closed form");
        let got = NAGATA.ln_theta(alpha, rate).exp();
        let bound = error + 64.0 * f64::EPSILON * want;
        assert!((got - want).abs() <= bound, "{got} {want} {bound:e}");
    }
}

proptest! {
    #![proptest_config(cases(1000))]

    /// A closed step of backward Euler against the generic one; what rounding shifts its root by.
    #[test]
    fn closed_steps_agree_with_the_generic_step(
        from in log_theta(), rate in decades(-14.0..2.0), dt in decades(-12.0..6.0),
        slip_distance in decades(-12.0..0.0), ratio in decades(-6.0..3.0),
    ) {
        let law = KatoTullis { slip_distance, aging_velocity: rate * ratio };
        let LogTheta(closed) = law.advance(LogTheta(from), rate, dt).expect("a step");
        let LogTheta(generic) = WithoutExact(law).advance(LogTheta(from), rate, dt).expect("a step");
        let (c, aged) = (dt * rate / slip_distance, dt * (-closed - 1.0 / ratio).exp());
        let logarithm = (rate / slip_distance).ln().abs() + rate.ln().abs() + slip_distance.ln().abs();
        // The terms of the equation over its slope; the exponent is a sum of rounded numbers.
        let exponent = closed.abs() + ratio.recip() + dt.ln().abs();
        let terms = closed.abs() + from.abs() + c * (closed.abs() + logarithm) + aged * (1.0 + exponent);
        let bound = 4.0 * f64::EPSILON * terms / (1.0 + c + aged) + 8.0 * f64::EPSILON * closed.abs();
        prop_assert!((closed - generic).abs() <= bound, "{closed} {generic} {bound:e}");
    }

    /// The composite law lies between the aging law and the slip law, whose terms it has.
    #[test]
    fn kato_and_tullis_is_no_younger_than_the_slip_law(
        from in -20.0..20.0f64, rate in decades(-12.0..0.0), dt in decades(-6.0..4.0),
    ) {
        let (slip, law) = (Ruina { slip_distance: SLIP_DISTANCE }, KATO);
        let LogTheta(younger) = slip.advance(LogTheta(from), rate, dt).expect("a step");
        let LogTheta(older) = law.advance(LogTheta(from), rate, dt).expect("a step");
        prop_assert!(younger <= older + 1e-13 * (1.0 + younger.abs()));
        let ages = Dieterich { slip_distance: SLIP_DISTANCE };
        prop_assert!(law.evolution(LogTheta(from), 0.0) == ages.evolution(LogTheta(from), 0.0));
    }
}

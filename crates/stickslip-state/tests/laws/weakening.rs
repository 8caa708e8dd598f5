//! Weakening by slip and in time.

use stickslip_state::{
    HealingSlipWeakening, SlipWeakening, StateError, StateLaw, StateVariable, TimeWeakening,
    Weakening,
};

/// Any steps at any rates add up to the slip, by either way to advance.
#[test]
fn slip_adds_up() {
    let law = SlipWeakening { slip_distance: 0.4 };
    let (mut euler, mut exact, mut slip) = (Weakening(0.0), Weakening(0.0), 0.0);
    for k in 0..1000 {
        let k = f64::from(k);
        let (rate, dt) = ((0.7 * k).sin().powi(2), 1e-3 * (1.0 + (1.3 * k).cos()));
        euler = law.advance(euler, rate, dt).expect("a valid step");
        exact = law
            .advance_at_constant_rate(exact, rate, dt)
            .expect("a valid step");
        slip += rate * dt;
    }
    // A thousand roundings of the sums.
    let rounding = 1000.0 * f64::EPSILON * slip / 0.4;
    assert!((euler.0 - slip / 0.4).abs() <= rounding);
    assert_eq!(euler, exact);
    assert_eq!(law.advance_rate_slope(euler, exact, 0.3, 0.2), 0.5);
}

#[test]
fn time_runs_at_any_slip_rate() {
    let law = TimeWeakening { duration: 0.5 };
    for rupture in [0.0, 0.75, 3.0] {
        let mut state = law.before(rupture);
        let mut time = 0.0;
        for k in 0..64 {
            state = law
                .advance(state, f64::from(k), 0.0625)
                .expect("a valid step");
            time += 0.0625;
            let expected = ((time - rupture) / 0.5).clamp(0.0, 1.0);
            assert_eq!(state.fraction(), expected);
        }
    }
    assert_eq!(
        law.advance_rate_slope(Weakening(0.1), Weakening(0.2), 1.0, 0.05),
        0.0
    );
}

/// Steps of any size at a rate follow the solution of the linear equation, those of backward Euler at first order; at rest
/// it decays, and without end it is slip weakening.
#[test]
fn strength_returns_within_the_healing_time() {
    let law = SlipWeakening { slip_distance: 0.4 }.healing(10.0);
    for k in 0..200 {
        let k = f64::from(k);
        let [w, rate, time] = [0.7, 1.1, 2.3].map(|f: f64| (f * k).sin().abs());
        let (start, rate, time) = (3.0 * w, rate.powi(3), 40.0 * time);
        let steady = rate * 10.0 / 0.4;
        let exact = steady + (start - steady) * (-time / 10.0).exp();
        let (mut large, mut euler) = (Weakening(start), Weakening(start));
        for share in [0.5, 0.2, 0.3] {
            large = (law.advance_at_constant_rate(large, rate, share * time)).expect("a step");
        }
        for _ in 0..4000 {
            euler = law.advance(euler, rate, time / 4000.0).expect("a step");
        }
        let scale = start + steady;
        assert!((large.0 - exact).abs() <= 1e-14 * scale);
        assert!((euler.0 - exact).abs() <= time / 4000.0 / 10.0 * scale);
        let endless = SlipWeakening { slip_distance: 0.4 }.healing(1e18);
        let slipped = endless
            .advance_exact(Weakening(start), rate, time)
            .expect("closed form");
        assert!((slipped.0 - start - rate * time / 0.4).abs() <= 1e-13 * (1.0 + slipped.0));
    }
    for bad in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let law = HealingSlipWeakening {
            slip_distance: 1.0,
            healing_time: bad,
        };
        let error = law.validate();
        assert!(matches!(
            error,
            Err(StateError::Value {
                what: "healing_time",
                ..
            })
        ));
    }
    assert!(law.validate_state(Weakening(-0.1)).is_err());
}

#[test]
fn states_count_by_their_effect() {
    let distance = |a: f64, b: f64| Weakening(a).distance(Weakening(b));
    assert_eq!(distance(0.25, 0.75), 0.5);
    assert_eq!(distance(-3.0, 0.5), 0.5);
    assert_eq!(distance(2.0, 5.0), 0.0);
}

#[test]
fn bad_parameters_and_states_are_refused() {
    for bad in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let slip = SlipWeakening { slip_distance: bad };
        let time = TimeWeakening { duration: bad };
        for (error, name) in [
            (slip.validate(), "slip_distance"),
            (time.validate(), "duration"),
        ] {
            assert!(matches!(error, Err(StateError::Value { what, .. }) if what == name));
        }
    }
    let slip = SlipWeakening { slip_distance: 1.0 };
    assert!(slip.validate_state(Weakening(-1e-3)).is_err());
    assert!(slip.validate_state(Weakening(f64::NAN)).is_err());
    assert_eq!(slip.validate_state(Weakening(0.0)), Ok(()));
    let time = TimeWeakening { duration: 1.0 };
    assert_eq!(time.validate_state(Weakening(-7.0)), Ok(()));
    // A vertex that never ruptures has no finite state.
    assert!(time.validate_state(time.before(f64::INFINITY)).is_err());
}

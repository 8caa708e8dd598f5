//! Friction that weakens by slip or in time.

use crate::common::{cases, decades};
use proptest::prelude::*;
use stickslip_friction::{ForcedRupture, FrictionLaw, LinearWeakening};
use stickslip_state::{SlipWeakening, StateLaw, TimeWeakening, Weakening};

const TPV5: LinearWeakening = LinearWeakening {
    static_friction: 0.677,
    dynamic_friction: 0.525,
};

#[test]
fn coefficients_are_those_of_the_formula() {
    let mu = |w| TPV5.coefficient(1.0, Weakening(w));
    assert_eq!((mu(-5.0), mu(0.0)), (0.677, 0.677));
    assert_eq!((mu(1.0), mu(1e9)), (0.525, 0.525));
    assert!((mu(0.25) - (0.677 - 0.25 * 0.152)).abs() < 1e-15);
    let slope = |w| TPV5.coefficient_state_slope(1.0, Weakening(w));
    assert_eq!((slope(-1e-9), slope(1.0)), (0.0, 0.0));
    assert!((slope(0.0) + 0.152).abs() < 1e-15 && slope(0.0) == slope(0.999));
}

/// Without weakening it is Coulomb friction.
#[test]
fn equal_coefficients_are_constant() {
    let law = LinearWeakening {
        static_friction: 0.4,
        dynamic_friction: 0.4,
    };
    for w in [-1.0, 0.0, 0.1, 0.5, 0.9, 2.0] {
        assert!((law.coefficient(1.0, Weakening(w)) - 0.4).abs() <= 1e-16);
    }
}

proptest! {
    #![proptest_config(cases(200))]

    /// The work above the dynamic strength is the area under the curve, whatever the steps: the trapezoidal rule is
    /// exact but in the step in which the curve bends.
    #[test]
    fn the_fracture_energy_is_the_area(
        steps in prop::collection::vec((decades(-3.0..0.0), decades(-3.0..0.0)), 50..200),
        distance in decades(-2.0..0.0),
    ) {
        let slip = SlipWeakening { slip_distance: distance };
        let normal_stress = 120e6;
        let strength = |w| normal_stress * TPV5.coefficient(0.0, w);
        let dynamic = normal_stress * TPV5.dynamic_friction;
        let (mut w, mut work, mut bend, mut total) = (Weakening(0.0), 0.0, 0.0, 0.0);
        // Slip enough in the end.
        for (rate, dt) in steps.into_iter().chain([(distance, 1.0)]) {
            let next = slip.advance(w, rate, dt).expect("a valid step");
            work += 0.5 * (strength(w) + strength(next) - 2.0 * dynamic) * rate * dt;
            if w.0 < 1.0 && next.0 > 1.0 {
                let (before, all) = ((1.0 - w.0) * distance, rate * dt);
                bend = 0.5 * (strength(w) - dynamic) * (all - before);
            }
            total += rate * dt;
            w = next;
        }
        let energy = TPV5.fracture_energy(normal_stress, distance);
        let rounding = 1e-13 * normal_stress * total;
        prop_assert!((work - bend - energy).abs() <= rounding, "{work} {bend} {energy}");
    }
}

/// A block of mass m per area under the stress `tau = sigma mu_s` and a little more slides by
/// `D = x (cosh(k t) - 1)`, `k^2 = sigma (mu_s - mu_d)/(D_c m)`, `x = (tau - sigma mu_s)/(m k^2)`, up to `D_c`; then
/// with a constant acceleration. Backward Euler, with the state after each step, converges to it with order one, and
/// the midpoint rule with order two.
#[test]
fn a_block_runs_away_as_it_must() {
    let slip = SlipWeakening { slip_distance: 0.4 };
    let (normal_stress, mass, distance) = (120e6_f64, 1e6_f64, 0.4_f64);
    let stress = 1.01 * normal_stress * TPV5.static_friction;
    let growth = (normal_stress * 0.152 / (distance * mass)).sqrt();
    let size = (stress - normal_stress * TPV5.static_friction) / (mass * growth * growth);
    let end = (1.0 + 0.9 * distance / size).acosh() / growth;
    let expected = size * ((growth * end).cosh() - 1.0);
    let error = |count: u32, midpoint: bool| {
        let dt = end / f64::from(count);
        let (mut w, mut rate, mut slipped) = (Weakening(0.0), 0.0, 0.0);
        for _ in 0..count {
            // The state follows the rate of the step: repeated until both agree.
            let mut mean = rate;
            for _ in 0..60 {
                let mut at = slip.advance(w, mean, dt).expect("a valid step");
                if midpoint {
                    at = Weakening(0.5 * (w.0 + at.0));
                }
                let share = if midpoint { 2.0 } else { 1.0 };
                let viscosity = share * mass / (dt * normal_stress);
                mean = TPV5.slip_rate(viscosity, stress / normal_stress + viscosity * rate, at);
            }
            w = slip.advance(w, mean, dt).expect("a valid step");
            slipped += mean * dt;
            rate = if midpoint { 2.0 * mean - rate } else { mean };
        }
        assert!((w.0 * distance - slipped).abs() < 1e-12);
        (slipped - expected).abs() / expected
    };
    for (midpoint, order) in [(false, 1.0), (true, 2.0)] {
        let [coarse, fine] = [200, 400].map(|count| error(count, midpoint));
        let measured = (coarse / fine).log2();
        assert!((measured - order).abs() < 0.1, "{measured}");
        assert!(fine < 0.05);
    }
}

/// Friction of a forced rupture is a ramp in time.
#[test]
fn a_forced_rupture_is_a_ramp() {
    let law = TimeWeakening { duration: 0.5 };
    let forced = ForcedRupture {
        rupture_time: 1.25,
        duration: 0.5,
    };
    let mut state = law.before(1.25);
    for k in 1..=40 {
        let time = 0.0625 * f64::from(k);
        state = law.advance(state, 3.0, 0.0625).expect("a valid step");
        assert_eq!(state, forced.weakening(time));
        let fallen = ((time - 1.25) / 0.5).clamp(0.0, 1.0);
        let mu = TPV5.coefficient(0.0, state);
        assert!((mu - (0.677 - 0.152 * fallen)).abs() < 1e-15);
    }
}

/// The larger of both weakenings is the smaller of both strengths.
#[test]
fn the_larger_weakening_counts() {
    let forced = ForcedRupture {
        rupture_time: 1.0,
        duration: 0.5,
    };
    assert_eq!(forced.validate(), Ok(()));
    let mu = |w| TPV5.coefficient(0.0, w);
    for time in [0.0, 0.9, 1.0, 1.1, 1.3, 1.5, 9.0] {
        for w in [0.0, 0.1, 0.3, 0.7, 1.0, 4.0].map(Weakening) {
            let both = forced.weakened(w, time);
            assert_eq!(mu(both), mu(w).min(mu(forced.weakening(time))));
            let h = 1e-3;
            let up = forced.weakened(Weakening(w.0 + h), time).0;
            let quotient = (up - both.0) / h;
            let slope = forced.slip_slope(w, time);
            assert!((quotient - slope).abs() < 1e-9 || slope == 0.0 && quotient > 0.0);
        }
    }
    let never = ForcedRupture {
        rupture_time: f64::INFINITY,
        duration: 0.5,
    };
    assert_eq!(never.validate(), Ok(()));
    assert_eq!(never.weakened(Weakening(0.2), 1e9), Weakening(0.2));
}

#[test]
fn bad_parameters_are_refused() {
    let error = |static_friction, dynamic_friction| {
        let law = LinearWeakening {
            static_friction,
            dynamic_friction,
        };
        law.validate()
            .map_err(|error| (error.what, error.requirement))
    };
    assert_eq!(error(0.6, 0.6), Ok(()));
    assert_eq!(
        error(0.5, 0.6),
        Err(("static_friction", "at least dynamic_friction"))
    );
    for bad in [-0.1, f64::NAN, f64::INFINITY] {
        assert_eq!(error(0.6, bad).map_err(|e| e.0), Err("dynamic_friction"));
        assert_eq!(error(bad, 0.1).map_err(|e| e.0), Err("static_friction"));
    }
    for (rupture_time, duration, name) in [
        (f64::NAN, 1.0, "rupture_time"),
        (1.0, 0.0, "duration"),
        (1.0, f64::INFINITY, "duration"),
    ] {
        let forced = ForcedRupture {
            rupture_time,
            duration,
        };
        assert_eq!(forced.validate().map_err(|error| error.what), Err(name));
    }
}

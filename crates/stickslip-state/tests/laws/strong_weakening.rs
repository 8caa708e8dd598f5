//! Strong rate weakening, and laws with the state in units of friction.

use proptest::prelude::*;
use stickslip_state::{
    Dieterich, InPsi, KatoTullis, LogTheta, Psi, Ruina, Sato, StateLaw, StrongWeakening,
    check_evolutions, check_state_law,
};

use crate::common::{cases, decades};

/// The law of TPV103 and TPV104.
const TPV103: StrongWeakening = StrongWeakening {
    a: 0.01,
    b: 0.014,
    reference_friction: 0.6,
    reference_velocity: 1e-6,
    slip_distance: 0.4,
    weakened_friction: 0.2,
    weakening_velocity: 0.1,
};

/// Any parameters, rocks among them.
fn laws() -> impl Strategy<Value = StrongWeakening> {
    let rocks = (0.004..0.03, 0.0..0.03, 0.2..0.9, 0.0..0.5);
    let any = (1e-4..1.0, 0.0..1.0, 0.0..1.5, 0.0..1.5);
    let rates = (decades(-9.0..-3.0), decades(-6.0..0.5), decades(-4.0..2.0));
    (prop_oneof![rocks, any], rates).prop_map(|((a, b, mu0, f_w), (v0, l, v_w))| StrongWeakening {
        a,
        b,
        reference_friction: mu0,
        reference_velocity: v0,
        slip_distance: l,
        weakened_friction: f_w,
        weakening_velocity: v_w,
    })
}

fn psi(law: &StrongWeakening, state: f64, rate: f64) -> f64 {
    law.evolution(Psi(state), rate)
}

/// Numbers of an independent computation.
#[test]
fn steady_states_of_the_benchmark() {
    for (rate, coefficient, state) in [
        (1e-12, 0.655262042, 0.793417148),
        (1e-9, 0.627631021, 0.696708574),
        (1e-6, 0.6, 0.6),
        (1e-3, 0.572368979, 0.503291426),
        (0.05, 0.556547088, 0.448349306),
        (0.1, 0.524572020, 0.409442766),
        (0.2, 0.375502306, 0.253441580),
        (1.0, 0.234473796, 0.096318690),
        (10.0, 0.203355276, 0.042174320),
    ] {
        let (found, Psi(psi)) = (TPV103.steady_coefficient(rate), TPV103.steady_state(rate));
        assert!((found - coefficient).abs() < 1e-9, "{rate}: {found}");
        assert!((psi - state).abs() < 1e-9, "{rate}: {psi}");
    }
    for (rate, state, expected) in [
        (1e-16, 0.5, 1.055904783e-16),
        (1e-3, 0.55, -1.167714348e-4),
        (1.0, 0.4, -0.7592032746),
        (1.0, 0.2, -0.2592032746),
    ] {
        let found = psi(&TPV103, state, rate);
        assert!((found / expected - 1.0).abs() < 1e-9, "{rate}: {found}");
    }
}

/// The critical stiffness of a slider, `-(sigma df_ss/d ln V + eta V)/L` \[Pa/m\], of an independent computation.
#[test]
fn critical_stiffness_is_that_of_steady_friction() {
    let (stress, damping) = (120e6, 4.624440e6);
    for (rate, expected) in [
        (1e-6, 1.199988e6),
        (0.05, 1.037563e6),
        (0.1, 4.863010e7),
        (0.2, 5.073331e7),
        (0.5, 1.531002e7),
    ] {
        let at = |h: f64| TPV103.steady_coefficient(rate * h.exp());
        let fall = (at(-1e-4) - at(1e-4)) / 2e-4;
        let found = (fall * stress - damping * rate) / TPV103.slip_distance;
        assert!((found / expected - 1.0).abs() < 1e-6, "{rate}: {found}");
    }
}

#[test]
fn unusable_parameters_are_refused() {
    for bad in [-1.0, f64::NAN, f64::INFINITY] {
        let law = TPV103;
        for law in [
            StrongWeakening { a: bad, ..law },
            StrongWeakening { b: bad, ..law },
            StrongWeakening {
                reference_friction: bad,
                ..law
            },
            StrongWeakening {
                reference_velocity: bad,
                ..law
            },
            StrongWeakening {
                slip_distance: bad,
                ..law
            },
            StrongWeakening {
                weakened_friction: bad,
                ..law
            },
            StrongWeakening {
                weakening_velocity: bad,
                ..law
            },
        ] {
            assert!(law.validate().is_err(), "{law:?}");
        }
        let aging = in_psi(Dieterich { slip_distance: 0.4 });
        for law in [
            InPsi { b: bad, ..aging },
            InPsi {
                reference_friction: bad,
                ..aging
            },
            InPsi {
                reference_velocity: bad,
                ..aging
            },
            InPsi {
                slip_distance: bad,
                ..aging
            },
            InPsi {
                law: Dieterich { slip_distance: bad },
                ..aging
            },
        ] {
            assert!(law.validate().is_err(), "{law:?}");
        }
        assert!(aging.validate_state(Psi(bad)).is_ok() == bad.is_finite());
    }
}

fn in_psi<T>(law: T) -> InPsi<T> {
    InPsi {
        law,
        b: 0.014,
        reference_friction: 0.6,
        reference_velocity: 1e-6,
        slip_distance: 0.4,
    }
}

#[test]
fn composite_laws_conform_in_units_of_friction() {
    let states = [-2.0, 0.1, 0.4, 0.6, 0.9, 3.0].map(Psi);
    let kato = KatoTullis {
        slip_distance: 0.4,
        aging_velocity: 1e-8,
    };
    check_state_law(&in_psi(kato), &states).expect("Kato and Tullis");
    check_state_law(&in_psi(Sato::new(0.4)), &states).expect("Sato, Nakatani and Ando");
}

proptest! {
    #![proptest_config(cases(300))]

    #[test]
    fn strong_weakening_conforms(law in laws(), states in prop::collection::vec(-1.0..2.0f64, 3)) {
        let states: Vec<_> = states.into_iter().map(Psi).collect();
        let checked = check_state_law(&law, &states);
        checked.map_err(|error| TestCaseError::fail(format!("{law:?}: {error}")))?;
    }

    /// Many nodes at a time, by laws of their own or one of all, against each by itself.
    #[test]
    fn passes_are_the_law_of_each_node(
        nodes in prop::collection::vec((laws(), -1.0..2.0f64, prop_oneof![Just(0.0), Just(5e-324), decades(-30.0..2.0), decades(-307.0..300.0)]), 1..100),
        at in any::<prop::sample::Index>(), one in any::<bool>(),
    ) {
        let count = if one { 1 } else { nodes.len() };
        let laws: Vec<_> = nodes[..count].iter().map(|node| node.0).collect();
        let states: Vec<_> = nodes.iter().map(|node| Psi(node.1)).collect();
        let slip_rates: Vec<_> = nodes.iter().map(|node| node.2).collect();
        let first = at.index(nodes.len());
        let mut rates = vec![0.0; nodes.len() - first];
        let many = StrongWeakening::evolutions(&laws).expect("passes");
        many.evolutions(first, &states[first..], &slip_rates[first..], &mut rates);
        for (k, found) in (first..).zip(rates) {
            let law = laws.get(k).unwrap_or(&laws[0]);
            let each = law.evolution(states[k], slip_rates[k]);
            // Friction rounds with its logarithms, and next to its least value by the share of that.
            let log = if slip_rates[k] > 0.0 { slip_rates[k].ln().abs() + 30.0 } else { 0.0 };
            let steady = law.steady_coefficient(slip_rates[k].max(f64::MIN_POSITIVE));
            let share = 1.0 + law.a / steady;
            let terms = (law.a + law.b) * log * share + 2.0 * law.reference_friction * share + states[k].0.abs();
            let bound = 16.0 * f64::EPSILON * terms * slip_rates[k] / law.slip_distance;
            // Both may overflow.
            prop_assert!(found == each || (found - each).abs() <= bound + f64::MIN_POSITIVE, "{k}: {found:e} {each:e} {law:?} {:e}", slip_rates[k]);
        }
        let checked = check_evolutions(&laws, &states[..count]);
        checked.map_err(|error| TestCaseError::fail(error.to_string()))?;
    }

    #[test]
    fn aging_and_slip_conform_in_units_of_friction(
        states in prop::collection::vec(-1.0..2.0f64, 3),
        (b, reference_friction) in (1e-3..0.1, 0.0..1.0),
        (reference_velocity, slip_distance) in (decades(-9.0..-3.0), decades(-6.0..0.5)),
    ) {
        let states: Vec<_> = states.into_iter().map(Psi).collect();
        let aging = InPsi { law: Dieterich { slip_distance }, b, reference_friction, reference_velocity, slip_distance };
        let checked = check_state_law(&aging, &states);
        checked.map_err(|error| TestCaseError::fail(format!("{aging:?}: {error}")))?;
        let slip = InPsi { law: Ruina { slip_distance }, b, reference_friction, reference_velocity, slip_distance };
        let checked = check_state_law(&slip, &states);
        checked.map_err(|error| TestCaseError::fail(format!("{slip:?}: {error}")))?;
    }
}

proptest! {
    #![proptest_config(cases(20_000))]

    /// From creep far below the plates' to impacts, over nanoseconds and a hundred million years.
    #[test]
    fn steps_are_finite_and_move_towards_steady_sliding(
        law in laws(), from in -1.0..2.0f64, rate in prop_oneof![Just(0.0), decades(-30.0..2.0)], dt in decades(-9.0..15.5),
    ) {
        let Psi(steady) = law.steady_state(rate.max(f64::MIN_POSITIVE));
        let rates = [psi(&law, from, rate), law.evolution_state_slope(Psi(from), rate), steady];
        prop_assert!(rates.iter().all(|rate| rate.is_finite()), "{rates:?}");
        let exact = law.advance_at_constant_rate(Psi(from), rate, dt).expect("a step");
        for to in [exact, law.advance(Psi(from), rate, dt).expect("a step")] {
            let slopes = [
                law.advance_rate_slope(Psi(from), to, rate, dt),
                law.advance_at_constant_rate_rate_slope(Psi(from), to, rate, dt),
            ];
            prop_assert!(slopes.iter().all(|slope| slope.is_finite()), "{slopes:?}");
            let rounding = 4.0 * f64::EPSILON * (from.abs() + steady.abs());
            let between = to.0 >= from.min(steady) - rounding && to.0 <= from.max(steady) + rounding;
            prop_assert!(between, "{from} {steady} {to:?}");
        }
    }

    /// Far below the weakening velocity the law is the slip law in units of friction, and so is steady friction.
    #[test]
    fn slow_sliding_is_that_of_the_slip_law(state in 0.0..1.0f64, log in -30.0..-5.0f64, mu0 in 0.4..0.8f64) {
        let law = StrongWeakening { weakening_velocity: 1.0, reference_friction: mu0, ..TPV103 };
        let slip = InPsi { reference_friction: mu0, ..in_psi(Ruina { slip_distance: 0.4 }) };
        let rate = 10f64.powf(log);
        let expected = slip.evolution(Psi(state), rate);
        // exp(-2 f_ss/a) is below 1e-30.
        prop_assert!((psi(&law, state, rate) - expected).abs() <= 1e-14 * rate / 0.4 * 2.0);
        let LogTheta(alpha) = slip.log_theta(law.steady_state(rate));
        prop_assert!((alpha - (0.4 / rate).ln()).abs() < 1e-11);
    }

    /// The formulas by themselves.
    #[test]
    fn laws_in_units_of_friction_are_their_formulas(state in 0.3..1.0f64, log in -14.0..1.0f64) {
        let (b, mu0, v0, l, rate) = (0.014, 0.6, 1e-6, 0.4, 10f64.powf(log));
        let aging = in_psi(Dieterich { slip_distance: l }).evolution(Psi(state), rate);
        let terms = [b * v0 / l * ((mu0 - state) / b).exp(), b * rate / l];
        prop_assert!((aging - (terms[0] - terms[1])).abs() <= 1e-13 * (terms[0] + terms[1]));
        let slip = in_psi(Ruina { slip_distance: l }).evolution(Psi(state), rate);
        let expected = -rate / l * (state - mu0 - b * (v0 / rate).ln());
        prop_assert!((slip - expected).abs() <= 1e-14 * rate / l);
    }
}

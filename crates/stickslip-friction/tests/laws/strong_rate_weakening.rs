//! Strong rate weakening, and friction that reads the state in units of friction.

use proptest::prelude::*;
use stickslip_friction::{
    FrictionLaw, Radial, RegularizedDieterichRuina, RegularizedInPsi, StrongRateWeakening,
    check_convex_potential, check_friction_law, check_slip_rates,
};
use stickslip_state::{LogTheta, Psi, StateLaw};

use crate::common::{cases, decades};

/// The law of TPV103 and TPV104.
const TPV103: StrongRateWeakening = StrongRateWeakening {
    a: 0.01,
    b: 0.014,
    reference_friction: 0.6,
    reference_velocity: 1e-6,
    slip_distance: 0.4,
    weakened_friction: 0.2,
    weakening_velocity: 0.1,
};

/// Numbers of an independent computation.
#[test]
fn friction_of_the_benchmark() {
    for (rate, state, coefficient) in [
        (1e-16, 0.5, 0.269741490701),
        (1e-3, 0.55, 0.619077552790),
        (1.0, 0.4, 0.538155105580),
        (1.0, 0.2, 0.338155105580),
    ] {
        let found = TPV103.coefficient(rate, Psi(state));
        assert!((found - coefficient).abs() < 1e-11, "{rate}: {found}");
    }
    // The start: 40 MPa of 120 MPa at 1e-16 m/s, inside the fault and beyond.
    for (a, state) in [(0.01, 0.563591842633), (0.02, 0.793850351932)] {
        let law = StrongRateWeakening { a, ..TPV103 };
        let Psi(found) = law.state_of_friction(40.0 / 120.0, 1e-16);
        assert!((found - state).abs() < 1e-11, "{a}: {found}");
    }
}

/// Steady sliding with radiation damping, `sigma f_ss(V) + eta V = tau`: its least stress, and both roots above.
#[test]
fn steady_sliding_has_two_rates_above_the_pulse_stress() {
    let (normal, damping) = (120e6, 4.624440e6);
    let stress = |rate: f64| normal * TPV103.steady_coefficient(rate) + damping * rate;
    let bisected = |mut low: f64, mut high: f64, rises: bool, wanted: f64| {
        for _ in 0..200 {
            let middle = 0.5 * (low + high);
            if (stress(middle) < wanted) == rises {
                low = middle;
            } else {
                high = middle;
            }
        }
        low
    };
    let least = 0.951568;
    for (wanted, slow, fast) in [
        (35e6, 0.473655960, 1.915070134),
        (40e6, 0.285932221, 3.182572130),
        (50e6, 0.167044799, 5.461741623),
    ] {
        let found = [
            bisected(0.1, least, false, wanted),
            bisected(least, 100.0, true, wanted),
        ];
        for (found, expected) in found.into_iter().zip([slow, fast]) {
            assert!((found / expected - 1.0).abs() < 1e-8, "{wanted}: {found}");
        }
    }
    // From the weakening velocity to 1 km/s.
    let rates = (0..=40_000).map(|i| 10f64.powf(-1.0 + 1e-4 * f64::from(i)));
    let lowest = rates.map(stress).fold(f64::INFINITY, f64::min);
    assert!((lowest / 32.750383e6 - 1.0).abs() < 1e-7, "{lowest}");
    assert!(stress(least) < 32.7503835e6);
}

/// Friction in a steady state is steady friction, and an evolution that ends there balances it.
#[test]
fn steady_states_carry_steady_friction() {
    for exponent in -30..=2 {
        let rate = 10f64.powi(exponent);
        let state = TPV103.steady_state(rate);
        let (found, steady) = (
            TPV103.coefficient(rate, state),
            TPV103.steady_coefficient(rate),
        );
        assert!((found - steady).abs() < 1e-14, "{rate:e}: {found} {steady}");
        let change = TPV103.evolution().evolution(state, rate);
        assert!(change.abs() <= 1e-15 * rate / TPV103.slip_distance);
    }
}

#[test]
fn radial_potentials_of_strong_weakening_conform() {
    for state in [-0.5, 0.2, 0.6, 1.2].map(Psi) {
        let potential = Radial {
            law: TPV103,
            force: 1e6,
            state,
        };
        for speed in [1e-12, 1e-6, 1.0] {
            check_convex_potential::<_, 2>(&potential, speed, 6e5).expect("in the plane");
            check_convex_potential::<_, 3>(&potential, speed, 6e5).expect("in space");
        }
    }
}

#[test]
fn unusable_parameters_are_refused() {
    for bad in [-1.0, f64::NAN, f64::INFINITY] {
        for law in [
            StrongRateWeakening { a: bad, ..TPV103 },
            StrongRateWeakening { b: bad, ..TPV103 },
            StrongRateWeakening {
                reference_friction: bad,
                ..TPV103
            },
            StrongRateWeakening {
                reference_velocity: bad,
                ..TPV103
            },
            StrongRateWeakening {
                slip_distance: bad,
                ..TPV103
            },
            StrongRateWeakening {
                weakened_friction: bad,
                ..TPV103
            },
            StrongRateWeakening {
                weakening_velocity: bad,
                ..TPV103
            },
        ] {
            let refused = law.validate().expect_err("refused");
            assert!(refused.value.to_bits() == bad.to_bits(), "{refused}");
        }
        let law = RegularizedInPsi {
            a: 0.01,
            reference_velocity: 1e-6,
        };
        assert!(RegularizedInPsi { a: bad, ..law }.validate().is_err());
        assert!(
            RegularizedInPsi {
                reference_velocity: bad,
                ..law
            }
            .validate()
            .is_err()
        );
    }
}

/// A drive of friction at rest to the last bit, where `Vm` is next to the smallest normal number.
#[test]
fn a_drive_of_friction_at_rest_moves_nothing() {
    let law = RegularizedInPsi {
        a: 0.002364006254343847,
        reference_velocity: 1e-3,
    };
    let state = Psi(1.6605781888203985);
    let strength = law.coefficient(0.0, state);
    assert!(strength > 0.0);
    for viscosity in [1e-12, 1.0, 1e12] {
        assert_eq!(law.slip_rate(viscosity, strength, state), 0.0);
    }
    check_friction_law(&law, &[state]).expect("the contract");
}

/// Any parameters, rocks among them.
fn laws() -> impl Strategy<Value = StrongRateWeakening> {
    let rocks = (0.004..0.03, 0.0..0.03, 0.2..0.9, 0.0..0.5);
    let any = (1e-4..1.0, 0.0..1.0, 0.0..1.5, 0.0..1.5);
    let rates = (decades(-9.0..-3.0), decades(-6.0..0.5), decades(-4.0..2.0));
    (prop_oneof![rocks, any], rates).prop_map(
        |((a, b, reference_friction, weakened_friction), (v0, l, v_w))| StrongRateWeakening {
            a,
            b,
            reference_friction,
            reference_velocity: v0,
            slip_distance: l,
            weakened_friction,
            weakening_velocity: v_w,
        },
    )
}

proptest! {
    #![proptest_config(cases(200))]

    #[test]
    fn strong_rate_weakening_conforms(law in laws(), state in -1.0..2.0f64) {
        let checked = check_friction_law(&law, &[Psi(state)]);
        checked.map_err(|error| TestCaseError::fail(format!("{law:?}: {error}")))?;
    }

    #[test]
    fn many_nodes_conform(nodes in prop::collection::vec((laws(), 0.2..0.9f64, decades(-12.0..0.0)), 1..40), one in any::<bool>()) {
        let count = if one { 1 } else { nodes.len() };
        let laws: Vec<_> = nodes[..count].iter().map(|node| node.0).collect();
        let state = |(k, (_, mu, rate)): (usize, &(_, f64, f64))| {
            laws.get(k).unwrap_or(&laws[0]).state_of_friction(*mu, *rate)
        };
        let states: Vec<_> = nodes.iter().enumerate().map(state).collect();
        let checked = check_slip_rates(&laws, &states);
        checked.map_err(|error| TestCaseError::fail(format!("{laws:?}: {error}")))?;
    }
}

proptest! {
    #![proptest_config(cases(20_000))]

    /// A node with any friction at any rate starts in the state of that friction, and its local problem returns the rate.
    #[test]
    fn states_of_friction_carry_it(law in laws(), coefficient in 0.01..1.0f64, rate in decades(-30.0..2.0)) {
        let state = law.state_of_friction(coefficient, rate);
        prop_assert!(state.0.is_finite());
        let found = law.coefficient(rate, state);
        // The logarithms round with their size.
        let rounding = 1e-14 * (1.0 + law.a * 100.0);
        prop_assert!((found - coefficient).abs() <= rounding, "{found} {coefficient}");
        let viscosity = 0.04;
        let solved = law.slip_rate(viscosity, viscosity * rate + coefficient, state);
        prop_assert!((solved / rate - 1.0).abs() <= 1e-9 + rounding / law.a, "{solved:e} {rate:e}");
    }

    /// Both forms of the state are the same friction.
    #[test]
    fn friction_in_psi_is_friction_in_theta(
        (a, b) in (0.002..0.1, 0.001..0.1), mu0 in 0.1..1.0f64, alpha in -20.0..25.0f64, rate in decades(-30.0..2.0),
    ) {
        let law = RegularizedDieterichRuina {
            a,
            b,
            reference_friction: mu0,
            reference_velocity: 1e-6,
            slip_distance: 8e-3,
        };
        let (in_psi, aging) = (law.in_psi(), law.aging_in_psi());
        let (state, psi) = (LogTheta(alpha), aging.psi(LogTheta(alpha)));
        let (here, there) = (in_psi.response(rate, psi), law.response(rate, state));
        let rounding = 1e-14 / a;
        prop_assert!((here.coefficient - there.coefficient).abs() <= rounding * here.coefficient.max(a));
        let near = |own: f64, other: f64| (own - other).abs() <= rounding * other + f64::MIN_POSITIVE;
        prop_assert!(near(here.rate_slope, there.rate_slope));
        prop_assert!(near(here.state_slope * b, there.state_slope));
        prop_assert!((law.slip_in_psi().log_theta(psi).0 - alpha).abs() <= 1e-13 / b);
        // Rates of both states: psi' = b alpha'.
        let (own, other) = (aging.evolution(psi, rate), b * law.aging().evolution(state, rate));
        let terms = b * ((-alpha).exp() + rate / 8e-3);
        prop_assert!((own - other).abs() <= 1e-13 / b * terms);
    }
}

//! Friction below a cap, and caps that fall with time.

use proptest::prelude::*;
use stickslip_friction::{
    Capped, ForcedCap, FrictionLaw, LinearWeakening, Radial, RegularizedDieterichRuina,
    RegularizedInPsi, StateDependentTresca, Tresca, check_convex_potential, check_friction_law,
};
use stickslip_state::{LogTheta, Psi, Weakening};

use crate::common::{Generic, SLIDER, cases, decades};

#[test]
fn laws_below_a_cap_conform() {
    let states = [-100.0, -10.0, 0.0, 2.0, 10.0, 100.0].map(LogTheta);
    let smooth = RegularizedDieterichRuina::from(SLIDER);
    for cap in [0.0, 0.1, 0.6, 0.65, 3.0, f64::INFINITY] {
        let named =
            |found: Result<(), _>, name| found.unwrap_or_else(|e| panic!("{name} {cap}: {e}"));
        named(
            check_friction_law(&Capped { law: SLIDER, cap }, &states),
            "cut-off",
        );
        named(
            check_friction_law(&Capped { law: smooth, cap }, &states),
            "regularised",
        );
        named(
            check_friction_law(&Generic(Capped { law: smooth, cap }), &states[1..5]),
            "generic",
        );
        let tresca = StateDependentTresca::from(SLIDER);
        named(
            check_friction_law(&Capped { law: tresca, cap }, &states),
            "Tresca with a state",
        );
        let law = Tresca { coefficient: 0.6 };
        named(check_friction_law(&Capped { law, cap }, &[()]), "Tresca");
        let law = LinearWeakening {
            static_friction: 0.677,
            dynamic_friction: 0.525,
        };
        named(
            check_friction_law(&Capped { law, cap }, &[0.0, 0.5, 2.0].map(Weakening)),
            "weakening",
        );
        // A cap of a cap is the lower one.
        let twice = Capped {
            law: Capped {
                law: smooth,
                cap: 0.5,
            },
            cap,
        };
        let once = Capped {
            law: smooth,
            cap: cap.min(0.5),
        };
        for rate in [0.0, 1e-9, 1.0] {
            assert_eq!(
                twice.response(rate, states[3]),
                once.response(rate, states[3])
            );
        }
    }
}

#[test]
fn potentials_below_a_cap_stay_convex() {
    let smooth = RegularizedDieterichRuina::from(SLIDER);
    for cap in [0.0, 0.3, 0.6, 0.66] {
        let potential = Radial {
            law: Capped { law: smooth, cap },
            force: 1e6,
            state: LogTheta(2.0),
        };
        for speed in [1e-12, 1e-6, 1.0] {
            check_convex_potential::<_, 2>(&potential, speed, 6e5).expect("in the plane");
            check_convex_potential::<_, 3>(&potential, speed, 6e5).expect("in space");
        }
    }
}

#[test]
fn unusable_caps_are_refused() {
    let law = Tresca { coefficient: 0.6 };
    for cap in [-1e-9, f64::NAN, f64::NEG_INFINITY] {
        assert!(Capped { law, cap }.validate().is_err());
    }
    let wrong = Tresca { coefficient: -1.0 };
    assert!(
        Capped {
            law: wrong,
            cap: 1.0
        }
        .validate()
        .is_err()
    );
    let cap = ForcedCap {
        rupture_time: 1.0,
        duration: 0.5,
        static_friction: 0.7,
        dynamic_friction: 0.3,
    };
    for wrong in [
        ForcedCap {
            rupture_time: f64::NAN,
            ..cap
        },
        ForcedCap {
            duration: 0.0,
            ..cap
        },
        ForcedCap {
            duration: f64::INFINITY,
            ..cap
        },
        ForcedCap {
            dynamic_friction: -0.1,
            ..cap
        },
        ForcedCap {
            dynamic_friction: f64::NAN,
            ..cap
        },
        ForcedCap {
            static_friction: 0.3,
            ..cap
        },
        ForcedCap {
            static_friction: f64::INFINITY,
            ..cap
        },
        ForcedCap {
            static_friction: f64::NAN,
            ..cap
        },
    ] {
        assert!(wrong.validate().is_err(), "{wrong:?}");
    }
    assert!(cap.validate().is_ok() && ForcedCap::none().validate().is_ok());
}

#[test]
fn caps_fall_smoothly_from_no_cap_to_the_dynamic_coefficient() {
    let cap = ForcedCap {
        rupture_time: 2.0,
        duration: 0.5,
        static_friction: 0.7,
        dynamic_friction: 0.3,
    };
    assert!((cap.cap(2.0) - 0.7).abs() < 1e-15 && cap.cap(2.5) == 0.3 && cap.cap(1e9) == 0.3);
    // Ahead of the front by as much as it lasts: f_s and the fall once more.
    assert!((cap.cap(1.5) - 1.1).abs() < 1e-15);
    assert_eq!(ForcedCap::none().cap(1e300), f64::INFINITY);
    let slope = |time: f64, h: f64| (cap.cap(time + h) - cap.cap(time)) / h;
    let (mut previous, h) = (f64::INFINITY, 1e-7);
    for i in 0..=3000 {
        let time = 1e-3 * f64::from(i);
        assert!(cap.cap(time) <= previous);
        previous = cap.cap(time);
        // Second derivatives of at most 4 (f_s - f_d)/t_0^2.
        assert!((slope(time, h) - slope(time, -h)).abs() < 4.0 * 0.4 / 0.25 * 2.0 * h + 1e-8);
    }
}

proptest! {
    #![proptest_config(cases(300))]

    #[test]
    fn any_cap_keeps_the_contract(
        a in decades(-4.0..0.0), psi in -1.0..2.0f64, cap in prop_oneof![0.0..1.5f64, decades(-12.0..1.0)],
    ) {
        let capped = Capped { law: RegularizedInPsi { a, reference_velocity: 1e-6 }, cap };
        let checked = check_friction_law(&capped, &[Psi(psi)]);
        checked.map_err(|error| TestCaseError::fail(format!("{capped:?}: {error}")))?;
    }

    /// The closed form against the generic search.
    #[test]
    fn capped_problems_are_solved(
        psi in 0.0..1.0f64, cap in 0.0..1.0f64, drive in 0.0..2.0f64, viscosity in decades(-6.0..6.0),
    ) {
        let law = Capped { law: RegularizedInPsi { a: 0.01, reference_velocity: 1e-6 }, cap };
        let closed = law.slip_rate(viscosity, drive, Psi(psi));
        let generic = Generic(law).slip_rate(viscosity, drive, Psi(psi));
        prop_assert!((closed - generic).abs() <= 1e-9 * closed + 1e-300, "{closed:e} {generic:e}");
    }
}

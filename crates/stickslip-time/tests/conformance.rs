//! Every scheme of this crate obeys the contract, and schemes that break it are told how.

use proptest::prelude::*;
use stickslip_time::{
    BackwardEuler, Coefficients, GeneralizedAlpha, Motion, Newmark, Predicted, QuasiStatic,
    RateScheme, RateSchemeViolation, check_rate_scheme,
};

#[test]
fn our_schemes_obey() -> Result<(), RateSchemeViolation> {
    let newmark = Newmark::AVERAGE_ACCELERATION;
    check_rate_scheme(&newmark)?;
    check_rate_scheme(&BackwardEuler)?;
    for spectral_radius in [0.0, 0.2, 0.5, 0.8, 0.95, 1.0] {
        check_rate_scheme(&GeneralizedAlpha { spectral_radius })?;
    }
    check_rate_scheme(&QuasiStatic(newmark))?;
    check_rate_scheme(&QuasiStatic(BackwardEuler))?;
    let boxed: Box<dyn RateScheme> = Box::new(newmark);
    check_rate_scheme(&*boxed)
}

/// Average acceleration with one thing changed.
#[derive(Default)]
struct Broken {
    c_u: f64,
    c_a: f64,
    offset: f64,
    square: f64,
    displacement: f64,
    velocity: f64,
    acceleration: f64,
    drag: f64,
}

impl RateScheme for Broken {
    fn coefficients(&self, dt: f64) -> Coefficients {
        let c = Newmark::AVERAGE_ACCELERATION.coefficients(dt);
        Coefficients {
            displacement: c.displacement * (1.0 + self.c_u),
            acceleration: c.acceleration * (1.0 + self.c_a),
        }
    }

    fn predict(&self, dt: f64, from: Motion) -> Predicted {
        let p = Newmark::AVERAGE_ACCELERATION.predict(dt, from);
        Predicted {
            displacement: p.displacement * (1.0 + self.displacement)
                + self.offset
                + dt * self.velocity * from.velocity
                + dt * dt * self.drag * from.acceleration,
            acceleration: p.acceleration
                + self.acceleration * from.acceleration
                + self.square * from.acceleration.abs(),
        }
    }
}

fn verdict(broken: Broken) -> RateSchemeViolation {
    check_rate_scheme(&broken).expect_err("broken")
}

#[test]
fn an_unbroken_one_passes() {
    assert_eq!(check_rate_scheme(&Broken::default()), Ok(()));
}

#[test]
fn broken_schemes_are_told_how() {
    use RateSchemeViolation as V;
    let negative = verdict(Broken {
        c_u: -2.0,
        ..Broken::default()
    });
    assert!(matches!(negative, V::Coefficient { name: "c_u", value, .. } if value < 0.0));
    let missing = verdict(Broken {
        c_a: f64::NAN,
        ..Broken::default()
    });
    assert!(
        matches!(missing, V::Coefficient { name: "c_a", .. }),
        "{missing}"
    );
    let moved = verdict(Broken {
        offset: 1e-9,
        ..Broken::default()
    });
    assert!(
        matches!(moved, V::LeavesRest { component: "displacement", value, .. } if value == 1e-9)
    );
    let bent = verdict(Broken {
        square: 0.1,
        ..Broken::default()
    });
    assert!(
        matches!(
            bent,
            V::NotLinear {
                component: "acceleration",
                ..
            }
        ),
        "{bent}"
    );
    // Coefficients and prediction of different schemes.
    let mixed = verdict(Broken {
        c_u: 1e-6,
        ..Broken::default()
    });
    assert!(
        matches!(
            mixed,
            V::ConstantVelocity {
                component: "displacement",
                ..
            }
        ),
        "{mixed}"
    );
    let mixed = verdict(Broken {
        c_a: 1e-6,
        ..Broken::default()
    });
    assert!(
        matches!(
            mixed,
            V::ConstantVelocity {
                component: "acceleration",
                ..
            }
        ),
        "{mixed}"
    );
    let drifting = verdict(Broken {
        velocity: 1e-3,
        ..Broken::default()
    });
    assert!(matches!(drifting, V::ConstantVelocity { .. }), "{drifting}");
    let stale = verdict(Broken {
        acceleration: 0.5,
        ..Broken::default()
    });
    assert!(
        matches!(stale, V::NotConsistent { component: "acceleration", order, .. } if order < 0.1),
        "{stale}"
    );
    let growing = verdict(Broken {
        drag: 0.05,
        ..Broken::default()
    });
    assert!(
        matches!(growing, V::Unstable { growth, .. } if growth > 1.0),
        "{growing}"
    );
}

/// A step that is wrong by a share of itself: of order one where two is due.
#[test]
fn a_displacement_of_order_one_is_no_scheme() {
    struct Late;
    impl RateScheme for Late {
        fn coefficients(&self, dt: f64) -> Coefficients {
            BackwardEuler.coefficients(dt)
        }
        fn predict(&self, dt: f64, from: Motion) -> Predicted {
            let p = BackwardEuler.predict(dt, from);
            // Exact at constant velocity, but with the unit of time confused.
            Predicted {
                displacement: p.displacement + dt * from.acceleration,
                ..p
            }
        }
    }
    let violation = check_rate_scheme(&Late).expect_err("broken");
    let RateSchemeViolation::NotConsistent {
        component,
        order,
        expected,
    } = violation
    else {
        panic!("{violation}");
    };
    assert_eq!((component, expected), ("displacement", 2.0));
    assert!((order - 1.0).abs() < 0.1, "{order}");
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

    /// Newmark's schemes are unconditionally stable for `2 beta >= gamma >= 1/2`, and no others are.
    #[test]
    fn newmark_is_stable_where_theory_says(
        beta in 0.05..1.0_f64, gamma in 0.3..1.0_f64, midpoint in any::<bool>(),
    ) {
        let gamma = if midpoint { 0.5 } else { gamma };
        prop_assume!((2.0 * beta - gamma).abs() > 0.01 && (midpoint || (gamma - 0.5).abs() > 0.01));
        let verdict = check_rate_scheme(&Newmark { beta, gamma });
        if 2.0 * beta > gamma && gamma >= 0.5 {
            prop_assert_eq!(verdict, Ok(()));
        } else {
            let unstable = matches!(verdict, Err(RateSchemeViolation::Unstable { .. }));
            prop_assert!(unstable, "{:?}", verdict);
        }
    }
}

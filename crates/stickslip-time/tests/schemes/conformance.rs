//! Every scheme of this crate obeys the contract, and schemes that break it are told how.

use proptest::prelude::*;
use stickslip_time::{
    BackwardEuler, CentralDifferences, GeneralizedAlpha, Newmark, QuasiStatic, RateScheme,
    RateSchemeViolation as Violation, SchemeProperties, Sdirk2, Stage, UpdateFormula, Weights,
    check_rate_scheme,
};

#[test]
fn our_schemes_obey() -> Result<(), Violation> {
    let newmark = Newmark::AVERAGE_ACCELERATION;
    check_rate_scheme(&newmark)?;
    check_rate_scheme(&BackwardEuler)?;
    check_rate_scheme(&CentralDifferences)?;
    check_rate_scheme(&Sdirk2)?;
    for spectral_radius in [0.0, 0.2, 0.5, 0.8, 0.95, 1.0] {
        check_rate_scheme(&GeneralizedAlpha { spectral_radius })?;
        check_rate_scheme(&QuasiStatic(GeneralizedAlpha { spectral_radius }))?;
    }
    check_rate_scheme(&QuasiStatic(newmark))?;
    check_rate_scheme(&QuasiStatic(BackwardEuler))?;
    check_rate_scheme(&QuasiStatic(Sdirk2))?;
    let boxed: Box<dyn RateScheme> = Box::new(newmark);
    check_rate_scheme(&*boxed)
}

/// Average acceleration with something changed.
struct Broken {
    change: fn(f64, &mut UpdateFormula),
    properties: SchemeProperties,
}

impl RateScheme for Broken {
    fn update_formula(&self, dt: f64) -> UpdateFormula {
        let mut formula = Newmark::AVERAGE_ACCELERATION.update_formula(dt);
        (self.change)(dt, &mut formula);
        formula
    }

    fn properties(&self) -> SchemeProperties {
        self.properties
    }
}

fn verdict(change: fn(f64, &mut UpdateFormula)) -> Result<(), Violation> {
    let properties = Newmark::AVERAGE_ACCELERATION.properties();
    check_rate_scheme(&Broken { change, properties })
}

fn verdict_on(properties: impl Fn(&mut SchemeProperties)) -> Result<(), Violation> {
    let mut changed = Newmark::AVERAGE_ACCELERATION.properties();
    properties(&mut changed);
    let change = |_, _: &mut UpdateFormula| ();
    check_rate_scheme(&Broken {
        change,
        properties: changed,
    })
}

/// Fails unless the verdict is of the kind named.
macro_rules! assert_told {
    ($verdict:expr, $pattern:pat $(if $guard:expr)?) => {
        let verdict = $verdict;
        assert!(matches!(&verdict, Err($pattern) $(if $guard)?), "{verdict:?}");
    };
}

#[test]
fn an_unbroken_one_passes() {
    assert_eq!(verdict(|_, _| ()), Ok(()));
}

#[test]
fn broken_weights_are_told_how() {
    assert_told!(
        verdict(|_, formula| formula.displacement.new_velocity *= -1.0),
        Violation { property: "weights", quantity: "c_u", at: Some(("dt", _)), value, .. } if *value < 0.0
    );
    assert_told!(
        verdict(|_, formula| formula.acceleration.new_velocity = f64::NAN),
        Violation {
            property: "weights",
            quantity: "c_a",
            at: Some(("dt", _)),
            ..
        }
    );
    assert_told!(
        verdict(|_, formula| formula.acceleration.algorithmic = f64::INFINITY),
        Violation {
            property: "weights",
            quantity: "a weight of the acceleration",
            at: Some(("dt", _)),
            ..
        }
    );
    assert_told!(
        verdict(|_, formula| formula.algorithmic = Weights::STAY),
        Violation {
            property: "weights",
            quantity: "a weight of what is carried on",
            at: Some(("dt", _)),
            ..
        }
    );
    // Of two schemes.
    assert_told!(
        verdict(|_, formula| formula.displacement.new_velocity *= 1.0 + 1e-6),
        Violation {
            property: "constant velocity",
            quantity: "displacement",
            at: Some(("dt", _)),
            bound: Some(_),
            ..
        }
    );
    assert_told!(
        verdict(|_, formula| formula.acceleration.new_velocity *= 1.0 + 1e-6),
        Violation {
            property: "constant velocity",
            quantity: "acceleration",
            at: Some(("dt", _)),
            bound: Some(_),
            ..
        }
    );
    assert_told!(
        verdict(|dt, formula| formula.prescribed.velocity += 1e-3 * dt),
        Violation {
            property: "constant velocity",
            quantity: "prescribed displacement",
            at: Some(("dt", _)),
            bound: Some(_),
            ..
        }
    );
    assert_told!(
        verdict(|_, formula| formula.acceleration.acceleration += 0.5),
        Violation { property: "consistency", quantity: "acceleration", value: order, .. } if *order < 0.1
    );
    assert_told!(
        verdict(|dt, formula| formula.displacement.acceleration += 0.05 * dt * dt),
        Violation { property: "stability", at: Some(("omega dt", _)), value: growth, .. } if *growth > 1.0
    );
    // A step that is wrong by a share of itself, with the unit of time confused.
    assert_told!(
        verdict(|dt, formula| formula.displacement.acceleration += dt),
        Violation { property: "consistency", quantity: "displacement", value: order, .. } if (order - 1.0).abs() < 0.1
    );
}

#[test]
fn wrong_facts_are_found_out() {
    assert_told!(
        verdict_on(|properties| properties.order = 3),
        Violation { property: "order", bound: Some(3.0), value: observed, .. } if (observed - 2.0).abs() < 0.1
    );
    let properties = SchemeProperties {
        symmetric: true,
        ..SchemeProperties::FIRST_ORDER
    };
    let change = |dt, formula: &mut UpdateFormula| *formula = BackwardEuler.update_formula(dt);
    assert_told!(
        check_rate_scheme(&Broken { change, properties }),
        Violation {
            property: "symmetry",
            ..
        }
    );
    let whole = Stage {
        share: 1.0,
        lead: 0.0,
        end: 1.0,
    };
    assert_told!(
        verdict_on(|properties| properties.stages = &[]),
        Violation {
            property: "stages",
            quantity: "their number",
            value: 0.0,
            ..
        }
    );
    for (stages, wrong, at) in [
        (
            vec![Stage {
                share: 1.5,
                ..whole
            }],
            "share",
            0.0,
        ),
        (vec![Stage { lead: 1.0, ..whole }], "lead", 0.0),
        (vec![Stage { end: 0.5, ..whole }], "end", 0.0),
        (vec![whole, whole], "end", 1.0),
    ] {
        let stages: &'static [Stage] = stages.leak();
        assert_told!(
            verdict_on(|properties| properties.stages = stages),
            Violation { property: "stages", quantity, at: Some(("stage", stage)), .. } if *quantity == wrong && *stage == at
        );
    }
}

proptest! {
    /// Newmark's schemes are unconditionally stable for `2 beta >= gamma >= 1/2`, and no others are.
    #[test]
    fn newmark_is_stable_where_theory_says(
        gamma in prop_oneof![0.3..0.49, Just(0.5), 0.51..1.0_f64], above in any::<bool>(), share in 0.0..1.0_f64,
    ) {
        let (low, high) = if above { (0.5 * gamma + 0.005, 1.0) } else { (0.05, 0.5 * gamma - 0.005) };
        let beta = low + share * (high - low);
        let verdict = check_rate_scheme(&Newmark { beta, gamma });
        if above && gamma >= 0.5 {
            prop_assert_eq!(verdict, Ok(()));
        } else {
            let unstable = matches!(verdict, Err(Violation { property: "stability", .. }));
            prop_assert!(unstable, "{:?}", verdict);
        }
    }
}

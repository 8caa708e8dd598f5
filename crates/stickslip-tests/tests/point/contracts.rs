//! Laws that break their contracts are refused when a scene is built, unless that is turned off.

use stickslip::friction::{FrictionLaw, FrictionViolation};
use stickslip::problems::spring_slider::{AGING, FRICTION};
use stickslip::state::{Dieterich, LogTheta, StateLaw, StateLawViolation};
use stickslip::{BackwardEuler, BoundaryPart, Contact, Point, Scene, SceneError, Simulation};

use crate::Outcome;

/// `mu = level + weight ln(1 + V/V0)`.
#[derive(Debug, Clone, Copy)]
struct ByRate {
    level: f64,
    weight: f64,
}

impl FrictionLaw for ByRate {
    type State = ();

    fn coefficient(&self, slip_rate: f64, (): ()) -> f64 {
        self.level + self.weight * (slip_rate * 1e6).ln_1p()
    }

    fn coefficient_rate_slope(&self, slip_rate: f64, (): ()) -> f64 {
        self.weight * 1e6 / (1.0 + slip_rate * 1e6)
    }

    fn potential(&self, slip_rate: f64, (): ()) -> f64 {
        let x = slip_rate * 1e6;
        self.level * slip_rate + self.weight * 1e-6 * ((1.0 + x) * x.ln_1p() - x)
    }
}

/// Aging with a term that grows with the state where it slides.
#[derive(Debug, Clone, Copy)]
struct Growing(Dieterich);

impl StateLaw for Growing {
    type State = LogTheta;

    fn evolution(&self, state: LogTheta, slip_rate: f64) -> f64 {
        self.0.evolution(state, slip_rate) + 2e5 * slip_rate * state.0
    }

    fn evolution_state_slope(&self, state: LogTheta, slip_rate: f64) -> f64 {
        self.0.evolution_state_slope(state, slip_rate) + 2e5 * slip_rate
    }
}

fn built<L, S>(contact: Contact<L, S, 1>) -> Option<SceneError>
where
    L: FrictionLaw + 'static,
    S: StateLaw + 'static,
    L::State: stickslip::state::Reads<S::State>,
{
    let scene = Scene::new(nalgebra::SMatrix::<f64, 1, 1>::new(1e9)).with_contact(contact);
    Simulation::new(scene, BackwardEuler, Point).err()
}

fn by_rate(level: f64, weight: f64) -> Contact<ByRate, (), 1> {
    Contact::new(BoundaryPart::point(1.0), ByRate { level, weight }, 1e6)
}

#[test]
fn laws_in_order_pass() {
    assert_eq!(built(by_rate(0.6, 0.01)), None);
    for initial in [-800.0, -10.0, 0.0, 800.0] {
        let contact = Contact::new(BoundaryPart::point(1.0), FRICTION, 1e6);
        assert_eq!(built(contact.with_state(AGING, LogTheta(initial))), None);
    }
}

/// The worst is quoted, and at rates that are met.
#[test]
fn broken_laws_are_refused_with_their_worst_case() -> Outcome {
    let Some(SceneError::Friction(violation)) = built(by_rate(-0.1, 0.01)) else {
        return Err("negative friction".into());
    };
    let FrictionViolation::Value {
        what: "coefficient",
        slip_rate,
        value: coefficient,
        ..
    } = violation
    else {
        return Err(violation.into());
    };
    assert!(
        slip_rate == 1e-12 && (coefficient + 0.1).abs() < 1e-7,
        "{violation}"
    );
    let Some(SceneError::Friction(violation)) = built(by_rate(0.6, -0.01)) else {
        return Err("weakening friction".into());
    };
    let FrictionViolation::CoefficientDecreases { faster, .. } = violation else {
        return Err(violation.into());
    };
    assert_eq!(faster, 1e2);
    let contact = Contact::new(BoundaryPart::point(1.0), FRICTION, 1e6);
    let contact = contact.with_state(Growing(AGING), LogTheta(2.0));
    let Some(SceneError::State(violation)) = built(contact) else {
        return Err("a growing state".into());
    };
    let StateLawViolation::EvolutionIncreases { slip_rate, .. } = violation else {
        return Err(violation.into());
    };
    assert!((1e-6..1e3).contains(&slip_rate), "{slip_rate:e}");
    Ok(())
}

/// Of `mu = 0.6 + 0.01 ln(1 + V/V0)`: its integral is not 0, and it does not fall where it rises.
#[derive(Debug, Clone, Copy)]
enum Inconsistent {
    Potential,
    Slope,
}

impl FrictionLaw for Inconsistent {
    type State = ();

    fn coefficient(&self, slip_rate: f64, (): ()) -> f64 {
        RISING.coefficient(slip_rate, ())
    }

    fn coefficient_rate_slope(&self, slip_rate: f64, (): ()) -> f64 {
        match self {
            Self::Slope => 1e6 * RISING.coefficient_rate_slope(slip_rate, ()),
            Self::Potential => RISING.coefficient_rate_slope(slip_rate, ()),
        }
    }

    fn potential(&self, slip_rate: f64, (): ()) -> f64 {
        match self {
            Self::Slope => RISING.potential(slip_rate, ()),
            Self::Potential => 0.0,
        }
    }
}

const RISING: ByRate = ByRate {
    level: 0.6,
    weight: 0.01,
};

/// Aging whose slope has the other sign.
#[derive(Debug, Clone, Copy)]
struct WrongSign(Dieterich);

impl StateLaw for WrongSign {
    type State = LogTheta;

    fn evolution(&self, state: LogTheta, slip_rate: f64) -> f64 {
        self.0.evolution(state, slip_rate)
    }

    fn evolution_state_slope(&self, state: LogTheta, slip_rate: f64) -> f64 {
        -self.0.evolution_state_slope(state, slip_rate)
    }
}

#[test]
fn functions_that_contradict_each_other_are_refused_with_their_numbers() -> Outcome {
    for (law, name) in [
        (Inconsistent::Potential, "potential"),
        (Inconsistent::Slope, "coefficient_rate_slope"),
    ] {
        let contact = Contact::new(BoundaryPart::point(1.0), law, 1e6);
        let error = built(contact).ok_or("not refused")?;
        let SceneError::Friction(FrictionViolation::Differs {
            what,
            slip_rate,
            found,
            expected,
            ..
        }) = error
        else {
            return Err(error.into());
        };
        assert_eq!(what, name);
        match law {
            // V mu(V) is above the integral, V mu(0) below.
            Inconsistent::Potential => {
                let most = slip_rate * RISING.coefficient(slip_rate, ());
                assert!(found == 0.0 && (0.3 * slip_rate..most).contains(&expected));
            }
            Inconsistent::Slope => assert!((found / expected / 1e6 - 1.0).abs() < 1e-3),
        }
    }
    let contact = Contact::new(BoundaryPart::point(1.0), FRICTION, 1e6);
    let error = built(contact.with_state(WrongSign(AGING), LogTheta(2.0))).ok_or("not refused")?;
    let SceneError::State(StateLawViolation::Slope { slope, bound, .. }) = error else {
        return Err(error.into());
    };
    assert!((slope + bound).abs() < 1e-3 * slope);
    Ok(())
}

#[test]
fn it_can_be_turned_off() {
    assert_eq!(built(by_rate(0.6, -0.01).unchecked()), None);
    let contact = Contact::new(BoundaryPart::point(1.0), FRICTION, 1e6);
    let contact = contact.with_state(Growing(AGING), LogTheta(2.0));
    assert_eq!(built(contact.unchecked()), None);
}

#[test]
fn laws_given_per_vertex_are_looked_at() {
    let law = ByRate {
        level: 0.6,
        weight: -0.01,
    };
    let error = built(Contact::per_vertex(BoundaryPart::point(1.0), [law], 1e6));
    assert!(matches!(error, Some(SceneError::Friction(_))), "{error:?}");
}

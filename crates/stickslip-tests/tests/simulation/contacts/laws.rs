//! Laws of different types side by side, and laws chosen at run time.

use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

use stickslip::friction::{DieterichRuina, FrictionLaw, RegularizedDieterichRuina};
use stickslip::problems::pipping_slider::{
    AGING, FRICTION, INITIAL_LOG_THETA, NORMAL_STRESS, PippingSlider,
};
use stickslip::state::{Dieterich, LogTheta, Ruina, StateError, StateLaw};
use stickslip::{
    BlockMatrix, BoundaryPart, Condensed, Contact, Coupling, FixedPoint, Monolithic, Newmark,
    Scene, Simulation, StateUpdate, Steps,
};

use super::those;
use crate::Outcome;
use crate::common::{bits, body, distance};

const SLIP_LAW: Ruina = Ruina {
    slip_distance: AGING.slip_distance,
};
const START: LogTheta = LogTheta(INITIAL_LOG_THETA);
/// So little that the body slides after a second \[Pa\].
const LIGHT: f64 = 0.03 * NORMAL_STRESS;

/// Either of two friction laws.
#[derive(Debug, Clone, Copy)]
enum Friction {
    Cut(DieterichRuina),
    Regular(RegularizedDieterichRuina),
}

impl FrictionLaw for Friction {
    type State = LogTheta;

    fn coefficient(&self, slip_rate: f64, state: LogTheta) -> f64 {
        match self {
            Self::Cut(law) => law.coefficient(slip_rate, state),
            Self::Regular(law) => law.coefficient(slip_rate, state),
        }
    }

    fn coefficient_rate_slope(&self, slip_rate: f64, state: LogTheta) -> f64 {
        match self {
            Self::Cut(law) => law.coefficient_rate_slope(slip_rate, state),
            Self::Regular(law) => law.coefficient_rate_slope(slip_rate, state),
        }
    }

    fn coefficient_state_slope(&self, slip_rate: f64, state: LogTheta) -> f64 {
        match self {
            Self::Cut(law) => law.coefficient_state_slope(slip_rate, state),
            Self::Regular(law) => law.coefficient_state_slope(slip_rate, state),
        }
    }

    fn potential(&self, slip_rate: f64, state: LogTheta) -> f64 {
        match self {
            Self::Cut(law) => law.potential(slip_rate, state),
            Self::Regular(law) => law.potential(slip_rate, state),
        }
    }
}

/// Either of two state laws.
#[derive(Debug, Clone, Copy)]
enum Evolution {
    Aging(Dieterich),
    Slip(Ruina),
}

impl StateLaw for Evolution {
    type State = LogTheta;

    fn evolution(&self, state: LogTheta, slip_rate: f64) -> f64 {
        match self {
            Self::Aging(law) => law.evolution(state, slip_rate),
            Self::Slip(law) => law.evolution(state, slip_rate),
        }
    }

    fn evolution_state_slope(&self, state: LogTheta, slip_rate: f64) -> f64 {
        match self {
            Self::Aging(law) => law.evolution_state_slope(state, slip_rate),
            Self::Slip(law) => law.evolution_state_slope(state, slip_rate),
        }
    }

    fn advance(&self, state: LogTheta, slip_rate: f64, dt: f64) -> Result<LogTheta, StateError> {
        match self {
            Self::Aging(law) => law.advance(state, slip_rate, dt),
            Self::Slip(law) => law.advance(state, slip_rate, dt),
        }
    }

    fn advance_exact(&self, from: LogTheta, slip_rate: f64, dt: f64) -> Option<LogTheta> {
        match self {
            Self::Aging(law) => law.advance_exact(from, slip_rate, dt),
            Self::Slip(law) => law.advance_exact(from, slip_rate, dt),
        }
    }
}

/// The slider with some contacts, slid for a second.
fn slid(
    contacts: impl FnOnce(Scene<BlockMatrix<2>, 2>, BoundaryPart) -> Scene<BlockMatrix<2>, 2>,
    coupling: impl Coupling + 'static,
) -> Outcome<Simulation<2>> {
    let space = body(1).space()?;
    let scene = contacts(
        body(1).scene(&space)?,
        BoundaryPart::from(&PippingSlider::bottom(&space)?),
    );
    let mut body = Simulation::new(scene, Newmark::default(), Condensed::new())?
        .with_coupling(coupling)
        .with_state_update(StateUpdate::Midpoint)
        .with_absolute_tolerance(1e-13)?;
    body.run(&Steps::constant(4e-3).until(2.0), |_| ())?;
    assert!(body.snapshot().max_slip_rate() > 1e-5);
    Ok(body)
}

/// Two contacts, the types of whose laws have nothing to do with one another, are one with an enum.
#[test]
fn laws_of_two_types_equal_an_enum() -> Outcome {
    let left = |x: &[f64; 3]| x[0] <= 2.5;
    let regular = RegularizedDieterichRuina::from(FRICTION);
    let two = |scene: Scene<BlockMatrix<2>, 2>, bottom: BoundaryPart| {
        let aging = Contact::new(those(&bottom, left), FRICTION, LIGHT).with_state(AGING, START);
        let rest = those(&bottom, |x| !left(x));
        let slip = Contact::new(rest, regular, LIGHT).with_state(SLIP_LAW, START);
        scene.with_contact(aging).with_contact(slip)
    };
    let one = |scene: Scene<BlockMatrix<2>, 2>, bottom: BoundaryPart| {
        let laws = |x: &[f64; 3]| {
            if left(x) {
                (Friction::Cut(FRICTION), Evolution::Aging(AGING))
            } else {
                (Friction::Regular(regular), Evolution::Slip(SLIP_LAW))
            }
        };
        let (friction, evolution): (Vec<_>, Vec<_>) = bottom.points.iter().map(laws).unzip();
        let contact = Contact::per_vertex(bottom, friction, LIGHT);
        scene.with_contact(contact.with_state_per_vertex(evolution, START))
    };
    let couplings: [fn() -> Box<dyn Coupling>; 2] = [
        || Box::new(FixedPoint::default()),
        || Box::new(Monolithic::default()),
    ];
    for coupling in couplings {
        let (two, one) = (slid(two, coupling())?, slid(one, coupling())?);
        let (two, one) = (two.snapshot(), one.snapshot());
        assert!(distance(two.displacement, one.displacement) < 1e-12 * 1e-4);
        assert!(distance(two.velocity, one.velocity) < 1e-12);
        for contact in two.contacts() {
            for k in 0..contact.len() {
                let whole = one.contact(0);
                let place = whole.position_of(contact.vertex(k)).ok_or("not there")?;
                assert!((contact.state(k) - whole.state(place)).abs() < 1e-12);
                let (a, b) = (contact.coefficient(k), whole.coefficient(place));
                assert!((a - b).abs() < 1e-12, "{a}, {b}");
            }
        }
    }
    Ok(())
}

/// A law that counts how often its closed form is used.
struct Counting(Arc<AtomicUsize>);

impl FrictionLaw for Counting {
    type State = LogTheta;

    fn coefficient(&self, slip_rate: f64, state: LogTheta) -> f64 {
        FRICTION.coefficient(slip_rate, state)
    }

    fn coefficient_rate_slope(&self, slip_rate: f64, state: LogTheta) -> f64 {
        FRICTION.coefficient_rate_slope(slip_rate, state)
    }

    fn coefficient_state_slope(&self, slip_rate: f64, state: LogTheta) -> f64 {
        FRICTION.coefficient_state_slope(slip_rate, state)
    }

    fn potential(&self, slip_rate: f64, state: LogTheta) -> f64 {
        FRICTION.potential(slip_rate, state)
    }

    fn slip_rate(&self, viscosity: f64, drive: f64, state: LogTheta) -> f64 {
        self.0.fetch_add(1, Ordering::Relaxed);
        FRICTION.slip_rate(viscosity, drive, state)
    }
}

type AnyFriction = Box<dyn FrictionLaw<State = LogTheta> + Send + Sync>;
type AnyState = Box<dyn StateLaw<State = LogTheta> + Send + Sync>;

/// Behind a pointer laws keep their closed forms, and give the same bits.
#[test]
fn boxed_laws_keep_their_closed_forms() -> Outcome {
    let plain = |scene: Scene<BlockMatrix<2>, 2>, bottom: BoundaryPart| {
        scene.with_contact(Contact::new(bottom, FRICTION, LIGHT).with_state(AGING, START))
    };
    let count = Arc::new(AtomicUsize::new(0));
    let boxed = |scene: Scene<BlockMatrix<2>, 2>, bottom: BoundaryPart| {
        let friction: AnyFriction = Box::new(Counting(count.clone()));
        let aging: AnyState = Box::new(AGING);
        scene.with_contact(Contact::new(bottom, friction, LIGHT).with_state(aging, START))
    };
    let (plain, boxed) = (
        slid(plain, FixedPoint::default())?,
        slid(boxed, FixedPoint::default())?,
    );
    assert_eq!(bits(&plain.snapshot()), bits(&boxed.snapshot()));
    assert!(count.load(Ordering::Relaxed) > 0);
    Ok(())
}

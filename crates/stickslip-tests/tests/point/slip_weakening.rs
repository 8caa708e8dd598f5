//! Friction that weakens with slip, or with the state alone, on springs stiffer than it weakens.

use nalgebra::SMatrix;
use proptest::prelude::*;
use stickslip::friction::{FrictionLaw, StateDependentTresca};
use stickslip::state::{Dieterich, LogTheta, StateLaw, StateVariable};
use stickslip::{
    BackwardEuler, BoundaryPart, Contact, FixedPoint, Monolithic, Newmark, Point, Scene, Sdirk2,
    Simulation, StateUpdate, Steps,
};

use crate::Outcome;

type Block = Simulation<1>;

#[derive(Debug, Clone, Copy, PartialEq)]
struct Slip(f64);

impl StateVariable for Slip {
    fn value(self) -> f64 {
        self.0
    }

    fn from_value(value: f64) -> Self {
        Self(value)
    }
}

/// Linear slip weakening: law and state in one.
#[derive(Debug, Clone, Copy)]
struct Weakening {
    at_rest: f64,
    sliding: f64,
    distance: f64,
    /// Tells its exact solution.
    exact: bool,
}

impl StateLaw for Weakening {
    type State = Slip;

    fn evolution(&self, _: Slip, rate: f64) -> f64 {
        rate
    }

    fn evolution_state_slope(&self, _: Slip, _: f64) -> f64 {
        0.0
    }

    fn advance_exact(&self, Slip(slip): Slip, rate: f64, dt: f64) -> Option<Slip> {
        self.exact.then_some(Slip(slip + rate * dt))
    }
}

impl FrictionLaw for Weakening {
    type State = Slip;

    fn coefficient(&self, _: f64, Slip(slip): Slip) -> f64 {
        let lost = (self.at_rest - self.sliding) * slip / self.distance;
        (self.at_rest - lost).max(self.sliding)
    }

    fn coefficient_rate_slope(&self, _: f64, _: Slip) -> f64 {
        0.0
    }

    fn potential(&self, rate: f64, slip: Slip) -> f64 {
        rate * self.coefficient(rate, slip)
    }
}

/// Couplings, state updates and schemes, all of which leave slip and state the same.
const WAYS: [&str; 6] = [
    "default",
    "without fallback",
    "accelerated fixed point",
    "state by backward Euler",
    "all by backward Euler",
    "two stages",
];

fn by(way: &str, mut block: Block) -> Outcome<Block> {
    match way {
        "without fallback" => block.set_coupling(Monolithic::without_fallback()),
        "accelerated fixed point" => {
            block.set_coupling(FixedPoint::accelerated().with_max_iterations(2000));
        }
        "state by backward Euler" => {
            block = block.with_state_update(StateUpdate::BackwardEuler);
        }
        "all by backward Euler" => {
            block.set_scheme(BackwardEuler)?;
            block = block.with_state_update(StateUpdate::BackwardEuler);
        }
        "two stages" => block.set_scheme(Sdirk2)?,
        _ => {}
    }
    Ok(block)
}

/// Pulled from below its strength on a spring of `factor` times the weakening: at each step the slip is where the spring
/// balances the weakening line, then the kinetic friction.
fn check(way: &str, factor: f64, dt: f64, exact: bool) -> Outcome {
    let (normal, velocity) = (1e6, 1e-4);
    let law = Weakening {
        at_rest: 0.6,
        sliding: 0.5,
        distance: 1e-3,
        exact,
    };
    let weakening = (law.at_rest - law.sliding) * normal / law.distance;
    let stiffness = factor * weakening;
    let pull = move |time: f64| 0.59 * normal + stiffness * velocity * time;
    let scene = Scene::new(SMatrix::<f64, 1, 1>::new(stiffness))
        .with_load_history(move |time, load| load[0][0] = pull(time))
        .with_contact(
            Contact::new(BoundaryPart::point(1.0), law, normal).with_state(law, Slip(0.0)),
        );
    let mut block = by(way, Simulation::new(scene, Newmark::default(), Point)?)?;
    let mut wrong = None;
    block.run(&Steps::constant(dt).until(20.0), |at| {
        let on_line = ((pull(at.time) - law.at_rest * normal) / (stiffness - weakening)).max(0.0);
        let expected = if on_line < law.distance {
            on_line
        } else {
            (pull(at.time) - law.sliding * normal) / stiffness
        };
        let found = at.displacement[0][0];
        if (found - expected).abs() > 1e-7 * law.distance {
            wrong = Some(format!("{way}, {}: {found:e} for {expected:e}", at.time));
        }
    })?;
    wrong.map_or(Ok(()), |wrong| Err(wrong.into()))
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    #[test]
    fn slip_follows_the_weakening_line(
        (factor, dt, exact) in (0.05..1.5_f64, -2.0..0.0_f64, any::<bool>()),
        way in prop::sample::select(WAYS.to_vec()),
    ) {
        let (factor, dt) = (1.0 + 10_f64.powf(factor - 1.0), 10_f64.powf(dt));
        check(way, factor, dt, exact)
            .map_err(|error| TestCaseError::fail(format!("{way}, {factor}, {dt:e}: {error}")))?;
    }
}

/// Strength that depends on the state alone, on ten times the spring that it takes: sliding begins, and tends to the
/// velocity of the load.
#[test]
fn strength_of_the_state_alone_slides_at_the_velocity_of_the_load() -> Outcome {
    let (b, slip_distance, normal, velocity) = (0.0035, 1e-4, 1e6, 1e-6);
    let law = StateDependentTresca {
        b,
        reference_friction: 0.6,
        reference_velocity: 1e-6,
        slip_distance,
    };
    for factor in [1.5, 10.0, 100.0] {
        let stiffness = factor * b * normal / slip_distance;
        for start in [0.0, velocity] {
            for way in WAYS {
                for dt in [0.1, 1.0] {
                    let rests = start == 0.0;
                    let state = (slip_distance / velocity).ln() + f64::from(u8::from(rests));
                    let strength = normal * law.coefficient(0.0, LogTheta(state));
                    let share = if rests { 0.999 } else { 1.0 };
                    let scene = Scene::new(SMatrix::<f64, 1, 1>::new(stiffness))
                        .with_load_history(move |time, load| {
                            load[0][0] = share * strength + stiffness * velocity * time;
                        })
                        .with_velocity(vec![[start].into()])
                        .with_contact(
                            Contact::new(BoundaryPart::point(1.0), law, normal)
                                .with_state(Dieterich { slip_distance }, LogTheta(state)),
                        );
                    let block = Simulation::new(scene, Newmark::default(), Point)?;
                    let mut block = by(way, block)?;
                    let name = format!("{factor}, {start:e}, {way}, {dt}");
                    let report = block
                        .run(&Steps::constant(dt).until(3000.0), |_| ())
                        .map_err(|failure| format!("{name}: {failure}"))?;
                    assert_eq!(report.substepped, 0, "{name}");
                    let rate = block.snapshot().max_slip_rate();
                    assert!((rate / velocity - 1.0).abs() < 1e-6, "{name}: {rate:e}");
                }
            }
        }
    }
    Ok(())
}

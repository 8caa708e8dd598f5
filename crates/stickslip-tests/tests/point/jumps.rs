//! Data that jump: what is left of a jump is the jump, whatever the scheme and the step.

use nalgebra::{SMatrix, Vector1};
use proptest::prelude::*;
use stickslip::friction::{RegularizedDieterichRuina, Tresca};
use stickslip::integrate::Stepper;
use stickslip::state::{Dieterich, LogTheta};
use stickslip::{
    BackwardEuler, BoundaryPart, Components, Contact, GeneralizedAlpha, Newmark, Point, RateScheme,
    Run, RungeKutta, Scene, Sdirk2, Simulation, Steps,
};

use crate::Outcome;

fn one(value: f64) -> SMatrix<f64, 1, 1> {
    SMatrix::<f64, 1, 1>::new(value)
}

fn scheme(which: usize) -> Box<dyn RateScheme> {
    match which {
        0 => Box::new(Newmark::default()),
        1 => Box::new(GeneralizedAlpha {
            spectral_radius: 0.8,
        }),
        2 => Box::new(GeneralizedAlpha {
            spectral_radius: 0.0,
        }),
        3 => Box::new(Sdirk2),
        _ => Box::new(BackwardEuler),
    }
}

/// A block without inertia under Coulomb friction, whose load jumps up, or whose normal stress falls.
#[derive(Debug, Clone, Copy)]
struct Jump {
    stiffness: f64,
    normal_stress: f64,
    /// Of the block's way at the jump [m].
    way: f64,
    /// The time of the jump [s], and how much further the load pulls from then on [m/s].
    time: f64,
    rate: f64,
    falls: bool,
}

const COEFFICIENT: f64 = 0.5;

impl Jump {
    fn simulation(&self, which: usize) -> Outcome<Simulation<1>> {
        let &Self {
            stiffness,
            normal_stress,
            way,
            time: jump,
            rate,
            falls,
        } = self;
        let strength = COEFFICIENT * normal_stress;
        let pull = move |time: f64| stiffness * rate * (time - jump).max(0.0);
        let contact = Contact::new(
            BoundaryPart::point(1.0),
            Tresca {
                coefficient: COEFFICIENT,
            },
            normal_stress,
        );
        let scene = Scene::new(one(stiffness));
        let scene = if falls {
            let drop = stiffness * way / COEFFICIENT;
            scene
                .with_contact(contact.with_normal_stress_history(move |time, stress| {
                    stress[0] = if time > jump {
                        normal_stress
                    } else {
                        normal_stress + drop
                    };
                }))
                .with_load_history(move |time, load| {
                    load[0][0] = strength + stiffness * way + pull(time)
                })
        } else {
            scene
                .with_contact(contact)
                .with_load_history(move |time, load| {
                    let jumped = if time > jump { stiffness * way } else { 0.0 };
                    load[0][0] = strength + jumped + pull(time);
                })
        };
        Ok(Simulation::new(scene, scheme(which), Point)?)
    }

    /// From the step of the jump on the spring is stretched by what the strength holds.
    fn check(&self, which: usize, steps: &Steps) -> Outcome {
        let mut block = self.simulation(which)?;
        let mut wrong = None;
        let until = self.time + 2.0;
        block.run(&steps.clone().until(until), |at| {
            let since = at.time - self.time;
            let expected = if since > 0.0 {
                self.way + self.rate * since
            } else {
                0.0
            };
            let found = at.displacement[0][0];
            let scale = self.way + COEFFICIENT * self.normal_stress / self.stiffness;
            if (found - expected).abs() > 1e-9 * scale {
                wrong = Some(format!("{}: {found:e} for {expected:e}", at.time));
            }
        })?;
        wrong.map_or(Ok(()), |wrong| Err(wrong.into()))
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    /// Constant steps of any size and adaptive ones; with a stop at the jump or without.
    #[test]
    fn a_block_without_inertia_slips_by_the_jump(
        (stiffness, normal_stress) in (3.0..12.0_f64, 3.0..9.0_f64),
        (share, time, rate) in (-4.0..1.0_f64, 0.0..2.0_f64, prop_oneof![Just(0.0), -8.0..-2.0_f64]),
        (which, falls, stops) in (0_usize..5, any::<bool>(), any::<bool>()),
        (dt, tolerance) in (-2.5..0.5_f64, -6.0..-1.0_f64),
    ) {
        let (stiffness, normal_stress) = (10_f64.powf(stiffness), 10_f64.powf(normal_stress));
        let way = 10_f64.powf(share) * normal_stress / stiffness;
        let rate = if rate == 0.0 { 0.0 } else { way * 10_f64.powf(rate + 2.0) };
        let jump = Jump { stiffness, normal_stress, way, time, rate, falls };
        for steps in [Steps::constant(10_f64.powf(dt)), Steps::adaptive(10_f64.powf(tolerance))] {
            let steps = if stops { steps.stopping_at([time]) } else { steps };
            jump.check(which, &steps).map_err(|error| {
                TestCaseError::fail(format!("{jump:?}, {which}, {steps:?}: {error}"))
            })?;
        }
    }
}

/// A velocity that is prescribed piece by piece, with a stop at each jump: the way is that of the pieces.
#[test]
fn a_prescribed_velocity_that_jumps_moves_as_prescribed() -> Outcome {
    let law = RegularizedDieterichRuina {
        a: 0.01,
        b: 0.015,
        reference_friction: 0.6,
        reference_velocity: 1e-6,
        slip_distance: 1e-5,
    };
    for pieces in [
        vec![(0.0, 1e-6), (2.0, 0.0)],
        vec![(0.0, 3e-6), (0.3, 1e-8), (1.7, 5e-5), (2.9, 2e-6)],
        vec![(0.0, 0.0), (0.77, 1e-4), (0.78, 0.0), (1.5, 1e-6)],
    ] {
        let velocity = {
            let pieces = pieces.clone();
            move |time: f64| {
                let before = pieces
                    .iter()
                    .take_while(|piece| piece.0 == 0.0 || piece.0 <= time);
                before.last().map_or(0.0, |piece| piece.1)
            }
        };
        let way = |time: f64| -> f64 {
            let ends = pieces
                .iter()
                .skip(1)
                .map(|piece| piece.0)
                .chain([f64::INFINITY]);
            let moved = pieces
                .iter()
                .zip(ends)
                .map(|(&(begin, rate), end)| rate * (time.min(end) - begin).max(0.0));
            moved.sum()
        };
        let scene = |stateful: bool| {
            let velocity = velocity.clone();
            let scene = Scene::new(one(1e9))
                .with_velocity(vec![Vector1::new(velocity(0.0))])
                .prescribe_velocity(BoundaryPart::point(1.0), Components::ALL, move |time| {
                    [velocity(time)]
                });
            let part = BoundaryPart::point(1.0);
            if stateful {
                let state = Dieterich {
                    slip_distance: 1e-5,
                };
                let contact = Contact::new(part, law, 1e6).with_state(state, LogTheta(2.3));
                scene.with_contact(contact)
            } else {
                scene.with_contact(Contact::new(part, Tresca { coefficient: 0.6 }, 1e6))
            }
        };
        let stops: Vec<f64> = pieces.iter().skip(1).map(|piece| piece.0).collect();
        for steps in [
            Steps::constant(0.5),
            Steps::constant(0.07),
            Steps::adaptive(1e-3),
            Steps::adaptive(1e-6),
        ] {
            for stateful in [false, true] {
                for which in 0..6 {
                    let mut stepper: Box<dyn Stepper<1>> = if which == 5 {
                        if stateful && velocity(0.0) == 0.0 {
                            continue;
                        }
                        Box::new(RungeKutta::new(scene(stateful))?)
                    } else {
                        Box::new(Simulation::new(scene(stateful), scheme(which), Point)?)
                    };
                    let plan = steps.clone().until(4.0).stopping_at(stops.iter().copied());
                    let mut worst = 0.0_f64;
                    stepper.run(&plan, |at| {
                        worst = worst.max((at.displacement[0][0] - way(at.time)).abs());
                    })?;
                    assert!(
                        worst <= 1e-12 * way(4.0),
                        "{pieces:?}, {steps:?}, {stateful}, {which}: {worst:e}"
                    );
                }
            }
        }
    }
    Ok(())
}

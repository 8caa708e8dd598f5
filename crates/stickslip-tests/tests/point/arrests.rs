//! Blocks that friction stops, and blocks that it lets go.

use nalgebra::{SMatrix, Vector1};
use stickslip::friction::{FrictionLaw, Tresca};
use stickslip::state::{StateLaw, Theta};
use stickslip::{
    BackwardEuler, BoundaryPart, Contact, ErrorControl, GeneralizedAlpha, Newmark, Point,
    RateScheme, Scene, Sdirk2, Simulation, Steps,
};

use crate::Outcome;

fn one(value: f64) -> SMatrix<f64, 1, 1> {
    SMatrix::<f64, 1, 1>::new(value)
}

fn schemes() -> [Box<dyn RateScheme>; 4] {
    [
        Box::new(Newmark::default()),
        Box::new(GeneralizedAlpha {
            spectral_radius: 0.8,
        }),
        Box::new(Sdirk2),
        Box::new(BackwardEuler),
    ]
}

/// A block of 1 kg with a velocity, on friction and a spring or none, stops where its energy is spent, at any tolerance
/// to the same number of digits.
#[test]
fn a_block_stops_where_its_energy_is_spent() -> Outcome {
    let (weight, coefficient) = (9.8, 0.3);
    let force: f64 = coefficient * weight;
    let mut missed = Vec::new();
    for stiffness in [0.0, 1e-6, 1e-3, 1e-1] {
        for velocity in [1e-2, 1.0, 10.0, 300.0_f64] {
            let way = if stiffness == 0.0 {
                velocity * velocity / 2.0 / force
            } else {
                let held: f64 = force / stiffness;
                let square = velocity * velocity / stiffness;
                square / ((held * held + square).sqrt() + held)
            };
            // Friction holds it there.
            if stiffness * way > force {
                continue;
            }
            for (number, scheme) in schemes().into_iter().enumerate() {
                let coarse = number == 3;
                let mut scheme = Some(scheme);
                for tolerance in [1e-2, 1e-4, 1e-6] {
                    if coarse && tolerance < 1e-4 {
                        continue;
                    }
                    let scheme = match scheme.take() {
                        Some(scheme) => scheme,
                        None => {
                            let mut all = schemes().into_iter();
                            all.nth(number).ok_or("no scheme")?
                        }
                    };
                    let contact =
                        Contact::new(BoundaryPart::point(1.0), Tresca { coefficient }, weight);
                    let scene = Scene::new(one(stiffness))
                        .with_mass(one(1.0))
                        .with_contact(contact)
                        .with_velocity(vec![Vector1::new(velocity)]);
                    let mut block = Simulation::new(scene, scheme, Point)?;
                    let until = 3.0 * velocity / force;
                    let report = block.run(&Steps::adaptive(tolerance).until(until), |_| ())?;
                    let at = block.snapshot();
                    let off = (at.displacement[0][0] - way).abs() / way;
                    // The error that a step allows of a slip, of the floor of slip, and of some steps.
                    let several = if coarse { report.accepted as f64 } else { 5.0 };
                    let allowed = several * tolerance * (1.0 + 1e-6 / way);
                    if off > allowed {
                        missed.push(format!(
                            "{stiffness:e}, {velocity}, scheme {number}, {tolerance:e}: {off:.1e}, {} steps",
                            report.accepted
                        ));
                    }
                    assert_eq!(
                        at.velocity[0][0], 0.0,
                        "{stiffness:e}, {velocity}, {number}"
                    );
                }
            }
        }
    }
    assert!(missed.is_empty(), "{missed:#?}");
    Ok(())
}

/// Friction between 0.2 and 0.3, the latter at rest: it is knocked down over a slip of a micrometre and comes back within
/// milliseconds of rest.
#[derive(Clone, Copy)]
struct Knocked;

impl FrictionLaw for Knocked {
    type State = Theta;

    fn coefficient(&self, _: f64, Theta(x): Theta) -> f64 {
        0.2 + 0.1 * x.clamp(0.0, 1.0)
    }

    fn coefficient_rate_slope(&self, _: f64, _: Theta) -> f64 {
        0.0
    }

    fn potential(&self, rate: f64, x: Theta) -> f64 {
        rate * self.coefficient(rate, x)
    }
}

#[derive(Clone, Copy)]
struct Knock;

impl StateLaw for Knock {
    type State = Theta;

    fn evolution(&self, Theta(x): Theta, rate: f64) -> f64 {
        (1.0 - x) / 1e-3 - rate / 1e-6 * x
    }

    fn evolution_state_slope(&self, _: Theta, rate: f64) -> f64 {
        -1.0 / 1e-3 - rate / 1e-6
    }
}

/// A block that a spring pulls at 1 cm/s lets go when the spring holds the static strength, and slips until it is as
/// much below the kinetic one as it was above: three slips, each of twice the difference over the stiffness but for the
/// way of the knock-down and the loading meanwhile.
#[test]
fn a_block_lets_go_from_rest_by_adaptive_steps() -> Outcome {
    let (stiffness, normal, rate) = (4e3, 98.1, 0.01);
    // sqrt(1 + tan^2) terms of the loading during the slip add 1 %.
    let slips = |steps: &Steps, scheme: Box<dyn RateScheme>| -> Outcome<f64> {
        let contact =
            Contact::new(BoundaryPart::point(1.0), Knocked, normal).with_state(Knock, Theta(1.0));
        let scene = Scene::new(one(stiffness))
            .with_mass(one(10.0))
            .with_contact(contact)
            .with_load_history(move |time, load| load[0][0] = stiffness * rate * time);
        let mut block = Simulation::new(scene, scheme, Point)?;
        block.run(&steps.clone().until(2.5), |_| ())?;
        Ok(block.snapshot().displacement[0][0])
    };
    for tolerance in [1e-2, 1e-3, 1e-4] {
        let rest = ErrorControl {
            slip_rate_floor: 1e-9,
            ..ErrorControl::default()
        };
        for steps in [
            Steps::adaptive(tolerance),
            Steps::adaptive(tolerance).with_error_control(rest),
        ] {
            for scheme in schemes().into_iter().take(3) {
                let found = slips(&steps, scheme)?;
                assert!(
                    (found - 2.025e-2).abs() < 2e-2 * 2.025e-2,
                    "{tolerance}: {found:e}"
                );
            }
        }
    }
    Ok(())
}

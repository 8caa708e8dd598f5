//! Steps with several solutions against the force of the step, looked at rate by rate.

use std::f64::consts::LN_10;

use nalgebra::SMatrix;
use proptest::prelude::*;
use stickslip::friction::{DieterichRuina, FrictionLaw};
use stickslip::state::{Dieterich, LogTheta, StateLaw};
use stickslip::{
    BackwardEuler, BoundaryPart, Contact, FixedPoint, Newmark, Point, Scene, Simulation,
    StateUpdate, StepError,
};

use crate::Outcome;

/// A block on a spring that slides at `rate`, in balance with a pull but for its inertia.
#[derive(Debug, Clone, Copy)]
struct Block {
    stiffness: f64,
    mass: f64,
    damping: f64,
    pull: f64,
    rate: f64,
    state: f64,
    friction: DieterichRuina,
    scheme: Scheme,
}

/// Scheme and state update, without stages.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Scheme {
    BackwardEuler,
    /// With the state at the midpoint.
    Newmark,
}

const NORMAL_STRESS: f64 = 1e6;
const SLIP_DISTANCE: f64 = 1e-5;
const LAW: Dieterich = Dieterich {
    slip_distance: SLIP_DISTANCE,
};

fn friction(ratio: f64) -> DieterichRuina {
    DieterichRuina {
        a: 0.01,
        b: 0.01 * ratio,
        reference_friction: 0.6,
        reference_velocity: 1e-6,
        slip_distance: SLIP_DISTANCE,
    }
}

impl Block {
    /// The acceleration from which it starts.
    fn acceleration(&self) -> f64 {
        let coefficient = (self.friction).coefficient(self.rate, LogTheta(self.state));
        let forces = self.pull - self.damping * self.rate - NORMAL_STRESS * coefficient;
        if self.mass > 0.0 {
            forces / self.mass
        } else {
            0.0
        }
    }

    /// The force that is left at a velocity after a step of `dt`, and the largest of its terms.
    fn left(&self, velocity: f64, dt: f64) -> Outcome<[f64; 2]> {
        let (rate, start) = (velocity.abs(), LogTheta(self.state));
        let (moved, acceleration, end) = match self.scheme {
            Scheme::BackwardEuler => (
                dt * velocity,
                (velocity - self.rate) / dt,
                LAW.advance(start, rate, dt)?,
            ),
            Scheme::Newmark => (
                0.5 * dt * (self.rate + velocity),
                2.0 * (velocity - self.rate) / dt - self.acceleration(),
                LAW.advance_at_constant_rate(start, 0.5 * (self.rate + rate), dt)?,
            ),
        };
        let terms = [
            self.mass * acceleration,
            self.damping * velocity,
            self.stiffness * moved,
            -self.pull,
            NORMAL_STRESS * self.friction.coefficient(rate, end) * velocity.signum(),
        ];
        let largest = terms.iter().map(|term| term.abs()).fold(0.0, f64::max);
        Ok([terms.iter().sum(), largest])
    }

    /// The sign of the force at a velocity, 0 for what rounding may leave of it.
    fn sign(&self, velocity: f64, dt: f64) -> Outcome<i32> {
        let [left, largest] = self.left(velocity, dt)?;
        Ok(if left.abs() <= 1e-12 * largest {
            0
        } else if left < 0.0 {
            -1
        } else {
            1
        })
    }

    /// The number of rates from 1e-20 to 1e5 m/s that solve the step.
    fn solutions(&self, dt: f64) -> Outcome<usize> {
        let (mut count, mut negative) = (0, true);
        for n in 0..=5000 {
            let x = LN_10 * (f64::from(n) / 200.0 - 20.0);
            let is_negative = self.left(x.exp(), dt)?[0] < 0.0;
            count += usize::from(negative != is_negative);
            negative = is_negative;
        }
        Ok(count)
    }

    /// The velocities on the way from the old one to a new one, in 4000 steps of their logarithm and through zero if it
    /// turns.
    fn way(&self, velocity: f64) -> Vec<f64> {
        const COUNT: i32 = 4000;
        let between = |from: f64, to: f64| {
            (0..COUNT)
                .map(move |n| from * ((to / from).ln() * f64::from(n) / f64::from(COUNT)).exp())
        };
        if velocity > 0.0 {
            between(self.rate, velocity).collect()
        } else {
            let small = 1e-25;
            let back = between(small, -velocity).map(|rate| -rate);
            between(self.rate, small).chain(back).collect()
        }
    }

    fn simulation(&self) -> Outcome<Simulation<1>> {
        let one = SMatrix::<f64, 1, 1>::new;
        let contact = Contact::new(BoundaryPart::point(1.0), self.friction, NORMAL_STRESS)
            .with_state(LAW, LogTheta(self.state));
        let mut scene = Scene::new(one(self.stiffness))
            .with_contact(contact)
            .with_load(vec![[self.pull].into()])
            .with_velocity(vec![[self.rate].into()]);
        if self.mass > 0.0 {
            scene = scene.with_mass(one(self.mass));
        }
        if self.damping > 0.0 {
            scene = scene.with_viscosity(one(self.damping));
        }
        let block = match self.scheme {
            Scheme::BackwardEuler => Simulation::new(scene, BackwardEuler, Point)?
                .with_state_update(StateUpdate::BackwardEuler),
            Scheme::Newmark => Simulation::new(scene, Newmark::default(), Point)?,
        };
        Ok(block.with_tolerance(1e-13)?)
    }

    /// That a velocity solves the step, and that none on the way to it does.
    fn check_accepted(&self, velocity: f64, dt: f64) -> Outcome {
        let [left, largest] = self.left(velocity, dt)?;
        let apart = 1e-5;
        let signs = [1.0 - apart, 1.0 + apart].map(|factor| self.sign(factor * velocity, dt));
        let [below, above] = signs;
        let solves = below? * above? < 0 || left.abs() <= 1e-10 * largest;
        if !solves {
            return Err(format!("{velocity:e} leaves {left:e} of {largest:e}").into());
        }
        let driven = self.sign(self.rate, dt)?;
        for passed in self.way(velocity) {
            let last = (passed / velocity - 1.0).abs() < apart;
            let sign = self.sign(passed, dt)?;
            if !last && driven * sign < 0 {
                return Err(format!("before {velocity:e} there is {passed:e}").into());
            }
        }
        Ok(())
    }
}

/// An accepted step has a single solution on the way from the old to the new rate. A refused one becomes acceptable by
/// halving. A step that is convex at all rates is accepted.
fn check(block: &Block, dt: f64) -> Outcome<[bool; 2]> {
    let mut counted = [false; 2];
    for fixed_point in [false, true] {
        let mut simulation = block.simulation()?;
        if fixed_point {
            simulation.set_coupling(FixedPoint::accelerated().with_max_iterations(2000));
        }
        let convex = simulation.convexity(dt, 1e5)?.convex;
        let mut part = dt;
        for halvings in 0.. {
            let failure = match simulation.step(part) {
                Ok(_) => {
                    let velocity = simulation.snapshot().velocity[0][0];
                    block.check_accepted(velocity, part)?;
                    counted[0] |= halvings == 0 && !convex;
                    break;
                }
                Err(failure) => failure,
            };
            match failure.cause {
                StepError::NotUnique {
                    vertex: 0,
                    slip_rate,
                    dt,
                    shorter,
                } if dt == part && shorter && slip_rate == block.rate => {
                    counted[1] = true;
                    if convex && halvings == 0 {
                        return Err(format!("convex: {failure}").into());
                    }
                }
                StepError::NotCoupled { .. } if fixed_point => {}
                _ => return Err(failure.into()),
            }
            if halvings == 60 {
                return Err(format!("for all step sizes: {failure}").into());
            }
            part /= 2.0;
        }
    }
    Ok(counted)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1024))]

    #[test]
    fn an_accepted_step_has_a_single_solution_on_its_way(
        (stiffness, resistance) in (1e5..1e9_f64, 0.0..1.0_f64),
        (rate, excess) in (-9.0..-1.0_f64, -0.5..0.5_f64),
        (age, ratio) in (-3.0..6.0_f64, 1.0..4.0_f64),
        (dt, kind) in (-5.0..0.0_f64, 0..5),
    ) {
        let (rate, friction) = (10_f64.powf(rate), friction(ratio));
        let mass = 10_f64.powf(1.0 + 6.0 * resistance);
        let damping = 10_f64.powf(2.0 + 6.0 * resistance);
        let [mass, damping] = match kind {
            0 | 1 => [mass, 0.0],
            2 => [mass, 0.1 * damping],
            3 => [0.0, damping],
            _ => [0.0; 2],
        };
        // The state is off its steady value; the pull off balance by some of the direct effect.
        let state = (SLIP_DISTANCE / rate).ln() + age;
        let coefficient = friction.coefficient(rate, LogTheta(state));
        let pull = NORMAL_STRESS * (coefficient + 0.01 * excess) + damping * rate;
        let scheme = if kind == 1 { Scheme::Newmark } else { Scheme::BackwardEuler };
        let block = Block { stiffness, mass, damping, pull, rate, state, friction, scheme };
        let checked = check(&block, 10_f64.powf(dt));
        checked.map_err(|error| TestCaseError::fail(format!("{block:?}: {error}")))?;
    }
}

/// Of the same kinds of blocks, in a grid: steps that are not convex are accepted, others refused.
#[test]
fn both_happen() -> Outcome {
    let mut counted = [0; 2];
    for n in 0..200 {
        // Digits of multiples of irrational numbers.
        let [mass, dt, rate, age] =
            [2.0_f64, 3.0, 5.0, 7.0].map(|p| (f64::from(n) * p.sqrt()).fract());
        let rate = 10_f64.powf(-9.0 + 7.0 * rate);
        let (friction, state) = (friction(2.0), (SLIP_DISTANCE / rate).ln() + 6.0 * age);
        let coefficient = friction.coefficient(rate, LogTheta(state));
        let block = Block {
            stiffness: 1e7,
            mass: 10_f64.powf(1.0 + 6.0 * mass),
            damping: 0.0,
            pull: NORMAL_STRESS * (coefficient + 0.005),
            rate,
            state,
            friction,
            scheme: if n % 2 == 0 {
                Scheme::Newmark
            } else {
                Scheme::BackwardEuler
            },
        };
        let found = check(&block, 10_f64.powf(-5.0 + 4.0 * dt))?;
        for (count, found) in counted.iter_mut().zip(found) {
            *count += usize::from(found);
        }
    }
    assert!(counted.iter().all(|&count| count > 10), "{counted:?}");
    Ok(())
}

/// A step that is said to be convex has one solution, of all that are looked for.
#[test]
fn a_convex_step_has_a_single_solution() -> Outcome {
    let (mut convex, mut several) = (0, 0);
    for n in 0..600 {
        // Digits of multiples of irrational numbers.
        let [mass, dt, rate, age] =
            [2.0_f64, 3.0, 5.0, 7.0].map(|p| (f64::from(n) * p.sqrt()).fract());
        let (mass, dt) = (10_f64.powf(1.0 + 6.0 * mass), 10_f64.powf(-5.0 + 4.0 * dt));
        let rate = 10_f64.powf(-9.0 + 7.0 * rate);
        let (friction, state) = (friction(2.0), (SLIP_DISTANCE / rate).ln() + 6.0 * age);
        let pull = NORMAL_STRESS * (friction.coefficient(rate, LogTheta(state)) + 0.005);
        let block = Block {
            stiffness: 1e7,
            mass,
            damping: 0.0,
            pull,
            rate,
            state,
            friction,
            scheme: Scheme::BackwardEuler,
        };
        let found = block.simulation()?.convexity(dt, 1e5)?;
        let solutions = block.solutions(dt)?;
        assert!(
            solutions == 1 || !found.convex,
            "{block:?}, {dt:e}: {solutions}"
        );
        convex += usize::from(found.convex);
        several += usize::from(solutions > 1);
    }
    assert!(convex > 50 && several > 5, "{convex}, {several}");
    Ok(())
}

//! Steps that arrest a block under friction that weakens with slip, against the force of the step, looked at rate by rate.

use nalgebra::SMatrix;
use proptest::prelude::*;
use stickslip::friction::{DieterichRuina, FrictionLaw, StateDependentTresca};
use stickslip::state::{Dieterich, LogTheta, Ruina, StateLaw};
use stickslip::{
    BackwardEuler, BoundaryPart, Contact, GeneralizedAlpha, Newmark, Point, Scene, Simulation,
    StateUpdate, StepError, Steps,
};

use crate::Outcome;

fn one(value: f64) -> SMatrix<f64, 1, 1> {
    SMatrix::<f64, 1, 1>::new(value)
}

const NORMAL_STRESS: f64 = 1e6;

/// A block on a spring that slides at `rate` under a pull.
#[derive(Debug, Clone, Copy)]
struct Block<L, S> {
    stiffness: f64,
    mass: f64,
    pull: f64,
    rate: f64,
    state: f64,
    friction: L,
    evolution: S,
    /// The scheme: Newmark's, with the state at the midpoint, or backward Euler.
    midpoint: bool,
}

/// By how much friction of the steepest law, `b = 0.03`, lies above its tangents at slip rates 5 % apart,
/// `(ln 1.05)^2/8 b sigma`, three times \[Pa\].
const TANGENTS: f64 = 1e-3 * 0.03 * NORMAL_STRESS;

impl<L, S> Block<L, S>
where
    L: FrictionLaw<State = LogTheta> + Copy + 'static,
    S: StateLaw<State = LogTheta> + Copy + 'static,
{
    fn scene(&self) -> Scene<SMatrix<f64, 1, 1>, 1> {
        let contact = Contact::new(BoundaryPart::point(1.0), self.friction, NORMAL_STRESS)
            .with_state(self.evolution, LogTheta(self.state));
        let (pull, start) = (self.pull, self.starting_pull());
        let scene = Scene::new(one(self.stiffness))
            .with_load_history(move |time, load| load[0][0] = if time > 0.0 { pull } else { start })
            .with_velocity(vec![[self.rate].into()])
            .with_contact(contact);
        if self.mass > 0.0 {
            scene.with_mass(one(self.mass))
        } else {
            scene
        }
    }

    /// The load at the start: without mass friction that reads the slip rate is in balance with it.
    fn starting_pull(&self) -> f64 {
        if self.mass > 0.0 {
            self.pull
        } else {
            NORMAL_STRESS * (self.friction).coefficient(self.rate, LogTheta(self.state))
        }
    }

    /// The friction at a slip rate after a step of `dt`.
    fn friction(&self, rate: f64, dt: f64) -> Outcome<f64> {
        let start = LogTheta(self.state);
        let end = if self.midpoint {
            let mean = 0.5 * (self.rate + rate);
            self.evolution.advance_at_constant_rate(start, mean, dt)?
        } else {
            self.evolution.advance(start, rate, dt)?
        };
        Ok(NORMAL_STRESS * self.friction.coefficient(rate, end))
    }

    /// The force on the contact at a velocity after a step of `dt`.
    fn force(&self, velocity: f64, dt: f64) -> f64 {
        let coefficient = (self.friction).coefficient(self.rate, LogTheta(self.state));
        let (moved, inertia) = if self.midpoint {
            let start = self.pull - NORMAL_STRESS * coefficient;
            let change = 2.0 * (velocity - self.rate) / dt;
            (
                0.5 * dt * (self.rate + velocity),
                self.mass * change - start,
            )
        } else {
            (dt * velocity, self.mass * (velocity - self.rate) / dt)
        };
        self.pull - self.stiffness * moved - inertia
    }

    /// Whether rest is the only solution with a rate up to the old one, and with any, by as much as friction may exceed its
    /// tangents. Between two samples friction of a state alone falls, and so does the force: none is missed among the latter.
    fn rest_is_alone(&self, dt: f64) -> Outcome<[bool; 2]> {
        let rests = self.force(0.0, dt).abs() <= self.friction(0.0, dt)?;
        let mut alone = [rests; 2];
        for n in 0..=4200 {
            // From 1e-16 to 1e12 of the old rate, which is one of them, and the sample below.
            let shares = [n, n - 1].map(|n| 10_f64.powf(-16.0 + f64::from(n) / 150.0));
            let [rate, below] = shares.map(|share| share * self.rate);
            let friction = self.friction(rate, dt)?;
            let exceeds = |rate: f64, friction: f64| {
                let signs = [-1.0, 1.0];
                signs.map(|sign| self.force(sign * rate, dt) * sign > friction) != [false; 2]
            };
            alone[0] &= shares[0] > 1.0 + 1e-9 || !exceeds(rate, friction);
            alone[1] &= !exceeds(below, friction - TANGENTS);
        }
        Ok(alone)
    }

    /// That a step which arrests the block has no other solution up to the old rate, and that a step is not refused if rest
    /// is its only solution. Returns whether it was accepted, and whether refused.
    fn check(&self, dt: f64) -> Outcome<[bool; 2]> {
        let taken = if self.midpoint {
            let mut block = Simulation::new(self.scene(), Newmark::default(), Point)?;
            let taken = block.step(dt).map(|_| ());
            taken.map(|()| block.snapshot().velocity[0][0])
        } else {
            let block = Simulation::new(self.scene(), BackwardEuler, Point)?;
            let mut block = block.with_state_update(StateUpdate::BackwardEuler);
            let taken = block.step(dt).map(|_| ());
            taken.map(|()| block.snapshot().velocity[0][0])
        };
        let [near, everywhere] = self.rest_is_alone(dt)?;
        match taken {
            Ok(0.0) if near => Ok([true, false]),
            Ok(0.0) => Err("accepted, of several".into()),
            Ok(_) => Ok([false; 2]),
            Err(failure) if matches!(failure.cause, StepError::NotUnique { .. }) => {
                if everywhere {
                    return Err(failure.into());
                }
                Ok([false, true])
            }
            Err(failure) => Err(failure.into()),
        }
    }
}

/// The same of all pairs of laws, and of blocks with and without mass.
fn check_laws(numbers: [f64; 8]) -> Outcome<[usize; 2]> {
    let [stiffness, mass, share, rate, age, length, b, dt] = numbers;
    let (slip_distance, rate) = (10_f64.powf(length), 10_f64.powf(rate));
    let friction = DieterichRuina {
        a: 0.5 * b,
        b,
        reference_friction: 0.6,
        reference_velocity: 1e-6,
        slip_distance,
    };
    let steady = (slip_distance / rate).ln();
    let dt = 10_f64.powf(dt) * slip_distance / rate;
    // Of the order of the weakening over the slip of a step.
    let stiffness = 10_f64.powf(stiffness) * b * NORMAL_STRESS / slip_distance;
    let mass = 10_f64.powf(mass) * b * NORMAL_STRESS * dt / rate;
    let mut counts = [0; 2];
    for n in 0..16 {
        let [midpoint, inertia, sticks, aging] = [1, 2, 4, 8].map(|bit| n & bit != 0);
        if midpoint && !inertia {
            // Another scheme takes a step that arrests the block.
            continue;
        }
        let tresca = StateDependentTresca::from(friction);
        let least = NORMAL_STRESS * tresca.coefficient(0.0, LogTheta(steady));
        let block = Block {
            stiffness,
            mass: if inertia { mass } else { 0.0 },
            pull: least + share * b * age * NORMAL_STRESS,
            rate,
            state: steady + age,
            friction: tresca,
            evolution: Dieterich { slip_distance },
            midpoint,
        };
        let evolution = Ruina { slip_distance };
        let checked = match (sticks, aging) {
            (true, true) => block.check(dt),
            (true, false) => with(block, tresca, evolution).check(dt),
            (false, true) => with(block, friction, block.evolution).check(dt),
            (false, false) => with(block, friction, evolution).check(dt),
        };
        let checked = checked.map_err(|error| format!("{n}, {block:?}, {dt:e}: {error}"))?;
        for (count, checked) in counts.iter_mut().zip(checked) {
            *count += usize::from(checked);
        }
    }
    Ok(counts)
}

/// The block with other laws.
fn with<A, B, L, S>(block: Block<A, B>, friction: L, evolution: S) -> Block<L, S> {
    let Block {
        stiffness,
        mass,
        pull,
        rate,
        state,
        midpoint,
        ..
    } = block;
    Block {
        stiffness,
        mass,
        pull,
        rate,
        state,
        friction,
        evolution,
        midpoint,
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(256))]

    #[test]
    fn an_arrest_is_the_only_solution_up_to_the_old_rate(
        (stiffness, mass, share) in (-4.0..1.0_f64, -4.0..1.0_f64, -3.0..1.5_f64),
        (rate, age, length) in (-9.0..-3.0_f64, 0.01..5.0_f64, -6.0..-3.0_f64),
        (b, dt) in (0.005..0.03_f64, -3.0..3.0_f64),
    ) {
        let checked = check_laws([stiffness, mass, share, rate, age, length, b, dt]);
        checked.map_err(|error| TestCaseError::fail(error.to_string()))?;
    }
}

/// Among blocks of these kinds steps are accepted, and refused, by both schemes.
#[test]
fn arrests_are_accepted_and_refused() -> Outcome {
    let mut counts = [0; 2];
    for n in 0..60 {
        // Digits of multiples of irrational numbers.
        let [share, age, b, dt] =
            [2.0_f64, 3.0, 5.0, 7.0].map(|p| (f64::from(n) * p.sqrt()).fract());
        let numbers = [
            -3.0,
            -3.0,
            4.0 * share - 3.0,
            -6.0,
            0.1 + 4.0 * age,
            -5.0,
            0.01 + 0.02 * b,
        ];
        let [stiffness, mass, share, rate, age, length, b] = numbers;
        let found = check_laws([stiffness, mass, share, rate, age, length, b, 4.0 * dt - 2.0])?;
        for (count, found) in counts.iter_mut().zip(found) {
            *count += found;
        }
    }
    assert!(counts.iter().all(|&count| count > 60), "{counts:?}");
    Ok(())
}

/// A block whose load falls below the friction of any rate sticks in steps of any size, however soft its spring, and ages.
#[test]
fn a_block_that_its_load_no_longer_moves_sticks() -> Outcome {
    let law = StateDependentTresca {
        reference_friction: 0.6,
        b: 0.015,
        reference_velocity: 1e-6,
        slip_distance: 1e-5,
    };
    for n in 0..40 {
        // Digits of multiples of irrational numbers.
        let [share, rate, age, dt] =
            [2.0_f64, 3.0, 5.0, 7.0].map(|p| (f64::from(n) * p.sqrt()).fract());
        let rate = 10_f64.powf(-7.0 + 3.0 * rate);
        let steady = (law.slip_distance / rate).ln();
        let least = NORMAL_STRESS * law.coefficient(0.0, LogTheta(steady));
        let block = Block {
            stiffness: 1e3,
            mass: 0.0,
            pull: least * (1.0 - 0.5 * share) - 1.0,
            rate,
            state: steady + 3.0 * age,
            friction: law,
            evolution: Dieterich {
                slip_distance: law.slip_distance,
            },
            midpoint: true,
        };
        let mut sticking = Simulation::new(block.scene(), GeneralizedAlpha::default(), Point)?;
        let dt = 10_f64.powf(-2.0 + 4.0 * dt) * law.slip_distance / rate;
        sticking.run(&Steps::constant(dt).count(20).without_substeps(), |_| ())?;
        let at = sticking.snapshot();
        assert_eq!(at.velocity[0][0], 0.0, "{block:?}");
        assert!(at.displacement[0][0].abs() <= rate * dt, "{block:?}");
        // At rest `theta` grows as time, whatever it was.
        assert!(at.contact(0).state(0).exp() >= 19.0 * dt, "{block:?}");
    }
    Ok(())
}

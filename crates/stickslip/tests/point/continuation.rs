//! Steps with several solutions against the solution traced as the step grows.

use std::f64::consts::LN_10;

use nalgebra::SMatrix;
use proptest::prelude::*;
use stickslip::friction::{DieterichRuina, FrictionLaw};
use stickslip::state::{Dieterich, LogTheta, StateLaw};
use stickslip::{
    BackwardEuler, Contact, FixedPoint, Part, Point, Scene, Simulation, StateUpdate, StepError,
};

use crate::Outcome;

/// A block on a spring that slides at `rate`, in balance with a pull but for its inertia.
#[derive(Debug, Clone, Copy)]
struct Block {
    stiffness: f64,
    mass: f64,
    pull: f64,
    rate: f64,
    state: f64,
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

/// The end of a traced solution.
#[derive(Debug)]
enum Traced {
    Rate(f64),
    /// The step size at which it folds [s].
    Fold(f64),
}

impl Block {
    /// The force that is left at the rate `exp(x)` after a step of `dt` by backward Euler, and its slope in `x`.
    fn left(&self, friction: &DieterichRuina, x: f64, dt: f64) -> Outcome<(f64, f64)> {
        let rate = x.exp();
        let start = LogTheta(self.state);
        let end = LAW.advance(start, rate, dt)?;
        let response = friction.response(rate, end);
        let follows = response.state_slope * LAW.advance_rate_slope(start, end, rate, dt);
        let inertia = self.mass / dt;
        let force = inertia * (rate - self.rate) + self.stiffness * dt * rate - self.pull
            + NORMAL_STRESS * response.coefficient;
        let slope = inertia + self.stiffness * dt + NORMAL_STRESS * (response.rate_slope + follows);
        Ok((force, slope * rate))
    }

    /// Follows `ln V` from a tiny step on in 20 000 steps that grow evenly in their logarithm, by Newton's method that
    /// may not run away.
    fn trace(&self, friction: &DieterichRuina, dt: f64) -> Outcome<Traced> {
        const COUNT: i32 = 20_000;
        let (mut x, decades) = (self.rate.ln(), 10.0);
        for n in 0..=COUNT {
            let part = dt * 10_f64.powf(decades * (f64::from(n) / f64::from(COUNT) - 1.0));
            let start = x;
            for _ in 0..100 {
                let (force, slope) = self.left(friction, x, part)?;
                if slope <= 0.0 {
                    return Ok(Traced::Fold(part));
                }
                let step = (force / slope).clamp(-0.05, 0.05);
                x -= step;
                // The smallest step frees what the direct effect holds: any rate, but a single one.
                if n > 0 && (x - start).abs() > 0.3 {
                    return Ok(Traced::Fold(part));
                }
                if step.abs() < 1e-14 * x.abs() {
                    break;
                }
            }
        }
        Ok(Traced::Rate(x.exp()))
    }

    /// The number of rates from 1e-20 to 1e5 m/s that solve the step.
    fn solutions(&self, friction: &DieterichRuina, dt: f64) -> Outcome<usize> {
        let (mut count, mut negative) = (0, true);
        for n in 0..=5000 {
            let x = LN_10 * (f64::from(n) / 200.0 - 20.0);
            let is_negative = self.left(friction, x, dt)?.0 < 0.0;
            count += usize::from(negative != is_negative);
            negative = is_negative;
        }
        Ok(count)
    }

    fn simulation(
        &self,
        friction: DieterichRuina,
        fixed_point: bool,
    ) -> Outcome<Simulation<SMatrix<f64, 1, 1>, 1>> {
        let pull = self.pull;
        let scene = Scene::new(SMatrix::<f64, 1, 1>::new(self.stiffness))
            .with_mass(SMatrix::from([[self.mass]]))
            .with_contact(
                Contact::new(Part::point(1.0), friction, NORMAL_STRESS)
                    .with_state(LAW, LogTheta(self.state)),
            )
            .with_load(vec![[pull].into()])
            .with_velocity(vec![[self.rate].into()]);
        let block = Simulation::new(scene, BackwardEuler, Point)?
            .with_state_update(StateUpdate::BackwardEuler);
        Ok(if fixed_point {
            block.with_coupling(FixedPoint::accelerated().with_max_iterations(2000))
        } else {
            block
        })
    }
}

proptest! {
    // 256 cases take a second.
    #![proptest_config(ProptestConfig::default())]

    /// Rates found are those traced; where the trace folds the step is refused, at that size. A fold so narrow that it is
    /// passed, or a step so long that it is not seen, leads to a solution that is the only one.
    #[test]
    fn the_solution_is_the_one_that_continues_the_last_step(
        (stiffness, mass) in (1e5..1e9_f64, 1.0..7.0_f64),
        (rate, excess) in (-9.0..-1.0_f64, -0.5..0.5_f64),
        (age, ratio) in (-3.0..6.0_f64, 1.0..4.0_f64),
        dt in -5.0..0.0_f64,
    ) {
        let (mass, rate, dt) = (10_f64.powf(mass), 10_f64.powf(rate), 10_f64.powf(dt));
        let friction = friction(ratio);
        // The state is off its steady value; the pull off balance by some of the direct effect.
        let state = (SLIP_DISTANCE / rate).ln() + age;
        let coefficient = friction.coefficient(rate, LogTheta(state));
        let pull = NORMAL_STRESS * (coefficient + 0.01 * excess);
        let block = Block { stiffness, mass, pull, rate, state };
        let text = |error: Box<dyn std::error::Error>| TestCaseError::fail(error.to_string());
        let traced = block.trace(&friction, dt).map_err(text)?;
        for fixed_point in [false, true] {
            let mut simulation = block.simulation(friction, fixed_point).map_err(text)?;
            match (&traced, simulation.step(dt)) {
                (Traced::Rate(rate), Ok(_)) => {
                    let found = simulation.snapshot().velocity[0][0];
                    prop_assert!((found / rate - 1.0).abs() < 1e-6, "{found:e}, {rate:e}");
                }
                (Traced::Fold(fold), Err(failure)) => match failure.cause {
                    StepError::Fold { reached, .. } => {
                        prop_assert!((reached / fold - 1.0).abs() < 0.01, "{reached:e}, {fold:e}");
                    }
                    StepError::NotCoupled { .. } if fixed_point => (),
                    _ => return Err(TestCaseError::fail(failure.to_string())),
                },
                (Traced::Fold(_), Ok(report)) => {
                    let found = simulation.snapshot().velocity[0][0];
                    let solutions = block.solutions(&friction, dt).map_err(text)?;
                    prop_assert!(solutions == 1, "{report:?}: {found:e} of {solutions}");
                }
                (_, Err(failure)) if fixed_point && matches!(failure.cause, StepError::NotCoupled { .. }) => (),
                (traced, result) => {
                    let found = simulation.snapshot().velocity[0][0];
                    return Err(TestCaseError::fail(format!("{traced:?}, {result:?}, {found:e}")));
                }
            }
        }
    }
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
            pull,
            rate,
            state,
        };
        let found = block.simulation(friction, false)?.convexity(dt, 1e5)?;
        let solutions = block.solutions(&friction, dt)?;
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

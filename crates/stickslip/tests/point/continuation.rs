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
/// A rate within this factor of the last one continues it, unless the slip is as long as its distance and the state leaves
/// where it began by that factor as well.
const NEAR: f64 = 2.0;
/// On the way there it may be within that factor of what is expected, which may be within it of the last one.
const PASSED: f64 = NEAR * NEAR;
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
struct Traced {
    rate: f64,
    folds: Vec<Fold>,
}

/// Where a solution ends and another one takes over.
#[derive(Debug)]
struct Fold {
    /// The step size [s].
    dt: f64,
    /// The factor between the rates.
    jump: f64,
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

    /// Follows `ln V` from a tiny step on in 8000 steps that grow evenly in their logarithm, by Newton's method that
    /// may not run away. Where that ends, it goes on at the next solution to which the force drives the rate.
    fn trace(&self, friction: &DieterichRuina, dt: f64) -> Outcome<Traced> {
        const COUNT: i32 = 8000;
        let (mut x, decades) = (self.rate.ln(), 10.0);
        let mut found = Vec::new();
        for n in 0..=COUNT {
            let part = dt * 10_f64.powf(decades * (f64::from(n) / f64::from(COUNT) - 1.0));
            let start = x;
            let mut folds = false;
            for _ in 0..100 {
                let (force, slope) = self.left(friction, x, part)?;
                let step = (force / slope).clamp(-0.05, 0.05);
                // The smallest step frees what the direct effect holds: any rate, but a single one.
                if slope <= 0.0 || n > 0 && (x - step - start).abs() > 0.3 {
                    folds = true;
                    break;
                }
                x -= step;
                if step.abs() < 1e-14 * x.abs() {
                    break;
                }
            }
            if folds {
                x = self.driven(friction, start, part)?;
                let jump = (x - start).abs().exp();
                found.push(Fold { dt: part, jump });
            }
        }
        Ok(Traced {
            rate: x.exp(),
            folds: found,
        })
    }

    /// The logarithm of the rate at which the force that drives it from `x` away is balanced.
    fn driven(&self, friction: &DieterichRuina, x: f64, dt: f64) -> Outcome<f64> {
        let drives = self.left(friction, x, dt)?.0.signum();
        let (mut inside, mut outside) = (x, x - 0.01 * drives);
        while self.left(friction, outside, dt)?.0.signum() == drives {
            (inside, outside) = (outside, outside - 0.01 * drives);
        }
        while (outside - inside).abs() > 1e-14 * x.abs().max(1.0) {
            let middle = 0.5 * (inside + outside);
            if self.left(friction, middle, dt)?.0.signum() == drives {
                inside = middle;
            } else {
                outside = middle;
            }
        }
        Ok(inside)
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

/// Rates found are those traced. Where the trace folds the step is refused, at that size, unless the rate is near the last
/// one where the state is, too. A fold is passed only where the rate jumps by little, and to the solution beyond it; or
/// a step so long that it is not seen leads to a solution that is the only one.
fn check(
    [stiffness, mass]: [f64; 2],
    [rate, excess]: [f64; 2],
    [age, ratio]: [f64; 2],
    dt: f64,
) -> Result<(), TestCaseError> {
    let (mass, rate, dt) = (10_f64.powf(mass), 10_f64.powf(rate), 10_f64.powf(dt));
    let friction = friction(ratio);
    // The state is off its steady value; the pull off balance by some of the direct effect.
    let state = (SLIP_DISTANCE / rate).ln() + age;
    let coefficient = friction.coefficient(rate, LogTheta(state));
    let pull = NORMAL_STRESS * (coefficient + 0.01 * excess);
    let block = Block {
        stiffness,
        mass,
        pull,
        rate,
        state,
    };
    let text = |error: Box<dyn std::error::Error>| TestCaseError::fail(error.to_string());
    let traced = block.trace(&friction, dt).map_err(text)?;
    for fixed_point in [false, true] {
        let mut simulation = block.simulation(friction, fixed_point).map_err(text)?;
        let result = simulation.step(dt);
        let found = simulation.snapshot().velocity[0][0];
        match result {
            Err(failure)
                if fixed_point && matches!(failure.cause, StepError::NotCoupled { .. }) => {}
            Err(failure) => {
                let StepError::Fold { reached, .. } = failure.cause else {
                    return Err(TestCaseError::fail(format!("{failure}, {traced:?}")));
                };
                let mut passed = (traced.folds.iter()).take_while(|fold| fold.dt < 0.99 * reached);
                let at = |fold: &Fold| (reached / fold.dt - 1.0).abs() < 0.01;
                prop_assert!(
                    traced.folds.iter().any(at) && passed.all(|fold| fold.jump <= PASSED),
                    "{reached:e}, {traced:?}"
                );
            }
            Ok(report) => {
                let is_traced = (found / traced.rate - 1.0).abs() < 1e-6
                    && traced.folds.iter().all(|fold| fold.jump <= PASSED);
                if is_traced {
                    continue;
                }
                let end = simulation.snapshot().contact(0).state(0);
                let slipped = dt * found / SLIP_DISTANCE;
                let is_near = (found / rate).ln().abs() <= NEAR.ln()
                    && (slipped <= 1.0 || (end - state).abs() <= NEAR.ln());
                prop_assert!(
                    !traced.folds.is_empty()
                        && (is_near || block.solutions(&friction, dt).map_err(text)? == 1),
                    "{report:?}, {traced:?}: {found:e}"
                );
            }
        }
    }
    Ok(())
}

/// What random cases have found: rates near the last one behind a fold and much slip; folds that were passed.
#[test]
fn folds_are_seen_where_the_state_forgets() -> Result<(), TestCaseError> {
    let rates = [-3.1336830723015088, 0.0];
    let ages = [1.3710595172430626, 3.103768978541943];
    check([88003695.87153518, 1.0], rates, ages, -0.17470701270969713)?;
    let rates = [-3.9362757307168543, -0.10016526987615981];
    let ages = [1.0396653789804136, 3.8973818206957676];
    check([881347789.679539, 1.0], rates, ages, -0.5529096764876406)?;
    let rates = [-1.4921860371743, 0.2277383469432239];
    let ages = [2.2641429962385002, 3.7744663198507715];
    check([1e5, 1.0], rates, ages, 0.0)?;
    let rates = [-2.8279797431832505, -0.3681351171698057];
    let ages = [0.607476790390358, 2.936857782183566];
    check([1e5, 4.030298779815629], rates, ages, 0.0)?;
    // The solution ends and another one begins 7 percent of the step size later, at the same rate.
    let rates = [-3.0958682795267425, -0.1750452938757183];
    let ages = [0.3901512450224161, 3.4071481128363037];
    check([465235482.1393264, 1.0], rates, ages, -1.6120353313222713)
}

proptest! {
    // 256 cases take a second.
    #![proptest_config(ProptestConfig::default())]

    #[test]
    fn the_solution_is_the_one_that_continues_the_last_step(
        (stiffness, mass) in (1e5..1e9_f64, 1.0..7.0_f64),
        (rate, excess) in (-9.0..-1.0_f64, -0.5..0.5_f64),
        (age, ratio) in (-3.0..6.0_f64, 1.0..4.0_f64),
        dt in -5.0..0.0_f64,
    ) {
        check([stiffness, mass], [rate, excess], [age, ratio], dt)?;
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

//! A block on a stiff spring after a velocity step.

use stickslip::friction::{DieterichRuina, FrictionLaw};
use stickslip::problems::spring_slider::{AGING, FRICTION, LoadPath, SpringScene, SpringSlider};
use stickslip::state::{Reads, StateLaw};
use stickslip::{
    Monolithic, Newmark, Point, RungeKutta, SceneError, Simulation, Snapshot, StateUpdate, Steps,
};

use super::{OF_OWN_STATE, OWN_FRICTION, OWN_STATE};
use crate::Outcome;

/// The slip rates before and after the velocity step [m/s].
const RATES: [f64; 2] = [1e-6, 1e-5];

/// The coefficient of friction in a velocity step.
#[derive(Debug, Clone, Copy)]
struct VelocityStep {
    /// Before, in steady sliding.
    before: f64,
    /// The largest, just after.
    peak: f64,
    /// One second, a slip of about L, after.
    evolving: f64,
    /// After 100 s, in steady sliding again.
    steady: f64,
}

/// The coefficient of friction of steady sliding after the velocity step,
/// `mu0 + (a - b) ln(V/V0)`.
fn steady_coefficient(law: &DieterichRuina) -> f64 {
    law.reference_friction + (law.a - law.b) * (RATES[1] / law.reference_velocity).ln()
}

/// A block that slides steadily at the first rate and is pulled at the second.
fn spring<L, S>(friction: L, law: S) -> Result<SpringScene, SceneError>
where
    L: FrictionLaw + 'static,
    S: StateLaw + 'static,
    L::State: Reads<S::State>,
{
    let slider = SpringSlider {
        stiffness: 1e10,
        normal_stress: 1e6,
        mass: 0.0,
        damping: 5e6,
        load: LoadPath::steady(RATES[1]),
    };
    slider.steady(friction, law, RATES[0])
}

/// The velocity step with local errors of `tolerance`.
fn velocity_step<L, S>(friction: L, law: S, tolerance: f64) -> Outcome<VelocityStep>
where
    L: FrictionLaw + 'static,
    S: StateLaw + 'static,
    L::State: Reads<S::State>,
{
    let mut block = RungeKutta::new(spring(friction, law)?)?;
    let coefficient = |at: Snapshot<'_, 1>| at.contact(0).coefficient(0);
    let before = coefficient(block.snapshot());
    let mut peak = before;
    let mut slide_until = |time| -> Outcome<f64> {
        let steps = Steps::adaptive(tolerance).until(time);
        block.run(&steps, |at| peak = peak.max(coefficient(at)))?;
        Ok(coefficient(block.snapshot()))
    };
    let (evolving, steady) = (slide_until(1.0)?, slide_until(100.0)?);
    Ok(VelocityStep {
        before,
        peak,
        evolving,
        steady,
    })
}

/// The coefficients at the start, the end and the peak of the velocity step: at most `mu + a ln 10` at the old state.
fn check_velocity_step(step: VelocityStep) {
    let exact = steady_coefficient(&FRICTION);
    assert!((step.before - 0.6).abs() < 1e-12, "{step:?}");
    assert!((step.steady - exact).abs() < 1e-8, "{step:?}, {exact}");
    assert!(
        step.peak > 0.605 && step.peak < 0.6 + FRICTION.a * 10f64.ln(),
        "{step:?}"
    );
}

#[test]
fn a_velocity_step_ends_where_steady_friction_says() -> Outcome {
    let known = velocity_step(FRICTION, AGING, 1e-8)?;
    let own_state = velocity_step(OF_OWN_STATE, OWN_STATE, 1e-8)?;
    let own_friction = velocity_step(OWN_FRICTION, AGING, 1e-8)?;
    for step in [known, own_state, own_friction] {
        check_velocity_step(step);
    }
    // Another way there by the state law, the same by the friction law.
    let other = own_state.peak - known.peak;
    assert!(other < -1e-3, "{own_state:?}, {known:?}");
    for difference in [
        own_friction.peak - known.peak,
        own_friction.evolving - known.evolving,
    ] {
        assert!(difference.abs() < 1e-10, "{difference:e}");
    }
    Ok(())
}

/// Displacement, logarithm of the slip rate and state of the velocity step after one second.
type End = [f64; 3];

fn end(at: Snapshot<'_, 1>) -> End {
    assert_eq!(at.time, 1.0);
    [
        1e5 * at.displacement[0][0],
        at.contact(0).slip_rate(0).ln(),
        at.contact(0).state(0),
    ]
}

fn distance(a: &End, b: &End) -> f64 {
    a.iter()
        .zip(b)
        .map(|(a, b)| (a - b).abs())
        .fold(0.0, f64::max)
}

/// Both ways to integrate a spring slider, the differential equation by an explicit method and the
/// implicit simulation with the state eliminated, go to the same limit, each with its order.
fn check_integrators<L, S>(friction: L, law: S, explicit_steps: [usize; 2]) -> Outcome
where
    L: FrictionLaw + Clone + 'static,
    S: StateLaw + Clone + 'static,
    L::State: Reads<S::State>,
{
    let mut block = RungeKutta::new(spring(friction.clone(), law.clone())?)?;
    block.run(&Steps::adaptive(1e-12).until(1.0), |_| ())?;
    let limit = end(block.snapshot());

    let mut implicit = Vec::new();
    for steps in [400, 800, 1600] {
        let scene = spring(friction.clone(), law.clone())?;
        let mut block = Simulation::new(scene, Newmark::default(), Point)?
            .with_coupling(Monolithic::without_fallback())
            .with_state_update(StateUpdate::Midpoint)
            .with_absolute_tolerance(1e-14)?;
        block.run(&Steps::constant(1.0 / steps as f64).count(steps), |_| ())?;
        implicit.push(distance(&end(block.snapshot()), &limit));
    }
    let mut explicit = Vec::new();
    for steps in explicit_steps {
        let mut block = RungeKutta::new(spring(friction.clone(), law.clone())?)?;
        block.run(&Steps::constant(1.0 / steps as f64).count(steps), |_| ())?;
        explicit.push(distance(&end(block.snapshot()), &limit));
    }
    let order = |pair: &[f64]| (pair[0] / pair[1]).log2();
    assert!(
        implicit
            .windows(2)
            .all(|pair| (order(pair) - 2.0).abs() < 0.1),
        "{implicit:?}"
    );
    // Transients die out and take errors with them: order 5, or better.
    assert!(order(&explicit) > 4.8, "{explicit:?}");
    assert!(
        implicit[2] < 1e-5 && explicit[1] < 1e-8,
        "{implicit:?}, {explicit:?}"
    );
    Ok(())
}

#[test]
fn explicit_and_implicit_integration_meet_by_the_own_state_law() -> Outcome {
    check_integrators(OF_OWN_STATE, OWN_STATE, [160, 320])
}

#[test]
fn explicit_and_implicit_integration_meet_by_the_own_friction_law() -> Outcome {
    check_integrators(OWN_FRICTION, AGING, [20, 40])
}

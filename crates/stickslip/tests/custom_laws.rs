//! Laws of one's own, those of the examples: their contracts, and what is known of them in a spring
//! slider and in the 2D slider.
#![cfg(all(feature = "fem", feature = "tnnmg", feature = "condensed"))]

#[path = "../../../examples/custom_state_law/law.rs"]
mod perrin_rice_zheng;
#[path = "../../../examples/common/own_law/runs.rs"]
mod runs;
#[path = "../../../examples/custom_friction_law/law.rs"]
mod soft_cutoff;

use std::error::Error;
use std::f64::consts::LN_2;

use stickslip::friction::{
    DieterichRuina, FrictionLaw, Radial, check_convex_potential, check_friction_law,
};
use stickslip::problems::{AGING, END, FRICTION, INITIAL_LOG_THETA, NORMAL_STRESS, steady_state};
use stickslip::state::{LogTheta, StateLaw, Theta, check_state_law};
use stickslip::{
    Adaptive, FixedPoint, Monolithic, Newmark, Point, RungeKutta, Simulation, StateUpdate, Stepper,
};

use perrin_rice_zheng::PerrinRiceZheng;
use runs::{Sliding, VelocityStep, slide, spring, steady_coefficient, velocity_step};
use soft_cutoff::SoftCutoff;

type Outcome = Result<(), Box<dyn Error>>;

const OWN_STATE: PerrinRiceZheng = PerrinRiceZheng {
    slip_distance: AGING.slip_distance,
};
/// Friction that compares contacts with `2L/V0`, the age of steady ones by the law above.
const OF_OWN_STATE: DieterichRuina = DieterichRuina {
    slip_distance: 2.0 * AGING.slip_distance,
    ..FRICTION
};
const OWN_FRICTION: SoftCutoff = SoftCutoff(FRICTION);
const ALPHA: LogTheta = LogTheta(INITIAL_LOG_THETA);
/// `2 exp(ALPHA)`: the same initial friction.
const THETA: Theta = Theta(2.0 * 4.539_992_976_248_485e-5);

#[test]
fn the_state_law_keeps_its_contract() -> Outcome {
    check_state_law(&OWN_STATE, &[1e-12, 1e-5, 1.0, 1e3, 1e9].map(Theta))?;
    let Theta(steady) = steady_state(&OWN_STATE, 1e-6)?;
    assert!((steady / 20.0 - 1.0).abs() < 1e-12);
    Ok(())
}

/// `theta = (2L/V) tanh(V t/2L + artanh(V theta_o/2L))` at constant slip rate, by the law's own
/// solver: of second order.
#[test]
fn the_state_follows_its_closed_form_to_second_order() -> Outcome {
    let (rate, time) = (1e-5, 2.0);
    let steady = 2.0 * OWN_STATE.slip_distance / rate;
    let exact = steady * (time / steady + 0.25_f64.atanh()).tanh();
    let mut errors = Vec::new();
    for steps in [16, 32, 64] {
        let mut state = Theta(0.25 * steady);
        for _ in 0..steps {
            state = OWN_STATE.advance_at_constant_rate(state, rate, time / f64::from(steps))?;
        }
        errors.push((state.0 - exact).abs());
    }
    for pair in errors.windows(2) {
        assert!(((pair[0] / pair[1]).log2() - 2.0).abs() < 0.1, "{errors:?}");
    }
    assert!(errors[2] < 1e-4 * steady, "{errors:?}");
    Ok(())
}

#[test]
fn the_friction_law_keeps_its_contract() -> Outcome {
    for alpha in [-300.0, -50.0, -10.0, 2.0, 30.0, 300.0, 700.0] {
        check_friction_law(&OWN_FRICTION, &[LogTheta(alpha)])?;
    }
    let at_vertex = Radial {
        law: OWN_FRICTION,
        force: 100.0,
        state: ALPHA,
    };
    check_convex_potential::<_, 1>(&at_vertex, 1e-6, 60.0)?;
    check_convex_potential::<_, 3>(&at_vertex, 1e-6, 60.0)?;
    assert!(
        check_friction_law(&SoftCutoff(DieterichRuina { a: 0.0, ..FRICTION }), &[ALPHA]).is_err()
    );
    Ok(())
}

/// Above the law with the hard cut-off by `a ln(1 + Vm/V)`: `a ln 2` at `Vm`, nothing far beyond.
#[test]
fn the_soft_cutoff_differs_where_it_says() {
    // Vm = 1e-6 exp(-1.5) m/s.
    let young = LogTheta(10f64.ln() - 39.0);
    let cutoff = FRICTION.ln_cutoff_rate(young).exp();
    assert!(((cutoff * 1e6).ln() + 1.5).abs() < 1e-12);
    for ratio in [1.0, 10.0, 1e3, 1e6] {
        let rate = ratio * cutoff;
        let more = OWN_FRICTION.coefficient(rate, young) - FRICTION.coefficient(rate, young);
        assert!(
            (more - FRICTION.a * ratio.recip().ln_1p()).abs() < 1e-15,
            "{ratio}: {more}"
        );
    }
    for rate in [1e-9, 1e-6, 1e-3] {
        let steady = LogTheta((FRICTION.slip_distance / rate).ln());
        let more = OWN_FRICTION.coefficient(rate, steady) - FRICTION.coefficient(rate, steady);
        assert!(more.abs() < 4.0 * f64::EPSILON, "{rate}: {more}");
    }
}

/// Where the velocity step must begin and end, and peak: at most `mu + a ln 10` at the old state.
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

fn end(stepper: &dyn Stepper<1>) -> End {
    let at = stepper.snapshot();
    assert_eq!(at.time, 1.0);
    [
        1e5 * at.displacement[0][0],
        at.slip_rate(0).ln(),
        at.states.state(0),
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
    L::State: From<S::State>,
{
    let mut block = RungeKutta::new(spring(friction.clone(), law.clone())?)?;
    Adaptive::new(1e-12).run(&mut block, 1.0, &mut |_| ())?;
    let limit = end(&block);

    let mut implicit = Vec::new();
    for steps in [400, 800, 1600] {
        let scene = spring(friction.clone(), law.clone())?;
        let mut block = Simulation::new(scene, Newmark::default(), Point)?
            .with_coupling(Monolithic::without_fallback())
            .with_state_update(StateUpdate::Midpoint)
            .with_tolerance(1e-14)?;
        block.run(steps, 1.0 / steps as f64, &mut |_| ())?;
        implicit.push(distance(&end(&block), &limit));
    }
    let mut explicit = Vec::new();
    for steps in explicit_steps {
        let mut block = RungeKutta::new(spring(friction.clone(), law.clone())?)?;
        block.run(steps, 1.0 / steps as f64, &mut |_| ())?;
        explicit.push(distance(&end(&block), &limit));
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

fn first_slip(sliding: &Sliding) -> Result<f64, &'static str> {
    sliding.first_slip_time.ok_or("no slip")
}

const STEPS: usize = 10_000;

/// At rest contacts are as old by both state laws, but half as old in units of steady ones, so that
/// friction is `b ln 2` smaller when it gives way; and at rates above `2L/theta` the own law weakens
/// faster: it may save the slider the `a ln(V theta/2L)` up to the rate that counts as slip. The load
/// grows by some `G V/h`.
#[test]
fn the_slider_gives_way_earlier_by_the_own_state_law() -> Outcome {
    let known = slide(2, STEPS, (FRICTION, AGING, ALPHA), Monolithic::default())?;
    let own = slide(
        2,
        STEPS,
        (OF_OWN_STATE, OWN_STATE, THETA),
        Monolithic::default(),
    )?;
    let loading = 5e7 / 2.6 * 2e-4 / NORMAL_STRESS; // of the coefficient [1/s]
    let least = FRICTION.b * LN_2 / loading;
    let age = first_slip(&known)?;
    let spared = FRICTION.a * (1e-4 * age / OF_OWN_STATE.slip_distance).ln() / loading;
    let earlier = age - first_slip(&own)?;
    assert!(
        earlier > least && earlier < least + spared,
        "{least} < {earlier} < {least} + {spared}"
    );
    Ok(())
}

#[test]
fn the_slider_cannot_tell_a_soft_cutoff() -> Outcome {
    let known = slide(2, STEPS, (FRICTION, AGING, ALPHA), Monolithic::default())?;
    let own = slide(
        2,
        STEPS,
        (OWN_FRICTION, AGING, ALPHA),
        Monolithic::default(),
    )?;
    let difference = (first_slip(&known)? - first_slip(&own)?).abs();
    assert!(difference < 1e-12 * END, "{difference:e}");
    Ok(())
}

/// The same body by the same laws, rate and state at once and in turns.
fn couplings<L, S>(friction: L, law: S, initial: S::State) -> Result<[Sliding; 2], Box<dyn Error>>
where
    L: FrictionLaw + Clone + 'static,
    S: StateLaw + Clone + 'static,
    L::State: From<S::State>,
{
    let laws = (friction.clone(), law.clone(), initial);
    let at_once = slide(1, STEPS, laws, Monolithic::default())?;
    let in_turns = slide(1, STEPS, (friction, law, initial), FixedPoint::default())?;
    assert_eq!(at_once.fallbacks, 0);
    let difference = first_slip(&at_once)? - first_slip(&in_turns)?;
    assert!(difference.abs() < 1e-9, "{difference:e}");
    Ok([at_once, in_turns])
}

/// Until it slips; beyond, a step of this law in `theta` may have more than one solution.
#[test]
fn the_couplings_agree_by_the_own_state_law() -> Outcome {
    couplings(OF_OWN_STATE, OWN_STATE, THETA)?;
    Ok(())
}

#[test]
fn the_couplings_agree_through_an_event_by_the_own_friction_law() -> Outcome {
    check_event(couplings(OWN_FRICTION, AGING, ALPHA)?);
    Ok(())
}

fn check_event([at_once, in_turns]: [Sliding; 2]) {
    let slipped = at_once.peak_slip_rate > 1e-2;
    assert!(slipped, "{at_once:?}");
    for (a, b) in [
        (at_once.displacement_end, in_turns.displacement_end),
        (at_once.peak_slip_rate, in_turns.peak_slip_rate),
    ] {
        assert!((a / b - 1.0).abs() < 1e-8, "{at_once:?}, {in_turns:?}");
    }
}

/// The own state law in another variable: `alpha' = exp(-alpha) - (V/2L)^2 exp(alpha)`.
#[derive(Debug, Clone, Copy)]
struct InLogarithm(PerrinRiceZheng);

impl StateLaw for InLogarithm {
    type State = LogTheta;

    fn evolution(&self, LogTheta(alpha): LogTheta, slip_rate: f64) -> f64 {
        let rate = slip_rate / (2.0 * self.0.slip_distance);
        (-alpha).exp() - rate * rate * alpha.exp()
    }

    fn evolution_slope(&self, LogTheta(alpha): LogTheta, slip_rate: f64) -> f64 {
        let rate = slip_rate / (2.0 * self.0.slip_distance);
        -(-alpha).exp() - rate * rate * alpha.exp()
    }
}

#[test]
fn the_couplings_agree_through_an_event_in_the_logarithm() -> Outcome {
    let law = InLogarithm(OWN_STATE);
    check_state_law(&law, &[-20.0, -10.0, 0.0, 3.0].map(LogTheta))?;
    let [at_once, in_turns] = couplings(OF_OWN_STATE, law, THETA.into())?;
    check_event([at_once, in_turns]);
    let in_theta = slide(
        1,
        STEPS,
        (OF_OWN_STATE, OWN_STATE, THETA),
        Monolithic::default(),
    )?;
    let difference = first_slip(&at_once)? - first_slip(&in_theta)?;
    assert!(difference.abs() < 1e-4, "{difference:e}");
    Ok(())
}

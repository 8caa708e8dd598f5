//! Second order in time: the state at the midpoint rate, and a method of two stages; against
//! explicit integrations, the exact solution of the layer, and the extrapolated slider.
#![cfg(all(feature = "fem", feature = "tnnmg", feature = "condensed"))]

mod common;

use nalgebra::{SMatrix, Vector1};
use stickslip::friction::FrictionLaw;
use stickslip::problems::{
    AGING, END, FRICTION, INITIAL_LOG_THETA, Layer, LoadPath, NORMAL_STRESS, SpringSlider,
    steady_state,
};
use stickslip::state::{LogTheta, Ruina, StateLaw};
use stickslip::{
    Adaptive, BackwardEuler, Condensed, Events, GeneralizedAlpha, Monolithic, Newmark, Point,
    RateScheme, RungeKutta, Scene, Sdirk2, Simulation, StateUpdate, Stepper,
};

use common::{Outcome, Solver, body, centre, slide};

const RUINA: Ruina = Ruina {
    slip_distance: 1e-5,
};

/// A law of which only the right-hand side is known.
#[derive(Debug, Clone, Copy)]
struct Hidden<S>(S);

impl<S: StateLaw> StateLaw for Hidden<S> {
    type State = S::State;

    fn evolution(&self, state: S::State, slip_rate: f64) -> f64 {
        self.0.evolution(state, slip_rate)
    }

    fn evolution_slope(&self, state: S::State, slip_rate: f64) -> f64 {
        self.0.evolution_slope(state, slip_rate)
    }
}

/// Slip rate (by its logarithm), state and displacement.
type Motion = [f64; 3];

fn motion(stepper: &dyn Stepper<1>) -> Motion {
    let at = stepper.snapshot();
    [
        at.velocity[0][0].ln(),
        at.states.state(0),
        at.displacement[0][0] / 1e-5,
    ]
}

/// The largest difference, of the slip rate and state relative, of the displacement in units of `L`.
fn apart(a: Motion, b: Motion) -> f64 {
    a.iter()
        .zip(b)
        .map(|(a, b)| (a - b).abs())
        .fold(0.0, f64::max)
}

/// A slider that was disturbed and whose load point moves ever faster.
fn disturbed(mass: f64) -> SpringSlider {
    SpringSlider {
        stiffness: 2e9,
        normal_stress: 1e6,
        mass,
        damping: 5e6,
        load: LoadPath::steady(1e-6).ramp(0.0, 20.0, 5e-6),
    }
}

const UNTIL: f64 = 8.0;

/// The ratios of the errors against `exact` for steps that are halved twice from `UNTIL/steps`.
fn ratios<S, R>(
    law: &S,
    scheme: R,
    state_update: StateUpdate,
    steps: usize,
    exact: Motion,
) -> Result<[f64; 2], Box<dyn std::error::Error>>
where
    S: StateLaw<State = LogTheta> + Clone + 'static,
    R: RateScheme + Clone + 'static,
{
    let error = |steps: usize| -> Result<f64, Box<dyn std::error::Error>> {
        let scene = disturbed(0.0).scene(FRICTION, law.clone(), 3e-6, steady_state(law, 1e-6)?)?;
        let mut block =
            Simulation::new(scene, scheme.clone(), Point)?.with_state_update(state_update);
        block.run(steps, UNTIL / steps as f64, &mut |_| ())?;
        Ok(apart(motion(&block), exact))
    };
    let errors = [error(steps)?, error(2 * steps)?, error(4 * steps)?];
    assert!(errors[0] < 0.1, "{errors:?}");
    Ok([errors[0] / errors[1], errors[1] / errors[2]])
}

fn explicit<S>(law: &S) -> Result<Motion, Box<dyn std::error::Error>>
where
    S: StateLaw<State = LogTheta> + Clone,
{
    let scene = disturbed(0.0).scene(FRICTION, law.clone(), 3e-6, steady_state(law, 1e-6)?)?;
    let mut block = RungeKutta::new(scene)?;
    Adaptive::new(1e-12).run(&mut block, UNTIL, &mut |_| ())?;
    Ok(motion(&block))
}

fn has_second_order<S>(law: S) -> Outcome
where
    S: StateLaw<State = LogTheta> + Clone + 'static,
{
    let exact = explicit(&law)?;
    for ratio in ratios(&law, Newmark::default(), StateUpdate::Midpoint, 400, exact)? {
        assert!((3.8..4.2).contains(&ratio), "{ratio}");
    }
    // The method of two stages has its own way with the state.
    for ratio in ratios(&law, Sdirk2, StateUpdate::BackwardEuler, 400, exact)? {
        assert!((3.8..4.2).contains(&ratio), "{ratio}");
    }
    Ok(())
}

#[test]
fn the_midpoint_state_has_second_order() -> Outcome {
    has_second_order(AGING)?;
    has_second_order(RUINA)
}

/// Without a closed form the state takes an L-stable rule of second order.
#[test]
fn laws_without_a_closed_form_have_second_order() -> Outcome {
    has_second_order(Hidden(AGING))?;
    has_second_order(Hidden(RUINA))
}

/// Whatever the scheme for the displacement.
#[test]
fn the_backward_euler_state_has_first_order() -> Outcome {
    let exact = explicit(&AGING)?;
    for ratio in ratios(
        &AGING,
        Newmark::default(),
        StateUpdate::BackwardEuler,
        1600,
        exact,
    )? {
        assert!((1.9..2.1).contains(&ratio), "{ratio}");
    }
    for ratio in ratios(&AGING, BackwardEuler, StateUpdate::Midpoint, 1600, exact)? {
        assert!((1.9..2.1).contains(&ratio), "{ratio}");
    }
    Ok(())
}

/// A slider with inertia by the classical Runge-Kutta method of fourth order, from the laws alone.
fn inertial_oracle(slider: &SpringSlider, rate: f64, start: LogTheta) -> Motion {
    let traction = |v: f64, alpha: f64| {
        slider.normal_stress * FRICTION.coefficient(v, LogTheta(alpha)) + slider.damping * v
    };
    let slope = |time: f64, [u, v, alpha]: Motion| {
        let pull = slider.stiffness * (slider.load.position(time) - u);
        [
            v,
            (pull - traction(v, alpha)) / slider.mass,
            AGING.evolution(LogTheta(alpha), v),
        ]
    };
    let along =
        |x: Motion, k: Motion, h: f64| -> Motion { std::array::from_fn(|i| x[i] + h * k[i]) };
    let mut x = [-traction(rate, start.0) / slider.stiffness, rate, start.0];
    let steps = 400_000_u32;
    let h = UNTIL / f64::from(steps);
    for n in 0..steps {
        let time = f64::from(n) * h;
        let k1 = slope(time, x);
        let k2 = slope(time + 0.5 * h, along(x, k1, 0.5 * h));
        let k3 = slope(time + 0.5 * h, along(x, k2, 0.5 * h));
        let k4 = slope(time + h, along(x, k3, h));
        let mean = std::array::from_fn(|i| (k1[i] + 2.0 * (k2[i] + k3[i]) + k4[i]) / 6.0);
        x = along(x, mean, h);
    }
    [x[1].ln(), x[2], x[0] / 1e-5]
}

/// Inertia on the time scale of the state: without friction the frequency is 4.5 /s.
#[test]
fn methods_have_second_order_with_inertia() -> Outcome {
    let slider = disturbed(1e8);
    let (rate, start) = (3e-6, steady_state(&AGING, 3e-6)?);
    let exact = inertial_oracle(&slider, rate, start);
    let error = |scheme: Box<dyn RateScheme>, steps: usize| {
        let scene = slider.scene(FRICTION, AGING, rate, start)?;
        let mut block = Simulation::new(scene, scheme, Point)?;
        assert_eq!(block.order(), 2);
        block.run(steps, UNTIL / steps as f64, &mut |_| ())?;
        Ok::<_, Box<dyn std::error::Error>>(apart(motion(&block), exact))
    };
    let schemes: [fn() -> Box<dyn RateScheme>; 4] = [
        || Box::new(Newmark::default()),
        || Box::new(Sdirk2),
        || {
            Box::new(GeneralizedAlpha {
                spectral_radius: 0.8,
            })
        },
        || {
            Box::new(GeneralizedAlpha {
                spectral_radius: 0.0,
            })
        },
    ];
    for scheme in schemes {
        let errors = [
            error(scheme(), 1000)?,
            error(scheme(), 2000)?,
            error(scheme(), 4000)?,
        ];
        assert!(errors[0] < 0.02, "{errors:?}");
        for pair in errors.windows(2) {
            assert!((3.8..4.2).contains(&(pair[0] / pair[1])), "{errors:?}");
        }
    }
    Ok(())
}

/// A spring of which a step sees nothing: `R(z)` tends to zero like `(1 - 2 g)/(g^2 z)`, so that five
/// steps leave nothing. Newmark's scheme keeps its energy for ever.
#[test]
fn a_mode_that_is_not_resolved_dies_within_a_few_steps() -> Outcome {
    let frequency: f64 = 1e6;
    let run = |scheme: Box<dyn RateScheme>| -> Result<f64, Box<dyn std::error::Error>> {
        let stiffness = SMatrix::<f64, 1, 1>::new(frequency * frequency);
        let scene = Scene::new(stiffness)
            .with_mass(SMatrix::<f64, 1, 1>::new(1.0))
            .with_displacement(vec![Vector1::new(1.0)])
            .with_acceleration(vec![Vector1::new(-frequency * frequency)]);
        let mut spring = Simulation::new(scene, scheme, Point)?;
        spring.run(5, 1.0, &mut |_| ())?;
        let at = spring.snapshot();
        Ok(at.displacement[0][0].hypot(at.velocity[0][0] / frequency))
    };
    let share = 1.0 - std::f64::consts::FRAC_1_SQRT_2;
    // One step, at infinite frequency, to leading order.
    let factor = (1.0 - 2.0 * share) / (share * share * frequency);
    let left = run(Box::new(Sdirk2))?;
    assert!((left / factor.powi(5) - 1.0).abs() < 1e-3, "{left:e}");
    // A threefold eigenvalue of zero: gone after three steps.
    let gone = run(Box::new(GeneralizedAlpha {
        spectral_radius: 0.0,
    }))?;
    assert!(gone < 1e-9, "{gone:e}");
    let kept = run(Box::new(Newmark::AVERAGE_ACCELERATION))?;
    assert!((kept - 1.0).abs() < 1e-9, "{kept}");
    Ok(())
}

/// The first time of 1e-3 m/s at the base of the layer, `END/steps` a step.
fn layer_slips(steps: usize) -> Result<f64, Box<dyn std::error::Error>> {
    let layer = Layer::default();
    let space = layer.space()?;
    let base = Layer::base(&space)?;
    let scene = layer
        .scene(&space)?
        .with_friction(&base, FRICTION, NORMAL_STRESS)
        .with_state(AGING, LogTheta(INITIAL_LOG_THETA));
    let mut layer = Simulation::new(scene, Newmark::default(), Condensed::new())?;
    let vertex = base.vertices()[0];
    let mut events = Events::new(1e-3, 2e-4);
    let dt = END / steps as f64;
    while events.times().is_empty() {
        assert!(!layer.step(dt)?.fell_back);
        let at = layer.snapshot();
        assert!(at.time < 10.2, "no event");
        events.record(at.time, at.velocity[vertex][0]);
    }
    Ok(events.times()[0])
}

/// The exact time is 10.06626 s. Measured with another code: -4.2e-5 s at `N = 1e4`, -5.4e-6 at 3e4.
#[test]
fn the_layer_slips_on_time() -> Outcome {
    let mut exact = Events::new(1e-3, 2e-4);
    let initial = LogTheta(INITIAL_LOG_THETA);
    Layer::default().exact(&FRICTION, &AGING, initial, 1600, |at| {
        exact.record(at.time, at.slip_rate);
    })?;
    let exact = exact.times()[0];
    assert!((exact - 10.06626).abs() < 1e-5, "{exact}");
    let times = [
        layer_slips(10_000)?,
        layer_slips(20_000)?,
        layer_slips(40_000)?,
    ];
    let errors = times.map(|time| time - exact);
    assert!(errors[0].abs() <= 1e-4, "{errors:?}");
    // Free of the error in space, which is the same for all.
    let ratio = (times[1] - times[0]) / (times[2] - times[1]);
    assert!((3.5..4.5).contains(&ratio), "{times:?}, {ratio}");
    // What is left of the error is that of the mesh.
    let limit = times[2] + (times[2] - times[1]) / 3.0;
    assert!((limit - exact).abs() < 1e-5, "{limit}, {exact}");
    Ok(())
}

/// The first time of 1e-4 m/s at the middle of the elastic slider with four refinements.
fn slider_slips(
    steps: usize,
    state_update: StateUpdate,
) -> Result<f64, Box<dyn std::error::Error>> {
    let body = body(4);
    let space = body.space()?;
    let laws = (FRICTION, AGING, LogTheta(INITIAL_LOG_THETA));
    let scheme = Newmark::default();
    let mut slider = slide(&body, &space, laws, scheme, Solver::Condensed, 1e-10)?
        .with_coupling(Monolithic::default())
        .with_state_update(state_update);
    let x0 = centre(&space)?;
    let mut slips = Events::new(1e-4, 1e-4);
    let dt = END / steps as f64;
    while slips.times().is_empty() {
        slider.step(dt)?;
        let at = slider.snapshot();
        assert!(at.time < 10.2, "no event");
        slips.record(at.time, at.velocity[x0][0]);
    }
    Ok(slips.times()[0])
}

/// 10.010765 s is what the first-order results extrapolate to, which are themselves those of an
/// independent code: 10.009699 s at `N = 1e4`.
#[test]
fn the_slider_slips_on_time() -> Outcome {
    let coarse = slider_slips(10_000, StateUpdate::BackwardEuler)?;
    assert!((coarse - 10.009699449).abs() < 1e-6, "{coarse}");
    let fine = slider_slips(20_000, StateUpdate::BackwardEuler)?;
    let extrapolated = 2.0 * fine - coarse;
    let midpoint = slider_slips(10_000, StateUpdate::Midpoint)?;
    assert!((midpoint - 10.010765).abs() < 2e-5, "{midpoint}");
    assert!(
        (midpoint - extrapolated).abs() < 2e-5,
        "{midpoint}, {extrapolated}"
    );
    Ok(())
}

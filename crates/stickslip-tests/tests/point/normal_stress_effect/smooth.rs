//! A block that slides under a swinging normal stress, against the differential equation integrated here.

use std::f64::consts::TAU;

use nalgebra::{SMatrix, SVector};
use stickslip::friction::FrictionLaw;
use stickslip::problems::spring_slider::{AGING, FRICTION};
use stickslip::state::{LogScale, LogTheta, Reads, StateLaw, Theta};
use stickslip::{
    FixedPoint, Monolithic, Newmark, Point, RateScheme, RungeKutta, Scene, Sdirk2, Simulation,
    StateUpdate, StepState, Steps,
};

use super::{Aging, KAPPA, SLIP_DISTANCE, Spring, contact};
use crate::Outcome;

const STIFFNESS: f64 = 2e9;
const DAMPING: f64 = 5e9;
const LOAD_RATE: f64 = 1e-6;
const START: f64 = 2.0;
const END: f64 = 10.0;

fn normal_stress(time: f64) -> f64 {
    1e6 * (1.0 + 0.3 * (TAU * time / 8.0).sin())
}

/// `sigma'/sigma`.
fn relative_slope(time: f64) -> f64 {
    1e6 * 0.3 * TAU / 8.0 * (TAU * time / 8.0).cos() / normal_stress(time)
}

/// The force at the start in units of the stretch, at which the block slides at the load rate.
fn stretch() -> f64 {
    let coefficient = FRICTION.coefficient(LOAD_RATE, LogTheta(START));
    (normal_stress(0.0) * coefficient + DAMPING * LOAD_RATE) / STIFFNESS
}

/// The slip rate with `DAMPING V + sigma a ln(V/Vm) = drive`, by bisection of its logarithm.
fn slip_rate(time: f64, slip: f64, alpha: f64) -> f64 {
    let drive = STIFFNESS * (stretch() + LOAD_RATE * time - slip);
    let log_minimal = FRICTION.reference_velocity.ln()
        - (FRICTION.reference_friction
            + FRICTION.b * (alpha + (FRICTION.reference_velocity / SLIP_DISTANCE).ln()))
            / FRICTION.a;
    let left = |log_rate: f64| {
        DAMPING * log_rate.exp() + normal_stress(time) * FRICTION.a * (log_rate - log_minimal)
            - drive
    };
    let (mut low, mut high) = (log_minimal, 10.0);
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        if left(middle) > 0.0 {
            high = middle;
        } else {
            low = middle;
        }
    }
    (0.5 * (low + high)).exp()
}

/// `(u, alpha)` at the end, by the classical Runge-Kutta method.
fn oracle() -> [f64; 2] {
    const STEPS: usize = 20_000;
    let dt = END / STEPS as f64;
    let slope = |time: f64, [slip, alpha]: [f64; 2]| {
        let rate = slip_rate(time, slip, alpha);
        let healing = (-alpha).exp() - rate / SLIP_DISTANCE;
        [rate, healing - KAPPA * relative_slope(time)]
    };
    let add = |x: [f64; 2], d: [f64; 2], h: f64| [x[0] + h * d[0], x[1] + h * d[1]];
    (0..STEPS).fold([0.0, START], |x, step| {
        let time = step as f64 * dt;
        let k1 = slope(time, x);
        let k2 = slope(time + 0.5 * dt, add(x, k1, 0.5 * dt));
        let k3 = slope(time + 0.5 * dt, add(x, k2, 0.5 * dt));
        let k4 = slope(time + dt, add(x, k3, dt));
        let sum = |i: usize| (k1[i] + 2.0 * k2[i] + 2.0 * k3[i] + k4[i]) / 6.0;
        add(x, [sum(0), sum(1)], dt)
    })
}

fn scene<S: StateLaw + 'static>(law: S, initial: S::State, kappa: Option<f64>) -> Spring
where
    S::State: LogScale,
    LogTheta: Reads<S::State>,
{
    let pull = |time: f64| STIFFNESS * (stretch() + LOAD_RATE * time);
    Scene::new(SMatrix::<f64, 1, 1>::new(STIFFNESS))
        .with_viscosity(SMatrix::<f64, 1, 1>::new(DAMPING))
        .with_contact(contact(law, initial, normal_stress, kappa))
        .with_load_history(move |time, load| load[0][0] = pull(time))
        .with_velocity(vec![SVector::from([LOAD_RATE])])
}

/// The same in both variables, each with what makes `ln theta` of it.
fn in_variable(number: usize) -> (Spring, fn(f64) -> f64) {
    if number == 0 {
        (scene(AGING, LogTheta(START), Some(KAPPA)), |alpha| alpha)
    } else {
        (scene(Aging, Theta(START.exp()), Some(KAPPA)), f64::ln)
    }
}

/// The distance of displacement, in slip distances, and `ln theta` from the oracle.
fn error(state: &StepState<1>, logarithm: fn(f64) -> f64, [slip, alpha]: [f64; 2]) -> f64 {
    let slip = (state.displacement[0][0] - slip) / SLIP_DISTANCE;
    let alpha = logarithm(state.contacts[0].states[0]) - alpha;
    slip.abs().max(alpha.abs())
}

fn steps(count: usize) -> Steps {
    Steps::constant(END / count as f64).count(count)
}

type Method = (fn() -> Box<dyn RateScheme>, StateUpdate);
const NEWMARK: Method = (|| Box::new(Newmark::default()), StateUpdate::Midpoint);
const PAPER: Method = (|| Box::new(Newmark::default()), StateUpdate::BackwardEuler);
const SDIRK2: Method = (|| Box::new(Sdirk2), StateUpdate::Midpoint);

fn simulation(scene: Spring, (scheme, update): Method) -> Outcome<Simulation<1>> {
    Ok(Simulation::new(scene, scheme(), Point)?
        .with_state_update(update)
        .with_absolute_tolerance(1e-13)?)
}

#[test]
fn the_order_in_time_is_that_of_the_method() -> Outcome {
    let exact = oracle();
    for (method, order) in [(NEWMARK, 2.0), (SDIRK2, 2.0), (PAPER, 1.0)] {
        for variable in 0..2 {
            let at = |count: usize| -> Outcome<f64> {
                let (scene, logarithm) = in_variable(variable);
                let mut simulation = simulation(scene, method)?;
                simulation.run(&steps(count), |_| ())?;
                Ok(error(simulation.state(), logarithm, exact))
            };
            let [coarse, fine] = [at(400)?, at(800)?];
            let observed = (coarse / fine).log2();
            assert!(
                (observed - order).abs() < 0.1,
                "order {order}, variable {variable}: {observed}, {fine:e}"
            );
        }
    }
    Ok(())
}

/// A method of lower order leaves more than `2^-4.5` of the error when steps are halved.
#[test]
fn the_explicit_integration_keeps_its_order() -> Outcome {
    let exact = oracle();
    for variable in 0..2 {
        let at = |count: usize| -> Outcome<f64> {
            let (scene, logarithm) = in_variable(variable);
            let mut explicit = RungeKutta::new(scene)?;
            explicit.run(&steps(count), |_| ())?;
            let end = explicit.snapshot().state().clone();
            Ok(error(&end, logarithm, exact))
        };
        let [coarse, fine] = [at(80)?, at(160)?];
        let observed = (coarse / fine).log2();
        assert!(observed > 4.5, "variable {variable}: {observed}, {fine:e}");
    }
    Ok(())
}

/// The local error that adaptive steps ask for is kept.
#[test]
fn adaptive_steps_see_the_normal_stress() -> Outcome {
    let exact = oracle();
    for variable in 0..2 {
        let (scene, logarithm) = in_variable(variable);
        let mut explicit = RungeKutta::new(scene)?;
        let report = explicit.run(&Steps::adaptive(1e-8).until(END), |_| ())?;
        let (at, accepted) = (explicit.snapshot(), report.accepted as f64);
        assert!(error(at.state(), logarithm, exact) < 1e-8 * accepted);
        let (scene, logarithm) = in_variable(variable);
        let mut implicit = simulation(scene, NEWMARK)?;
        let report = implicit.run(&Steps::adaptive(1e-5).until(END), |_| ())?;
        let accepted = report.accepted as f64;
        assert!(error(implicit.state(), logarithm, exact) < 1e-5 * accepted);
    }
    Ok(())
}

/// A step is known to the tolerance of the velocity in the norm of the stiffness, and the system damps what a step
/// leaves: in all, a tolerance a step and coupling.
#[test]
fn couplings_agree_and_residuals_vanish() -> Outcome {
    const COUNT: usize = 200;
    const TOLERANCE: f64 = 1e-11;
    for method in [NEWMARK, SDIRK2, PAPER] {
        for variable in 0..2 {
            let both = || simulation(in_variable(variable).0, method);
            let mut eliminated = both()?
                .with_coupling(Monolithic::without_fallback())
                .with_absolute_tolerance(TOLERANCE)?;
            let mut iterated = both()?
                .with_coupling(FixedPoint::paper())
                .with_absolute_tolerance(TOLERANCE)?;
            for _ in 0..COUNT {
                let before = eliminated.state().clone();
                eliminated.step(END / COUNT as f64)?;
                iterated.step(END / COUNT as f64)?;
                let left = eliminated.residuals(&before);
                assert!(left.force < 1e-9 * left.force_terms, "{left:?}");
                assert!(left.state.is_nan() || left.state < 1e-13, "{left:?}");
            }
            let [a, b] = [eliminated.state(), iterated.state()];
            let difference = (a.velocity[0] - b.velocity[0]).norm() * STIFFNESS.sqrt();
            assert!(
                difference < 2.0 * TOLERANCE * COUNT as f64,
                "{difference:e}"
            );
        }
    }
    Ok(())
}

/// With an exponent of zero nothing is added and nothing multiplied but by 1.
#[test]
fn an_exponent_of_zero_leaves_every_bit() -> Outcome {
    for method in [NEWMARK, SDIRK2, PAPER] {
        for coupling in [false, true] {
            let end = |kappa: Option<f64>| -> Outcome<_> {
                let both = [
                    simulation(scene(AGING, LogTheta(START), kappa), method)?,
                    simulation(scene(Aging, Theta(START.exp()), kappa), method)?,
                ];
                let mut ends = Vec::new();
                for simulation in both {
                    let mut simulation = if coupling {
                        simulation.with_coupling(FixedPoint::paper())
                    } else {
                        simulation
                    };
                    simulation.run(&steps(50), |_| ())?;
                    ends.push(simulation.state().clone());
                }
                Ok(ends)
            };
            assert_eq!(end(Some(0.0))?, end(None)?);
        }
    }
    let explicit = |kappa| -> Outcome<_> {
        let mut explicit = RungeKutta::new(scene(AGING, LogTheta(START), kappa))?;
        explicit.run(&steps(50), |_| ())?;
        Ok(explicit.snapshot().state().clone())
    };
    assert_eq!(explicit(Some(0.0))?, explicit(None)?);
    Ok(())
}

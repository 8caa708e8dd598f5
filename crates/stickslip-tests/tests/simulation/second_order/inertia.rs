//! Sliders with inertia, and springs that a step does not resolve.

use nalgebra::{SMatrix, Vector1};
use stickslip::friction::FrictionLaw;
use stickslip::problems::spring_slider::{AGING, FRICTION, SpringSlider, steady_state};
use stickslip::state::{LogTheta, StateLaw};
use stickslip::{GeneralizedAlpha, Newmark, Point, RateScheme, Scene, Sdirk2, Simulation, Steps};

use super::{Motion, UNTIL, apart, disturbed, motion};
use crate::Outcome;

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
    let error = |scheme: Box<dyn RateScheme>, steps: usize| -> Outcome<f64> {
        let scene = slider.scene(FRICTION, AGING, rate, start)?;
        let mut block = Simulation::new(scene, scheme, Point)?;
        assert_eq!(block.order(), 2);
        block.run(&Steps::constant(UNTIL / steps as f64).count(steps), |_| ())?;
        Ok(apart(motion(block.snapshot()), exact))
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

/// A spring of which a step sees nothing: `R(z)` tends to zero like `(1 - 2 g)/(g^2 z)`, so that
/// five steps leave nothing. Newmark's scheme keeps its energy for ever.
#[test]
fn a_mode_that_is_not_resolved_dies_within_a_few_steps() -> Outcome {
    let frequency: f64 = 1e6;
    let run = |scheme: Box<dyn RateScheme>| -> Outcome<f64> {
        let stiffness = SMatrix::<f64, 1, 1>::new(frequency * frequency);
        let scene = Scene::new(stiffness)
            .with_mass(SMatrix::<f64, 1, 1>::new(1.0))
            .with_displacement(vec![Vector1::new(1.0)])
            .with_acceleration(vec![Vector1::new(-frequency * frequency)]);
        let mut spring = Simulation::new(scene, scheme, Point)?;
        spring.run(&Steps::constant(1.0).count(5), |_| ())?;
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

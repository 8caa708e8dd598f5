//! Refusals with their numbers; the simulation stays as it was.

use nalgebra::SMatrix;
use stickslip::integrate::Stepper;
use stickslip::problems::spring_slider::AGING;
use stickslip::state::LogTheta;
use stickslip::{
    Newmark, Point, RungeKutta, Scene, SceneError, Sdirk2, Simulation, StepError, Steps,
};

use super::{KAPPA, Spring, contact};
use crate::Outcome;

fn resting(history: impl Fn(f64) -> f64 + Send + Sync + 'static, kappa: f64) -> Spring {
    Scene::new(SMatrix::<f64, 1, 1>::new(1e9))
        .with_viscosity(SMatrix::<f64, 1, 1>::new(1e6))
        .with_contact(contact(AGING, LogTheta(2.0), history, Some(kappa)).allow_opening())
}

/// The normal stress vanishes at 2 s, or is zero until then.
#[test]
fn a_step_into_or_from_an_open_contact_fails_with_both_normal_stresses() -> Outcome {
    let closes = |time: f64| if time > 1.5 { 1e6 } else { 0.0 };
    let opens = |time: f64| if time > 1.5 { 0.0 } else { 1e6 };
    for (history, expected) in [
        (closes as fn(f64) -> f64, [0.0, 1e6]),
        (opens as fn(f64) -> f64, [1e6, 0.0]),
    ] {
        let mut steppers: [Box<dyn Stepper<1>>; 3] = [
            Box::new(Simulation::new(
                resting(history, KAPPA),
                Newmark::default(),
                Point,
            )?),
            Box::new(Simulation::new(resting(history, KAPPA), Sdirk2, Point)?),
            Box::new(RungeKutta::new(resting(history, KAPPA))?),
        ];
        for stepper in &mut steppers {
            // A normal stress that stays zero moves nothing.
            stepper.step(1.0)?;
            let before = stepper.snapshot().state().clone();
            let failure = stepper.step(1.0).err().ok_or("passed")?;
            let StepError::NormalStressEffect {
                vertex: 0,
                from,
                to,
            } = failure.cause
            else {
                return Err(failure.into());
            };
            assert_eq!([from, to], expected);
            assert_eq!(stepper.snapshot().state(), &before);
            stepper.step(0.25)?;
        }
        // Without an effect it is a step like others.
        Simulation::new(resting(history, 0.0), Newmark::default(), Point)?
            .run(&Steps::constant(1.0).count(3), |_| ())?;
    }
    Ok(())
}

#[test]
fn exponents_out_of_range_are_refused() -> Outcome {
    let built = |kappa| Simulation::new(resting(|_| 1e6, kappa), Newmark::default(), Point);
    for kappa in [-0.1, f64::NAN, f64::INFINITY] {
        let Some(SceneError::Value { what, value, .. }) = built(kappa).err() else {
            return Err(format!("{kappa} passed").into());
        };
        assert_eq!(
            (what, value.to_bits()),
            ("normal-stress effect", kappa.to_bits())
        );
    }
    let contact = contact(AGING, LogTheta(2.0), |_| 1e6, None);
    let contact = contact.with_normal_stress_effect(vec![0.1, 0.2]);
    let scene = Scene::new(SMatrix::<f64, 1, 1>::new(1e9)).with_contact(contact);
    assert!(matches!(
        Simulation::new(scene, Newmark::default(), Point).err(),
        Some(SceneError::Length {
            what: "normal-stress effect",
            expected: 1,
            found: 2
        })
    ));
    Ok(())
}

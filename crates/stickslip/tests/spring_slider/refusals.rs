//! Scenes and steps that are refused, by what is wrong with them.

use nalgebra::SMatrix;
use stickslip::friction::Tresca;
use stickslip::problems::{AGING, FRICTION, SpringScene, SpringSlider};
use stickslip::state::{Discontinuous, LogTheta, StateError, Theta};
use stickslip::{
    BackwardEuler, ErrorControl, Patch, Point, RateScheme, RungeKutta, Scene, SceneError, Sdirk2,
    Simulation, StepError, Stepper,
};

use crate::{Outcome, stepped};

type Block = SpringScene<Tresca, ()>;

/// A block in order.
fn plain() -> Block {
    Scene::new(SMatrix::<f64, 1, 1>::new(1e6))
        .with_viscosity(SMatrix::<f64, 1, 1>::new(1e3))
        .with_friction(Patch::point(1.0), Tresca { coefficient: 0.6 }, 1e5)
}

fn refused(scene: Block, scheme: impl RateScheme) -> Option<SceneError> {
    Simulation::new(scene, scheme, Point).err()
}

#[test]
fn illegal_parts_are_refused_by_name() -> Outcome {
    for cohesion in [-1.0, f64::NAN, f64::INFINITY] {
        for error in [
            refused(plain().with_cohesion(cohesion), Sdirk2),
            RungeKutta::new(plain().with_cohesion(cohesion)).err(),
        ] {
            let Some(SceneError::Value { what, value, .. }) = error else {
                return Err(format!("{cohesion}: {error:?}").into());
            };
            assert_eq!((what, value.to_bits()), ("cohesion", cohesion.to_bits()));
        }
    }
    let viscosity = SMatrix::<f64, 1, 1>::new(f64::NAN);
    let error = refused(plain().with_viscosity(viscosity), Sdirk2);
    assert!(
        matches!(
            error,
            Some(SceneError::Value {
                what: "viscosity matrix",
                ..
            })
        ),
        "{error:?}"
    );
    let slider = |stiffness, mass, damping| SpringSlider {
        stiffness,
        mass,
        damping,
        ..stepped(1e9)
    };
    for (name, slider) in [
        ("stiffness", slider(0.0, 0.0, 0.0)),
        ("stiffness", slider(f64::NAN, 0.0, 0.0)),
        ("mass", slider(1e9, -1.0, 0.0)),
        ("damping", slider(1e9, 0.0, f64::INFINITY)),
    ] {
        let error = slider.steady(FRICTION, AGING, 1e-6).err();
        assert!(
            matches!(error, Some(SceneError::Value { what, .. }) if what == name),
            "{error:?}"
        );
    }
    let error = stepped(1e9).steady(FRICTION, AGING, 0.0).err();
    assert!(matches!(error, Some(SceneError::State(_))), "{error:?}");
    let error = stepped(1e9)
        .scene(FRICTION, AGING, -1.0, LogTheta(0.0))
        .err();
    assert!(matches!(error, Some(SceneError::Value { .. })), "{error:?}");
    Ok(())
}

/// A state from which a law cannot start is refused, as [`StateLaw::validate_state`] says.
#[test]
fn a_negative_theta_is_refused() -> Outcome {
    let scene = Scene::new(SMatrix::<f64, 1, 1>::new(1e6))
        .with_friction(Patch::point(1.0), FRICTION, 1e5)
        .with_state(Discontinuous, Theta(-1.0));
    let error = Simulation::new(scene, BackwardEuler, Point).err();
    assert_eq!(
        error,
        Some(SceneError::State(StateError::NegativeTheta { theta: -1.0 }))
    );
    Ok(())
}

#[test]
fn a_normal_stress_that_is_no_number_fails_the_step() -> Outcome {
    let broken = |time: f64, stress: &mut [f64]| {
        if time > 0.25 {
            stress[0] = f64::NAN;
        }
    };
    let mut block = Simulation::new(plain().with_normal_stress_history(broken), Sdirk2, Point)?;
    block.step(0.2)?;
    let failure = block.step(0.2).err().ok_or("taken")?;
    assert!(
        matches!(
            failure.cause,
            StepError::Data { what: "normal stress", vertex: 0, value } if value.is_nan()
        ),
        "{failure:?}"
    );
    assert_eq!((failure.step, block.snapshot().step), (2, 1));
    assert_eq!(block.snapshot().time, 0.2);
    block.step(0.05)?;

    let mut block = RungeKutta::new(plain().with_normal_stress_history(broken))?;
    block.step(0.2)?;
    let failure = block.step(0.2).err().ok_or("taken")?;
    assert!(
        matches!(failure.cause, StepError::Stage { .. }),
        "{failure:?}"
    );
    assert_eq!((failure.step, block.snapshot().step), (2, 1));
    block.step(0.05)?;
    let always = |_: f64, stress: &mut [f64]| stress[0] = f64::NAN;
    let error = RungeKutta::new(plain().with_normal_stress_history(always)).err();
    assert!(
        matches!(error, Some(SceneError::Explicit { .. })),
        "{error:?}"
    );
    Ok(())
}

#[test]
fn an_explicit_method_says_what_it_cannot_take() -> Outcome {
    let matrix = SMatrix::<f64, 1, 1>::new(1e6);
    let point = Patch::point(1.0);
    for (scene, said) in [
        (plain().with_mass(matrix), "without mass"),
        (Scene::new(matrix), "friction"),
        (plain().in_equilibrium(), "initial displacement"),
        (
            Scene::new(matrix)
                .with_friction(Patch::point(1.0), Tresca { coefficient: 0.6 }, 1e5)
                .hold(
                    Patch {
                        vertices: vec![0],
                        weights: vec![1.0],
                    },
                    [false],
                ),
            "free",
        ),
    ] {
        let error = RungeKutta::new(scene).err().ok_or("accepted")?;
        assert!(matches!(error, SceneError::Explicit { .. }), "{error}");
        assert!(error.to_string().contains(said), "{error}");
    }
    // All its components held is no frictional vertex, for any method.
    let error = RungeKutta::new(plain().hold(point, [true])).err();
    assert!(
        matches!(
            error,
            Some(SceneError::TouchingBoundaries { vertex: 0, .. })
        ),
        "{error:?}"
    );
    let mut block = RungeKutta::new(plain())?;
    for dt in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let failure = block.step(dt).err().ok_or("taken")?;
        assert!(
            matches!(failure.cause, StepError::StepSize { .. }),
            "{failure}"
        );
        let failure = block.step_estimated(dt, &ErrorControl::default()).err();
        assert!(failure.is_some());
    }
    assert_eq!(block.snapshot().step, 0);
    Ok(())
}

//! Scenes and steps that are refused, by what is wrong with them.

use nalgebra::{SMatrix, Vector1};
use stickslip::friction::Tresca;
use stickslip::integrate::Stepper;
use stickslip::problems::spring_slider::{AGING, FRICTION, SpringScene, SpringSlider};
use stickslip::solvers::ConjugateGradients;
use stickslip::state::{Discontinuous, LogTheta, StateError, Theta};
use stickslip::time::QuasiStatic;
use stickslip::{
    BackwardEuler, BoundaryPart, Components, Contact, ErrorControl, Newmark, Point, RateScheme,
    RungeKutta, Scene, SceneError, Sdirk2, Simulation, StepError, Steps,
};

use super::stepped;
use crate::Outcome;

/// Friction in order.
fn coulomb() -> Contact<Tresca, (), 1> {
    Contact::new(BoundaryPart::point(1.0), Tresca { coefficient: 0.6 }, 1e5)
}

/// A block in order, its contact still missing.
fn free() -> SpringScene {
    Scene::new(SMatrix::<f64, 1, 1>::new(1e6)).with_viscosity(SMatrix::<f64, 1, 1>::new(1e3))
}

/// A block in order.
fn plain() -> SpringScene {
    free().with_contact(coulomb())
}

fn refused(scene: SpringScene, scheme: impl RateScheme + 'static) -> Option<SceneError> {
    Simulation::new(scene, scheme, Point).err()
}

#[test]
fn illegal_parts_are_refused_by_name() -> Outcome {
    for cohesion in [-1.0, f64::NAN, f64::INFINITY] {
        let scene = || free().with_contact(coulomb().with_cohesion(cohesion));
        for error in [refused(scene(), Sdirk2), RungeKutta::new(scene()).err()] {
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

/// A state from which a law cannot start is refused, as `StateLaw::validate_state` says.
#[test]
fn a_negative_theta_is_refused() {
    let contact = Contact::new(BoundaryPart::point(1.0), FRICTION, 1e5)
        .with_state(Discontinuous, Theta(-1.0));
    assert_eq!(
        refused(free().with_contact(contact), BackwardEuler),
        Some(SceneError::from(StateError::Value {
            what: "state theta [s]",
            requirement: "non-negative",
            value: -1.0
        }))
    );
}

/// A normal stress that is no number after 0.25 s.
fn broken(time: f64, stress: &mut [f64]) {
    if time > 0.25 {
        stress[0] = f64::NAN;
    }
}

#[test]
fn a_normal_stress_that_is_no_number_fails_the_step() -> Outcome {
    let scene = || free().with_contact(coulomb().with_normal_stress_history(broken));
    let implicit = Simulation::new(scene(), Sdirk2, Point)?;
    let blocks: [Box<dyn Stepper<1>>; 2] =
        [Box::new(implicit), Box::new(RungeKutta::new(scene())?)];
    for mut block in blocks {
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
        assert_eq!(block.snapshot().contact(0).normal_stress(0), 1e5);
        block.step(0.05)?;
    }
    Ok(())
}

#[test]
fn a_normal_stress_that_is_no_number_at_the_start_is_refused() {
    let always = |_: f64, stress: &mut [f64]| stress[0] = f64::NAN;
    let scene = || free().with_contact(coulomb().with_normal_stress_history(always));
    for error in [refused(scene(), Sdirk2), RungeKutta::new(scene()).err()] {
        assert!(
            matches!(
                error,
                Some(SceneError::Start(StepError::Data {
                    what: "normal stress",
                    vertex: 0,
                    ..
                }))
            ),
            "{error:?}"
        );
    }
}

/// Without viscosity, what friction does not bear has no finite slip rate.
#[test]
fn an_explicit_method_needs_a_finite_slip_rate_at_the_start() -> Outcome {
    let pull = |_: f64, load: &mut [Vector1<f64>]| load[0][0] = 7e4;
    let scene = Scene::new(SMatrix::<f64, 1, 1>::new(1e6)).with_contact(coulomb());
    let error = RungeKutta::new(scene.with_load_history(pull)).err();
    let error = error.ok_or("accepted")?;
    assert!(
        matches!(
            error,
            SceneError::Vertex {
                what: "viscosity",
                vertex: 0,
                ..
            }
        ),
        "{error}"
    );
    RungeKutta::new(plain().with_load_history(pull))?;
    Ok(())
}

#[test]
fn an_explicit_method_says_what_it_cannot_take() -> Outcome {
    let matrix = SMatrix::<f64, 1, 1>::new(1e6);
    let error = RungeKutta::new(plain().with_mass(matrix))
        .err()
        .ok_or("accepted")?;
    assert!(
        matches!(
            error,
            SceneError::Unsupported {
                by: SceneError::EXPLICIT,
                ..
            }
        ),
        "{error}"
    );
    assert!(error.to_string().contains("without mass"), "{error}");
    // Nothing resists a block without a dashpot and a contact.
    let error = RungeKutta::new(Scene::new(matrix)).err();
    assert!(matches!(
        error,
        Some(SceneError::Vertex {
            what: "viscosity",
            vertex: 0,
            ..
        })
    ));
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

/// Scenes without inertia that an implicit method accepts: no contact or two, fixed or driven, from an equilibrium.
#[test]
fn an_explicit_method_agrees_with_an_implicit_one() -> Outcome {
    let pull = |time: f64, load: &mut [Vector1<f64>]| load[0][0] = 3e5 * time;
    let smooth = |weight: f64| {
        Contact::new(BoundaryPart::point(weight), FRICTION, 1e5).with_state(AGING, LogTheta(2.0))
    };
    let velocity = |time: f64| [0.1 * time];
    type Build = Box<dyn Fn() -> SpringScene>;
    let scenes: [Build; 6] = [
        Box::new(free),
        Box::new(move || free().with_contact(smooth(1.0))),
        Box::new(move || free().with_contact(smooth(0.5)).with_contact(smooth(0.7))),
        Box::new(move || {
            let held = free()
                .with_contact(smooth(1.0))
                .fix(BoundaryPart::point(1.0), Components::ALL);
            held.in_equilibrium(ConjugateGradients::default())
        }),
        Box::new(move || {
            free().with_contact(smooth(1.0)).prescribe_velocity(
                BoundaryPart::point(1.0),
                Components::ALL,
                velocity,
            )
        }),
        Box::new(move || free().in_equilibrium(ConjugateGradients::default())),
    ];
    // Some 1e3 steps, each to 1e-9, whose errors may grow as an instability does, not tenfold.
    let bound = 1e-5;
    for (number, scene) in scenes.iter().enumerate() {
        let scene = || scene().with_load_history(pull);
        let mut implicit = Simulation::new(scene(), QuasiStatic(Newmark::default()), Point)?;
        let plan = Steps::adaptive(1e-9)
            .with_error_control(ErrorControl::extrapolated(4))
            .until(0.5);
        implicit.run(&plan, |_| ())?;
        let mut explicit = RungeKutta::new(scene())?;
        explicit.run(&Steps::adaptive(1e-9).until(0.5), |_| ())?;
        let (implicit, explicit) = (implicit.snapshot(), explicit.snapshot());
        for (a, b) in [
            (implicit.displacement[0][0], explicit.displacement[0][0]),
            (implicit.velocity[0][0], explicit.velocity[0][0]),
            (implicit.reaction_at(0)?[0], explicit.reaction_at(0)?[0]),
        ] {
            assert!(
                (a - b).abs() <= bound * b.abs(),
                "scene {number}: {a:e} {b:e}"
            );
        }
        for (a, b) in implicit.contacts().zip(explicit.contacts()) {
            assert!((a.state(0) - b.state(0)).abs() <= bound, "scene {number}");
            // It does not turn back.
            let (path, way) = (b.slip_path(0), b.slip_vector(0)[0]);
            assert!(
                (path - way).abs() <= 1e-12 * way,
                "scene {number}: {path:e} {way:e}"
            );
        }
    }
    Ok(())
}

/// Where everything is fixed or driven, what is prescribed holds, and friction has nothing to decide.
#[test]
fn what_is_prescribed_holds_where_a_block_could_slide() -> Outcome {
    let pull = |time: f64, load: &mut [Vector1<f64>]| load[0][0] = 1e6 * time;
    let scene = || plain().with_load_history(pull);
    let held = scene().fix(BoundaryPart::point(1.0), Components::ALL);
    let mut block = Simulation::new(held, BackwardEuler, Point)?;
    block.step(1.0)?;
    let at = block.snapshot();
    assert_eq!((at.velocity[0][0], at.displacement[0][0]), (0.0, 0.0));
    assert!((at.reaction_at(0)?[0] + 1e6).abs() < 1e-9);
    let moved = scene().prescribe_velocity(BoundaryPart::point(1.0), Components::ALL, |_| [0.5]);
    let mut block = Simulation::new(moved, BackwardEuler, Point)?;
    block.step(1.0)?;
    let at = block.snapshot();
    assert_eq!((at.velocity[0][0], at.displacement[0][0]), (0.5, 0.5));
    // Spring, dashpot and friction against the load and the one who moves it.
    let reaction = 1e6 * 0.5 + 1e3 * 0.5 + 0.6 * 1e5 - 1e6;
    assert!((at.reaction_at(0)?[0] - reaction).abs() < 1e-9);
    assert!((at.contact(0).traction(0)[0] - 0.6 * 1e5).abs() < 1e-9);
    Ok(())
}

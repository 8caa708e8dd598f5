//! A contact under tension is refused, or open; it is never pressed.

use nalgebra::SMatrix;
use stickslip::friction::Tresca;
use stickslip::{
    BoundaryPart, Contact, Newmark, Point, Scene, SceneError, Simulation, StepError, Steps,
};

use crate::Outcome;

const STIFFNESS: f64 = 1e6;

fn contact(normal_stress: f64) -> Contact<Tresca, (), 1> {
    Contact::new(
        BoundaryPart::point(1.0),
        Tresca { coefficient: 0.5 },
        normal_stress,
    )
}

fn scene(contact: Contact<Tresca, (), 1>) -> Scene<SMatrix<f64, 1, 1>, 1> {
    Scene::new(SMatrix::<f64, 1, 1>::new(STIFFNESS))
        .with_contact(contact)
        .with_load_history(|time, load| load[0][0] = 1e4 * time)
}

#[test]
fn a_tension_is_refused_with_its_value() {
    let refused = Simulation::new(scene(contact(-1e5)), Newmark::default(), Point);
    assert!(matches!(
        refused,
        Err(SceneError::Value {
            what: "normal stress",
            value: -1e5,
            ..
        })
    ));
}

#[test]
fn an_open_contact_transmits_nothing() -> Outcome {
    let mut open = Simulation::new(
        scene(contact(-1e5).allow_opening()),
        Newmark::default(),
        Point,
    )?;
    open.step(1.0)?;
    let at = open.snapshot();
    assert_eq!(
        (at.contact(0).normal_stress(0), at.contact(0).traction(0)[0]),
        (0.0, 0.0)
    );
    assert!((at.displacement[0][0] * STIFFNESS - 1e4).abs() < 1e-9);
    Ok(())
}

/// The normal stress falls through zero at 10 s: the step into tension fails, or the block follows its spring
/// from there on.
#[test]
fn a_history_that_turns_to_tension_is_reported_or_opens() -> Outcome {
    let history = |time: f64, stress: &mut [f64]| stress[0] = 1e5 - 1e4 * time;
    let pulled = contact(1e5).with_normal_stress_history(history);
    let steps = Steps::constant(0.1).until(12.0);
    let mut refused = Simulation::new(scene(pulled), Newmark::default(), Point)?;
    let failure = refused.run(&steps, |_| ()).err().ok_or("pressed")?;
    let StepError::Tension {
        vertex: 0,
        normal_stress,
    } = failure.cause
    else {
        return Err(failure.into());
    };
    assert!((normal_stress + 1e3).abs() < 1e-6 && (failure.time - 10.1).abs() < 1e-9);
    let pulled = contact(1e5)
        .with_normal_stress_history(history)
        .allow_opening();
    let mut opens = Simulation::new(scene(pulled), Newmark::default(), Point)?;
    opens.run(&steps, |at| {
        let strength = 0.5 * (1e5 - 1e4 * at.time).max(0.0);
        assert!(at.contact(0).traction(0)[0].abs() <= strength * (1.0 + 1e-12));
    })?;
    assert!((opens.snapshot().displacement[0][0] * STIFFNESS - 1.2e5).abs() < 1e-6);
    Ok(())
}

//! Files of something else, and places at which there can be none.

use std::fs;

use nalgebra::SMatrix;
use stickslip::friction::DieterichRuina;
use stickslip::problems::spring_slider::{AGING, FRICTION, LoadPath, SpringScene, SpringSlider};
use stickslip::record::FileError;
use stickslip::state::{Dieterich, Ruina};
use stickslip::{
    BoundaryPart, Checkpoint, Contact, GeneralizedAlpha, Newmark, Point, Scene, SceneError,
    Simulation,
};

use super::{Place, block, moved, refusal, slider};
use crate::Outcome;

#[test]
fn what_is_no_checkpoint_is_refused() -> Outcome {
    let place = Place::new("foreign")?;
    let mut block = block()?;
    for (name, contents) in [
        ("empty", ""),
        ("text", "time,vertex\n0,1\n"),
        ("near", "\u{89}"),
    ] {
        let path = place.file(name);
        fs::write(&path, contents)?;
        let error = refusal(Checkpoint::at(path).restore::<(), 1>(&mut block), &block)?;
        assert!(
            matches!(
                error,
                FileError::Kind {
                    kind: "checkpoint",
                    ..
                }
            ),
            "{error:?}"
        );
    }
    for path in [place.file("missing"), place.0.clone()] {
        let error = refusal(Checkpoint::at(path).restore::<(), 1>(&mut block), &block)?;
        assert!(matches!(error, FileError::Read { .. }), "{error:?}");
    }
    Ok(())
}

/// A checkpoint that cannot be written leaves the old file, and nothing beside it.
#[test]
fn what_cannot_be_written_is_refused() -> Outcome {
    let place = Place::new("unwritten")?;
    let before = moved()?;
    fs::create_dir(place.file("folder"))?;
    for path in [
        place.file("folder"),
        place.file("none").join("file"),
        "/dev/null".into(),
        "..".into(),
        "".into(),
    ] {
        let error = Checkpoint::at(&path).save(&before.snapshot(), &()).err();
        assert!(
            matches!(error, Some(FileError::Write { .. })),
            "{path:?}: {error:?}"
        );
    }
    assert_eq!(fs::read_dir(&place.0)?.count(), 1);
    // A new file takes the place of an old one.
    let file = Checkpoint::at(place.file("file"));
    file.save(&before.snapshot(), &1_u8)?;
    file.save(&before.snapshot(), &2_u8)?;
    assert_eq!(file.restore::<u8, 1>(&mut block()?)?, 2);
    assert_eq!(fs::read_dir(&place.0)?.count(), 2);
    Ok(())
}

/// A scene that differs in one thing is refused, and the thing is named.
#[test]
fn another_scene_is_refused() -> Outcome {
    let place = Place::new("scene")?;
    let file = Checkpoint::at(place.file("file"));
    file.save(&moved()?.snapshot(), &())?;
    type Made = Result<SpringScene, SceneError>;
    let of = |slider: SpringSlider| -> Made { slider.steady(FRICTION, AGING, 1e-6) };
    let by = |law: DieterichRuina| -> Made { slider().steady(law, AGING, 1e-6) };
    let initial = stickslip::problems::spring_slider::steady_state(&AGING, 1e-6)?;
    let later = Dieterich {
        slip_distance: 2.0 * AGING.slip_distance,
    };
    let slip = Ruina {
        slip_distance: AGING.slip_distance,
    };
    let scene = || slider().scene(FRICTION, AGING, 1e-6, initial);
    let stiffer = 1e9_f64.next_up();
    let faster = LoadPath::steady(1e-6).then(0.2, 1.1e-6);
    let second = Contact::new(BoundaryPart::point(1.0), FRICTION, 1e6).with_state(AGING, initial);
    let others: [(&str, Made); 13] = [
        (
            "the stiffness matrix",
            of(SpringSlider {
                stiffness: stiffer,
                ..slider()
            }),
        ),
        (
            "the mass matrix",
            of(SpringSlider {
                mass: 5.1e3,
                ..slider()
            }),
        ),
        (
            "the mass matrix",
            of(SpringSlider {
                mass: 0.0,
                ..slider()
            }),
        ),
        (
            "the viscosity matrix",
            of(SpringSlider {
                damping: 1.0,
                ..slider()
            }),
        ),
        (
            "the load",
            of(SpringSlider {
                load: faster,
                ..slider()
            }),
        ),
        (
            "the normal stress of contact 0",
            of(SpringSlider {
                normal_stress: 1.1e6,
                ..slider()
            }),
        ),
        (
            "the coefficient of friction of contact 0",
            by(DieterichRuina {
                a: 0.011,
                ..FRICTION
            }),
        ),
        (
            "the dependence of friction on the state of contact 0",
            by(DieterichRuina {
                b: 0.011,
                ..FRICTION
            }),
        ),
        (
            "the evolution of the state of contact 0",
            slider().scene(FRICTION, slip, 1e-6, initial),
        ),
        (
            "the evolution of the state of contact 0",
            slider().scene(FRICTION, later, 1e-6, initial),
        ),
        (
            "the effect of the normal stress on the state of contact 0",
            {
                let contact = Contact::new(BoundaryPart::point(1.0), FRICTION, 1e6)
                    .with_state(AGING, initial);
                alone(contact.with_normal_stress_effect(0.1))
            },
        ),
        (
            "the number of contacts",
            scene().map(|scene| scene.with_contact(second)),
        ),
        ("the cohesion of contact 0", {
            let contact =
                Contact::new(BoundaryPart::point(1.0), FRICTION, 1e6).with_state(AGING, initial);
            alone(contact.with_cohesion(1.0))
        }),
    ];
    for (what, other) in others {
        let mut block = Simulation::new(other?, Newmark::default(), Point)?;
        let result = file.restore::<(), 1>(&mut block);
        let error = refusal(result, &block)?;
        let FileError::Mismatch {
            kind: "checkpoint",
            what: found,
            ..
        } = &error
        else {
            return Err(format!("{what}: {error}").into());
        };
        assert_eq!(found, what, "{error}");
    }
    Ok(())
}

/// The block with another contact.
fn alone(contact: Contact<DieterichRuina, Dieterich, 1>) -> Result<SpringScene, SceneError> {
    let SpringSlider {
        stiffness,
        mass,
        load,
        ..
    } = slider();
    Ok(Scene::new(SMatrix::<f64, 1, 1>::new(stiffness))
        .with_mass(SMatrix::<f64, 1, 1>::new(mass))
        .with_load_history(move |time, force| force[0][0] = stiffness * load.position(time))
        .with_contact(contact))
}

/// Tags are compared one by one, and the first one that differs is named; a method that stores other numbers is refused,
/// tagged or not.
#[test]
fn another_run_is_refused() -> Outcome {
    let place = Place::new("tags")?;
    let at = || Checkpoint::at(place.file("file"));
    let tagged = at().tagged("scheme", "newmark").tagged("step", 0.1);
    tagged.save(&moved()?.snapshot(), &())?;
    let mut block = block()?;
    for (other, line) in [
        (
            at().tagged("scheme", "newmark").tagged("step", 0.2),
            "step is 0.1 there and 0.2 here",
        ),
        (
            at().tagged("scheme", "newmark"),
            "step is 0.1 there and absent here",
        ),
        (
            at().tagged("step", 0.1),
            "scheme is newmark there and absent here",
        ),
    ] {
        let error = refusal(other.restore::<(), 1>(&mut block), &block)?;
        let line = format!(
            "{} is a checkpoint of another scene: {line}",
            at().path().display()
        );
        assert_eq!(error.to_string(), line);
    }
    tagged.restore::<(), 1>(&mut block)?;
    assert_eq!(block.snapshot().step, 3);

    let scheme = GeneralizedAlpha {
        spectral_radius: 0.5,
    };
    let mut other = Simulation::new(slider().steady(FRICTION, AGING, 1e-6)?, scheme, Point)?;
    let error = refusal(tagged.restore::<(), 1>(&mut other), &other)?;
    assert!(matches!(error, FileError::State { .. }), "{error}");
    Ok(())
}

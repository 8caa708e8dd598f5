//! Scenes that cannot be reduced, and scenes that are none of a reduced body.

use stickslip::fem::{P1, elasticity, mass};
use stickslip::friction::Tresca;
use stickslip::problems::pipping_slider::{NORMAL_STRESS, PippingSlider};
use stickslip::reduced::Reduced;
use stickslip::solvers::SolveError;
use stickslip::{Components, Contact, DenseNewton, Newmark, Scene, SceneError, Simulation};

use super::{Block, slider};
use crate::Outcome;
use crate::common::body;

#[test]
fn frequencies_that_are_none() -> Outcome {
    let scene = Block::new(1)?.with_inertia()?;
    for frequency in [f64::NAN, 0.0, -1.0, f64::NEG_INFINITY] {
        let error = Reduced::new(&scene).up_to_frequency(frequency).err();
        let Some(SceneError::Value { what, value, .. }) = error else {
            return Err(format!("{frequency}: {error:?}").into());
        };
        assert_eq!((what, value.to_bits()), ("frequency", frequency.to_bits()));
        let error = Reduced::new(&scene).for_time_step(frequency).err();
        assert!(
            matches!(
                error,
                Some(SceneError::Value {
                    what: "step size",
                    ..
                })
            ),
            "{error:?}"
        );
    }
    let Some(SceneError::BelowModes { frequency, first }) =
        Reduced::new(&scene).up_to_frequency(1.0).err()
    else {
        return Err("taken".into());
    };
    assert!(frequency == 1.0 && first > 1.0);
    let body = Reduced::new(&scene).up_to_frequency(first * (1.0 + 1e-9))?;
    assert!(
        body.frequencies()
            .next()
            .is_some_and(|f| (f / first - 1.0).abs() < 1e-6)
    );
    Ok(())
}

#[test]
fn bodies_without_a_surface() -> Outcome {
    let space = P1::grid([1.0, 1.0], [2, 2])?;
    let elastic = body(0).elastic;
    let scene = Scene::new(elasticity(&space, &elastic)?)
        .with_mass(mass(&space, 5e3)?)
        .fix(&space.trace(|x| x[1] == 1.0)?, Components::ALL);
    let error = Reduced::new(&scene).up_to_frequency(100.0).err();
    assert!(
        matches!(
            error,
            Some(SceneError::Unsupported {
                by: SceneError::REDUCTION,
                ..
            })
        ),
        "{error:?}"
    );
    let error = Reduced::new(&scene)
        .with_vertices([4, 9])
        .up_to_frequency(100.0)
        .err();
    let Some(SceneError::Value { what, position, .. }) = error else {
        return Err(format!("{error:?}").into());
    };
    assert_eq!((what, position), ("kept vertex", 1));
    let error = Reduced::new(&scene)
        .with_vertices([4])
        .with_memory_limit(10)
        .up_to_frequency(100.0);
    let error = error.err();
    let memory = matches!(
        error,
        Some(SceneError::Equilibrium(SolveError::MemoryLimit { .. }))
    );
    assert!(memory, "{error:?}");
    Ok(())
}

/// The response of an interior that nothing holds has no end.
#[test]
fn an_interior_that_floats() -> Outcome {
    for cells in 1..9 {
        let space = P1::grid([1.0, 1.0], [cells, cells])?;
        // One vertex lets the body turn around it.
        let corner = space.vertex_at([0.0, 0.0]).ok_or("no vertex")?;
        let scene = Scene::new(elasticity(&space, &body(0).elastic)?).with_mass(mass(&space, 5e3)?);
        let error = Reduced::new(&scene)
            .with_vertices([corner])
            .up_to_frequency(f64::INFINITY)
            .err();
        let floats = matches!(
            error,
            Some(SceneError::Equilibrium(SolveError::RigidBodyMode { .. }))
        );
        assert!(floats, "{cells} cells: {error:?}");
    }
    Ok(())
}

#[test]
fn scenes_of_other_bodies() -> Outcome {
    let paper = body(2);
    let space = paper.space()?;
    let reduced = Reduced::new(&slider(&paper, &space)?).up_to_frequency(100.0)?;
    let heavier = PippingSlider {
        density: 1.1 * paper.density,
        ..paper
    };
    let mirrored = PippingSlider {
        mirrored: true,
        ..paper
    };
    let side = space.trace(|x| x[0] == 0.0 && x[1] > 0.0 && x[1] < 1.0)?;
    let held = slider(&paper, &space)?.fix(&side, Components::X);
    let without = paper.scene(&space)?;
    for (what, scene) in [
        ("another mesh", slider(&mirrored, &mirrored.space()?)?),
        ("another size", slider(&body(1), &body(1).space()?)?),
    ] {
        let error = reduced.reduce(scene).err();
        assert!(
            matches!(error, Some(SceneError::Mesh(_))),
            "{what}: {error:?}"
        );
    }
    let heavier = slider(&heavier, &space)?;
    let error = reduced.reduce(heavier).err().ok_or("taken")?.to_string();
    assert!(
        error.contains("material") && !error.contains("mesh"),
        "{error}"
    );
    for (what, scene) in [("held at its side", held), ("without its contact", without)] {
        let error = reduced.reduce(scene).err();
        assert!(
            matches!(
                error,
                Some(SceneError::Unsupported {
                    by: SceneError::REDUCTION,
                    ..
                })
            ),
            "{what}: {error:?}"
        );
    }
    Ok(())
}

/// The same vertices moved, but not the same ones together.
#[test]
fn parts_that_move_otherwise() -> Outcome {
    let space = P1::grid([2.0, 1.0], [4, 2])?;
    let scene = |split: f64, swapped: bool| -> Outcome<_> {
        let bottom = space.trace(|x| x[1] == 0.0)?;
        let left = space.trace(|x| x[1] == 1.0 && x[0] <= split)?;
        let right = space.trace(|x| x[1] == 1.0 && x[0] > split)?;
        let parts = if swapped {
            [right, left]
        } else {
            [left, right]
        };
        let mut scene = Scene::new(elasticity(&space, &body(0).elastic)?)
            .with_mass(mass(&space, 5e3)?)
            .with_contact(Contact::new(&bottom, Tresca { coefficient: 0.5 }, 1e4));
        for (part, rate) in parts.iter().zip([1e-3, 2e-3]) {
            scene = scene.prescribe_velocity(part, Components::ALL, move |_| [rate, 0.0]);
        }
        Ok(scene)
    };
    let body = Reduced::new(&scene(0.5, false)?).up_to_frequency(f64::INFINITY)?;
    assert!(body.reduce(scene(0.5, false)?).is_ok());
    for other in [scene(1.0, false)?, scene(0.5, true)?] {
        let error = body.reduce(other).err();
        assert!(
            matches!(
                error,
                Some(SceneError::Unsupported {
                    by: SceneError::REDUCTION,
                    ..
                })
            ),
            "{error:?}"
        );
    }
    Ok(())
}

#[test]
fn parts_of_the_whole_body_are_none_of_the_reduced_one() -> Outcome {
    let paper = body(1);
    let space = paper.space()?;
    let body = Reduced::new(&slider(&paper, &space)?).up_to_frequency(100.0)?;
    let bottom = PippingSlider::bottom(&space)?;
    let contact = Contact::new(&bottom, Tresca { coefficient: 0.5 }, NORMAL_STRESS);
    let scene = body.reduce(slider(&paper, &space)?)?.with_contact(contact);
    let error = Simulation::new(scene, Newmark::default(), DenseNewton::new()).err();
    let other = matches!(&error, Some(SceneError::Mesh(error)) if error.what == "contact 2");
    assert!(other, "{error:?}");
    let error = body.part(&space.trace(|x| x[1] == 1.0)?).err();
    assert!(
        matches!(error, Some(SceneError::EmptyBoundary { .. })),
        "{error:?}"
    );
    // On the reduced body it is one.
    let part = body.part(&bottom)?;
    let contact = Contact::new(&part, Tresca { coefficient: 0.5 }, NORMAL_STRESS);
    let scene = body.reduce(slider(&paper, &space)?)?.with_contact(contact);
    Simulation::new(scene, Newmark::default(), DenseNewton::new())?;
    Ok(())
}

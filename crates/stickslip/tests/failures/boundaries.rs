//! Parts of the boundary that are none, that meet, or that do not support a body.

use nalgebra::Vector1;
use stickslip::fem::{P1, antiplane, mass};
use stickslip::friction::Tresca;
use stickslip::problems::Slider;
use stickslip::{Newmark, Patch, Scene, SceneError, Simulation, Tnnmg};

use crate::common::{Outcome, body};
use crate::{body_error, one_line};

#[test]
fn boundary_parts_must_be_sets_of_vertices() -> Outcome {
    let paper = body(1);
    let space = paper.space()?;
    let patch = |vertices: Vec<usize>| Patch {
        weights: vec![1.0; vertices.len()],
        vertices,
    };
    let law = Tresca { coefficient: 0.6 };
    let scene = || paper.scene(&space);
    let parts = |patch: Patch| -> Result<_, Box<dyn std::error::Error>> {
        Ok([
            body_error(scene()?.with_friction(patch.clone(), law, 1e5))?,
            body_error(scene()?.hold(patch.clone(), [true, false]))?,
            body_error(scene()?.move_at(patch, [true, false], |_| [0.0; 2]))?,
        ])
    };
    let roles = ["frictional boundary", "held boundary", "moved boundary"];
    for (error, role) in parts(patch(vec![]))?.into_iter().zip(roles) {
        assert_eq!(error, SceneError::EmptyBoundary { what: role });
    }
    for (vertices, position) in [
        (vec![3, 2], 1),
        (vec![2, 2], 1),
        (vec![0, 33], 1),
        (vec![99], 0),
    ] {
        for (error, role) in parts(patch(vertices.clone()))?.into_iter().zip(roles) {
            let SceneError::Value {
                what,
                position: found,
                value,
                ..
            } = error
            else {
                return Err(error.into());
            };
            assert_eq!((what, found), (role, position));
            assert_eq!(value, vertices[position] as f64);
        }
    }
    Ok(())
}

#[test]
fn touching_boundaries_are_named() -> Outcome {
    let paper = body(1);
    let space = paper.space()?;
    let bottom = Slider::bottom(&space)?;
    let law = Tresca { coefficient: 0.6 };
    let scene =
        || -> Result<_, SceneError> { Ok(paper.scene(&space)?.with_friction(&bottom, law, 1e5)) };
    let corner = space.vertex_at([0.0, 0.0]).ok_or("no corner")?;
    let side = space.trace(|x| x[0] == 0.0)?;
    let touching = |other| SceneError::TouchingBoundaries {
        other,
        vertex: corner,
    };
    assert_eq!(
        body_error(scene()?.hold(&side, [true, true]))?,
        touching("held")
    );
    // Each of two parts holds one component.
    assert_eq!(
        body_error(scene()?.hold(&side, [true, false]))?,
        touching("held")
    );
    let moved = scene()?.move_at(&side, [true, true], |_| [0.0; 2]);
    assert_eq!(body_error(moved)?, touching("moved"));
    // With the normal component alone the bottom can still slide.
    assert!(body_error(scene()?.hold(&side, [false, true])).is_err());
    Ok(())
}

/// Without any support there is no equilibrium under a push.
#[test]
fn a_floating_body_has_no_equilibrium() -> Outcome {
    let space = P1::grid([2.0, 1.0], [2, 1])?.refined(1)?;
    let scene = || -> Result<_, SceneError> {
        let push = vec![Vector1::new(1.0); space.vertex_count()];
        let scene = Scene::new(antiplane(&space, 1e7)?).with_mass(mass(&space, 5e3)?);
        Ok(scene.with_load(push).in_equilibrium())
    };
    let solver = Tnnmg::new(space.hierarchy().prolongations());
    let made = Simulation::new(scene()?, Newmark::default(), solver);
    let error = one_line(made.err().ok_or("multigrid found one")?)?;
    assert!(matches!(error, SceneError::Solver(_)), "{error:?}");
    let error = body_error(scene()?)?;
    assert!(matches!(error, SceneError::Solver(_)), "{error:?}");
    Ok(())
}

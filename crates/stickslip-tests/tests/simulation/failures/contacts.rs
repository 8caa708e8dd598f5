//! Contacts whose normal is none of the axes, or missing where it should be free.

use nalgebra::Vector2;
use stickslip::fem::{Mesh, P1, antiplane, elasticity};
use stickslip::problems::pipping_slider::PippingSlider;
use stickslip::{
    BlockGaussSeidel, BoundaryPart, Contact, Newmark, Point, Scene, SceneError, Simulation, Tnnmg,
};

use super::{COULOMB, body_error, contact_error, coulomb, free_spring};
use crate::Outcome;
use crate::common::body;

/// A contact around a corner has no normal there: its faces are too far apart.
#[test]
fn a_contact_around_a_corner_is_named_at_the_corner() -> Outcome {
    let paper = body(1);
    let space = paper.space()?;
    let around = space.trace(|x| x[1] == 0.0 || x[0] == 0.0 && x[1] < 1.0)?;
    let corner = space.vertex_at([0.0, 0.0]).ok_or("no corner")?;
    for free in [false, true] {
        let mut contact = Contact::new(&around, COULOMB, 1e5);
        if free {
            contact = contact.with_free_normal();
        }
        let error = body_error(paper.scene(&space)?.with_contact(contact))?;
        let expected = SceneError::Normal {
            vertex: corner,
            normal: [0.0; 3],
            requirement: "one to slide along",
        };
        assert_eq!(error, expected);
    }
    // Two contacts that meet there are in order.
    let bottom = Contact::new(&PippingSlider::bottom(&space)?, COULOMB, 1e5);
    let side = space.trace(|x| x[0] == 0.0 && x[1] < 1.0)?;
    let scene = paper.scene(&space)?.with_contact(bottom);
    let scene = scene.with_contact(Contact::new(&side, COULOMB, 1e5));
    let solver = Tnnmg::new(space.transfers());
    let mut body = Simulation::new(scene, Newmark::default(), solver)?;
    body.step(1e-3)?;
    assert_eq!(body.snapshot().velocity[corner].norm(), 0.0);
    Ok(())
}

/// A vertex without a normal.
#[test]
fn a_contact_without_a_normal_is_named() -> Outcome {
    let corners = vec![
        Vector2::new(0.0, 0.0),
        Vector2::new(1.0, 0.0),
        Vector2::new(0.0, 1.0),
    ];
    let space = P1::new(Mesh::new(corners, vec![0, 1, 2])?);
    let slope = space.trace(|x| x[0] + x[1] == 1.0)?;
    let scene = || -> Outcome<_> { Ok(Scene::new(elasticity(&space, &body(1).elastic)?)) };
    let refused = |part: BoundaryPart| -> Outcome<_> {
        body_error(scene()?.with_contact(Contact::new(part, COULOMB, 1e5)))
    };
    let mut part = BoundaryPart::from(&space.trace(|x| x[1] == 0.0)?);
    part.normals[1] = [0.0; 3];
    let error = refused(part.clone())?;
    let expected = SceneError::Normal {
        vertex: part.vertices[1],
        normal: [0.0; 3],
        requirement: "one to slide along",
    };
    assert_eq!(error, expected);
    assert!(error_text_names(&error, &[0.0; 3]));
    // Out of plane every surface is a plane one, whatever its shape.
    let scene =
        Scene::new(antiplane(&space, 1e7)?).with_contact(Contact::new(&slope, COULOMB, 1e5));
    let solver = BlockGaussSeidel::new();
    Simulation::new(scene, Newmark::default(), solver)?;
    Ok(())
}

fn error_text_names(error: &SceneError, normal: &[f64; 3]) -> bool {
    error.to_string().contains(&format!("{normal:?}"))
}

/// Where a field has no normal component, none can be free.
#[test]
fn a_free_normal_that_is_none_is_named() -> Outcome {
    let error = contact_error(coulomb().with_free_normal())?;
    let expected = |vertex| SceneError::Normal {
        vertex,
        normal: [0.0; 3],
        requirement: "one that can be free",
    };
    assert_eq!(error, expected(0));
    let space = body(1).space()?;
    let bottom = PippingSlider::bottom(&space)?;
    let contact = Contact::new(&bottom, COULOMB, 1e5).with_free_normal();
    let error = body_error(Scene::new(antiplane(&space, 1e7)?).with_contact(contact))?;
    let vertex = bottom.vertices()[0];
    assert_eq!(error, expected(vertex));
    Simulation::new(
        free_spring().with_contact(coulomb()),
        Newmark::default(),
        Point,
    )?;
    Ok(())
}

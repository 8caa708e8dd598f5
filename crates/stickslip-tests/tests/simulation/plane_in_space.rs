//! A body in space with plane data is the body in the plane.

use std::f64::consts::PI;

use nalgebra::SVector;
use stickslip::fem::{P1, elasticity, mass};
use stickslip::friction::DieterichRuina;
use stickslip::problems::pipping_slider::{
    AGING, FRICTION, NORMAL_STRESS, PippingSlider, load_velocity,
};
use stickslip::state::LogTheta;
use stickslip::{Condensed, Contact, Newmark, Scene, Simulation, Steps};

use crate::Outcome;

/// The length of the body \[m\], of height 1 m.
const LENGTH: f64 = 2.0;
const STEP: f64 = 4e-3;
/// Until the whole bottom slides, 4 s.
const STEPS: usize = 1000;

/// Friction that strengthens and varies along the bottom, so that slip is smooth and reaches one place after another.
fn law(x: f64) -> DieterichRuina {
    DieterichRuina {
        a: 0.015,
        b: 0.010,
        reference_friction: 0.05 + 0.02 * (PI * x / LENGTH).cos(),
        ..FRICTION
    }
}

/// The displacement along the body at the vertices of the bottom, with their places \[m\], every hundredth step.
///
/// The ends hold the vertical component: a body and its mirror images go on into each other there, and no corner
/// limits the order. In space all of the body is on one of the two planes that hold the third component.
fn history<const D: usize>(space: &P1<D>) -> Outcome<Vec<Vec<(f64, f64)>>> {
    let on = |c: usize, value: f64| space.trace(move |x| x[c] == value);
    let (bottom, top) = (on(1, 0.0)?, on(1, 1.0)?);
    let only = |component: usize| std::array::from_fn(|c| c == component);
    let paper = PippingSlider::default();
    let laws = bottom.map(|x| law(x[0]));
    let contact =
        Contact::per_vertex(&bottom, laws, NORMAL_STRESS).with_state(AGING, LogTheta(-2.0));
    let mut scene = Scene::new(elasticity(space, &paper.elastic)?)
        .on(space)
        .with_mass(mass(space, paper.density)?)
        .with_contact(contact)
        .prescribe_velocity(&top, only(0), |time| {
            let mut velocity = [0.0; D];
            velocity[0] = load_velocity(time);
            velocity
        })
        .fix(&top, only(1))
        .fix(&on(0, 0.0)?, only(1))
        .fix(&on(0, LENGTH)?, only(1));
    if D == 3 {
        scene = scene.fix(&space.trace(|_| true)?, only(2));
    }
    let mut body: Simulation<D> = Simulation::new(scene, Newmark::default(), Condensed::new())?;
    let mut rows = Vec::new();
    body.run(&Steps::constant(STEP).count(STEPS), |at| {
        if at.step.is_multiple_of(100) {
            let place = |&vertex: &usize| {
                let x: SVector<f64, D> = space.mesh().vertices()[vertex];
                (x[0], at.displacement[vertex][0])
            };
            rows.push(bottom.vertices().iter().map(place).collect());
        }
    })?;
    Ok(rows)
}

/// A layer of tetrahedra between two planes, each cube of six around its diagonal. On displacements that do not depend
/// on the third coordinate their energy is that of the triangles; but each cube loads its near and its far corners
/// differently, which is where they differ: by the second order of the mesh.
#[test]
fn a_layer_of_tetrahedra_tends_to_the_plane_body_with_second_order() -> Outcome {
    let mut differences = Vec::new();
    for cells in [4, 8, 16] {
        let plane = history(&P1::grid([LENGTH, 1.0], [2 * cells, cells])?)?;
        let thickness = 1.0 / cells as f64;
        let space = P1::grid([LENGTH, 1.0, thickness], [2 * cells, cells, 1])?;
        let space = history(&space)?;
        let (mut largest, mut slid) = (0.0_f64, f64::INFINITY);
        for (plane, space) in plane.iter().zip(&space) {
            for (x, displacement) in space {
                let same = plane.iter().find(|(place, _)| place == x);
                let (_, expected) = same.ok_or("no such vertex in the plane")?;
                largest = largest.max((displacement - expected).abs());
            }
        }
        for (_, displacement) in plane.last().ok_or("no rows")? {
            slid = slid.min(*displacement);
        }
        assert!(slid > 1e-4, "{slid:e}");
        differences.push(largest / slid);
    }
    for pair in differences.windows(2) {
        let ratio = pair[0] / pair[1];
        assert!((3.6..4.4).contains(&ratio), "{ratio}: {differences:?}");
    }
    // A cell in 16, squared, is 4e-3.
    assert!(differences[2] < 4e-3, "{differences:?}");
    Ok(())
}

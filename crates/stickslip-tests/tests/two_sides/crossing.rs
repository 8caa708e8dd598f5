//! Two faults that cross, under uniform pressure: the normal stress is the pressure at each vertex, and nothing slips.

use stickslip::fem::{Elastic, GridDiagonal, Mesh, P1, elasticity};
use stickslip::friction::Tresca;
use stickslip::nalgebra::Vector2;
use stickslip::{
    BackwardEuler, BoundaryPart, Components, Condensed, Contact, NormalStress, Scene, Simulation,
};

use crate::Outcome;

#[test]
fn the_normal_stress_of_crossing_faults_is_the_pressure() -> Outcome {
    const PRESSURE: f64 = 3e6;
    let mesh = Mesh::<2>::grid([4.0, 4.0], [8, 8], GridDiagonal::Rising)?
        .with_surface_where("level", |x| x[1] == 2.0 && (x[0] - 2.0).abs() <= 1.0)?
        .with_surface_where("steep", |x| x[0] == 2.0 && (x[1] - 2.0).abs() <= 1.0)?
        .split_all(["level", "steep"])?;
    let space = P1::new(mesh);
    let mut load = vec![Vector2::zeros(); space.vertex_count()];
    for (axis, end, sign) in [(0, 0.0, 1.0), (0, 4.0, -1.0), (1, 0.0, 1.0), (1, 4.0, -1.0)] {
        let edge = space.trace(|x| x[axis] == end)?;
        for (&p, weight) in edge.vertices().iter().zip(edge.weights()) {
            load[p][axis] += sign * weight * PRESSURE;
        }
    }
    let corner = |x: f64| BoundaryPart {
        vertices: space.vertex_at([x, 0.0]).into_iter().collect(),
        ..BoundaryPart::point(1.0)
    };
    let rock = Elastic {
        young_modulus: 1e9,
        poisson_ratio: 0.25,
    };
    let mut scene = Scene::new(elasticity(&space, &rock)?)
        .with_load(load)
        .fix(corner(0.0), Components::ALL)
        .fix(corner(4.0), Components::Y);
    for name in ["level", "steep"] {
        let [plus, minus] = ["+", "-"].map(|side| space.part(&format!("{name}{side}")));
        let law = Tresca { coefficient: 0.5 };
        let contact = Contact::between(&plus?, &minus?, law, NormalStress::from_body(0.0));
        scene = scene.with_contact(contact);
    }
    let mut body = Simulation::new(scene, BackwardEuler, Condensed::new())?;
    body.step(1.0)?;
    let at = body.snapshot();
    for (index, area) in [(0, 1.5), (1, 1.5)] {
        let contact = at.contact(index);
        let mut total = 0.0;
        // One of the two copies where the faults cross has the area of both.
        for k in (0..contact.len()).filter(|&k| contact.weight(k) > 0.0) {
            let stress = contact.normal_stress(k);
            assert!(
                (stress / PRESSURE - 1.0).abs() < 1e-9,
                "{index}, {k}: {stress}"
            );
            assert!(contact.slip(k) < 1e-12);
            total += contact.weight(k);
        }
        // Without the halves of faces at the tips.
        assert!((total - area).abs() < 1e-12, "{total}");
    }
    Ok(())
}

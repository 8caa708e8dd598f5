//! A ring that is pressed onto a rigid shaft, and pulled off: normal stress from the body on a curved surface in space.

use nalgebra::Vector3;
use stickslip::fem::{Elastic, Mesh, P1, elasticity, traction};
use stickslip::friction::Tresca;
use stickslip::solvers::ConjugateGradients;
use stickslip::{
    Components, Condensed, Contact, GeneralizedAlpha, NormalStress, Scene, Simulation,
};

use crate::Outcome;

const INNER: f64 = 1.0;
const OUTER: f64 = 2.0;
const LENGTH: f64 = 0.5;
const COEFFICIENT: f64 = 0.2;

/// A quarter of the ring, of so many cells across; the pressure on its outside is 1.
fn pull_out_force(cells: usize) -> Outcome<f64> {
    let grid = Mesh::<3>::grid([1.0, 1.0, LENGTH], [cells, 2 * cells, cells.div_ceil(2)])?;
    let points = grid.vertices().iter().map(|x| {
        let (r, angle) = (
            INNER + (OUTER - INNER) * x[0],
            0.5 * std::f64::consts::PI * x[1],
        );
        // Exactly on the planes of symmetry.
        let [cos, sin] = match x[1] {
            0.0 => [1.0, 0.0],
            1.0 => [0.0, 1.0],
            _ => [angle.cos(), angle.sin()],
        };
        Vector3::new(r * cos, r * sin, x[2])
    });
    let points: Vec<_> = points.collect();
    let space = P1::new(Mesh::new(
        points,
        grid.cells().flatten().copied().collect(),
    )?);
    let radius = |x: &Vector3<f64>| x[0].hypot(x[1]);
    let shaft = space.trace(|x| (radius(x) - INNER).abs() < 1e-9)?;
    let outside = space.trace(|x| (radius(x) - OUTER).abs() < 1e-9)?;
    let pressure = traction(&space, &outside, |x: &Vector3<f64>| {
        Vector3::new(-x[0], -x[1], 0.0) / radius(x)
    })?;
    let law = Tresca {
        coefficient: COEFFICIENT,
    };
    let contact = Contact::new(&shaft, law, NormalStress::from_body(0.0));
    let elastic = Elastic {
        young_modulus: 1.0,
        poisson_ratio: 0.0,
    };
    let end = space.trace(|x| x[2] == LENGTH)?;
    let scene = Scene::new(elasticity(&space, &elastic)?)
        .fix(&space.trace(|x| x[1] == 0.0)?, Components::Y)
        .fix(&space.trace(|x| x[0] == 0.0)?, Components::X)
        .prescribe_velocity(&end, Components::Z, |_| [0.0, 0.0, 1.0])
        .with_load(pressure)
        .in_equilibrium(ConjugateGradients::default())
        .with_contact(contact);
    let mut ring = Simulation::new(scene, GeneralizedAlpha::default(), Condensed::new())?;
    // Far enough that all of it slides.
    for _ in 0..4 {
        ring.step(0.5)?;
    }
    let at = ring.snapshot();
    assert!((0..at.contact(0).len()).all(|k| at.contact(0).slip_rate(k) > 0.0));
    Ok(at.reaction(&end)?[2])
}

/// `mu p A` with the pressure of Lame's solution on a shaft that does not yield, without Poisson's effect:
/// `p = 2/(1 + (a/b)^2)` times the pressure outside; of second order in the size of cells.
#[test]
fn the_pull_out_force_is_that_of_the_pressure() -> Outcome {
    let pressure = 2.0 / (1.0 + (INNER / OUTER).powi(2));
    let area = 0.5 * std::f64::consts::PI * INNER * LENGTH;
    let exact = COEFFICIENT * pressure * area;
    let errors = [3, 6].map(|cells| pull_out_force(cells).map(|force| force / exact - 1.0));
    let [coarse, fine] = errors;
    let (coarse, fine) = (coarse?, fine?);
    assert!(coarse.abs() < 0.05, "{coarse:e}");
    assert!(fine.abs() < 0.35 * coarse.abs(), "{coarse:e} {fine:e}");
    Ok(())
}

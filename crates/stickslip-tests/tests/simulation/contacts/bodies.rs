//! Two bodies in one scene.

use nalgebra::Vector2;
use stickslip::fem::{Mesh, P1, antiplane, mass};
use stickslip::problems::pipping_slider::{AGING, FRICTION};
use stickslip::state::LogTheta;
use stickslip::{
    Components, Condensed, Contact, FixedPoint, Monolithic, Newmark, Scene, Simulation, Steps,
};

use crate::Outcome;
use crate::common::distance;

/// Bodies of 1 m^2 whose lower left corners lie there, with `2 n^2` cells each.
fn bodies(corners: &[f64], n: usize) -> Outcome<P1<2>> {
    let (mut points, mut cells) = (Vec::new(), Vec::new());
    for corner in corners {
        let first = points.len();
        for j in 0..=n {
            for i in 0..=n {
                let at = |k: usize| k as f64 / n as f64;
                points.push(Vector2::new(corner + at(i), at(j)));
            }
        }
        for j in 0..n {
            for i in 0..n {
                let at = |i: usize, j: usize| (first + j * (n + 1) + i) as u32;
                let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
                cells.extend([a, b, c, a, c, d]);
            }
        }
    }
    Ok(P1::new(Mesh::new(points, cells)?))
}

/// Bodies whose tops are pulled, each at a rate of its own [m/s], with contacts of different laws.
fn pulled(corners: &[f64], rates: &[f64], monolithic: bool) -> Outcome<Simulation<1>> {
    let space = bodies(corners, 4)?;
    let mut scene = Scene::new(antiplane(&space, 4e7)?).with_mass(mass(&space, 2e3)?);
    for (&corner, &rate) in corners.iter().zip(rates) {
        let within = move |x: f64| corner <= x && x <= corner + 1.0;
        let bottom = space.trace(|x| x[1] == 0.0 && within(x[0]))?;
        let top = space.trace(|x| x[1] == 1.0 && within(x[0]))?;
        let contact = Contact::new(&bottom, FRICTION, 1e4).with_state(AGING, LogTheta(corner));
        scene =
            scene
                .with_contact(contact)
                .prescribe_velocity(&top, Components::ALL, move |time| [rate * time]);
    }
    let body = Simulation::new(scene, Newmark::default(), Condensed::new())?;
    let body = if monolithic {
        body.with_coupling(Monolithic::default())
    } else {
        body.with_coupling(FixedPoint::default())
    };
    let mut body = body.with_absolute_tolerance(1e-14)?;
    body.run(&Steps::constant(2e-3).until(1.0), |_| ())?;
    assert!(body.snapshot().max_slip_rate() > 1e-5);
    Ok(body)
}

/// Two disjoint bodies in one scene are two scenes.
#[test]
fn two_bodies_in_one_scene_are_two_scenes() -> Outcome {
    let (corners, rates) = ([0.0, 3.0], [1e-3, 2e-3]);
    for monolithic in [true, false] {
        let both = pulled(&corners, &rates, monolithic)?;
        let both = both.snapshot();
        for k in 0..2 {
            let one = pulled(&corners[k..=k], &rates[k..=k], monolithic)?;
            let one = one.snapshot();
            let size = one.velocity.len();
            let part = k * size..(k + 1) * size;
            assert!(distance(&both.velocity[part.clone()], one.velocity) < 1e-12);
            assert!(distance(&both.displacement[part], one.displacement) < 1e-12 * 1e-3);
            let (here, there) = (both.contact(k), one.contact(0));
            for place in 0..there.len() {
                assert!((here.state(place) - there.state(place)).abs() < 1e-11);
            }
        }
    }
    Ok(())
}

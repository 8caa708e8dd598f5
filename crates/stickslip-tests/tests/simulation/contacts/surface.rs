//! Readings of a contact: tractions, forces, reactions; normal traction and shear stress.

use nalgebra::{SVector, Vector2};
use stickslip::fem::{P1, antiplane, elasticity, mass};
use stickslip::friction::{DieterichRuina, Tresca};
use stickslip::problems::pipping_slider::{
    AGING, FRICTION, INITIAL_LOG_THETA, NORMAL_STRESS, PippingSlider,
};
use stickslip::state::LogTheta;
use stickslip::{Components, Condensed, Contact, Newmark, Scene, Simulation, Steps};

use crate::Outcome;
use crate::common::body;

const COULOMB: Tresca = Tresca { coefficient: 0.6 };

/// A quasi-static body: what pulls it is what the contact bears, stuck, creeping or sliding.
#[test]
fn the_force_of_a_contact_balances_the_reaction_of_the_pull() -> Outcome {
    let space = body(2).space()?;
    let (bottom, top) = (
        PippingSlider::bottom(&space)?,
        space.trace(|x| x[1] == 1.0)?,
    );
    let start = LogTheta(INITIAL_LOG_THETA);
    // Strengthening in steady sliding, as a body without inertia needs it.
    let friction = DieterichRuina {
        b: 0.005,
        ..FRICTION
    };
    let scene = Scene::new(elasticity(&space, &body(2).elastic)?)
        .prescribe_velocity(&top, Components::X, |time| [1e-4 * time, 0.0])
        .with_contact(Contact::new(&bottom, friction, NORMAL_STRESS).with_state(AGING, start));
    let body = Simulation::new(scene, Newmark::default(), Condensed::new())?;
    let mut body = body.with_absolute_tolerance(1e-13)?;
    let (mut stuck, mut slid) = (false, false);
    body.run(&Steps::constant(0.1).until(20.0), |at| {
        let pull = at.reaction(&top).map_or(f64::NAN, |force| force[0]);
        let contact = at.contact(0);
        let force = contact.force()[0];
        assert!(
            (force - pull).abs() < 1e-6 * pull.abs(),
            "{}: {force}, {pull}",
            at.time
        );
        let strength: f64 = (0..contact.len())
            .map(|k| contact.strength(k) * contact.weight(k))
            .sum();
        // Where it creeps, a velocity known to 1e-13 m/s leaves the strength open: by `1e-3 a sigma` at 1e-10 m/s.
        assert!(force < strength * (1.0 + 1e-3), "{force}, {strength}");
        stuck |= contact.max_slip_rate() < 1e-15;
        slid |= contact.max_slip_rate() > 1e-4;
    })?;
    assert!(stuck && slid);
    Ok(())
}

/// Pressed from below, the top held up, the sides free: uniform compression in plane strain,
/// `u_y = sigma (1 - nu^2)/E` a metre.
#[test]
fn a_free_normal_is_pressed_by_the_normal_stress() -> Outcome {
    let space = P1::grid([2.0, 1.0], [4, 2])?;
    let elastic = body(1).elastic;
    let (bottom, top) = (space.trace(|x| x[1] == 0.0)?, space.trace(|x| x[1] == 1.0)?);
    let compliance = (1.0 - elastic.poisson_ratio.powi(2)) / elastic.young_modulus;
    let scene = Scene::new(elasticity(&space, &elastic)?)
        .fix(&top, Components::Y)
        .with_contact(
            Contact::new(&bottom, COULOMB, 0.0)
                .with_free_normal()
                .with_normal_stress_history(|time, stress| stress.fill(1e4 * time)),
        );
    // Without friction at zero normal stress nothing holds the body along x but the first vertex.
    let middle = space.trace(|x| x[0] == 0.0)?;
    let scene = scene.fix(&middle, Components::X);
    let mut body = Simulation::new(scene, Newmark::default(), Condensed::new())?;
    body.run(&Steps::constant(0.1).count(10), |at| {
        let contact = at.contact(0);
        for k in 0..contact.len() {
            let pressed = 1e4 * at.time;
            assert!((contact.normal_stress(k) - pressed).abs() < 1e-9);
            assert!(contact.traction(k)[0].abs() <= 0.6 * pressed * (1.0 + 1e-12));
        }
        let reaction = at.reaction(&top).map_or(f64::NAN, |force| force[1]);
        assert!((reaction + 2.0 * 1e4 * at.time).abs() < 1e-6, "{reaction}");
    })?;
    // Without friction the compression is uniform.
    let scene = Scene::new(elasticity(&space, &elastic)?)
        .fix(&top, Components::Y)
        .fix(&middle, Components::X)
        .with_contact(
            Contact::new(&bottom, Tresca { coefficient: 0.0 }, 0.0)
                .with_free_normal()
                .with_normal_stress_history(|time, stress| stress.fill(1e4 * time)),
        );
    let mut body = Simulation::new(scene, Newmark::default(), Condensed::new())?;
    // The trapezoidal rule follows a linear load exactly, from a velocity that is right; it starts from zero.
    body.run(&Steps::constant(0.1).count(10), |at| {
        for &vertex in bottom.vertices() {
            let expected = 1e4 * at.time * compliance;
            assert!((at.displacement[vertex][1] - expected).abs() < 1e-9 * expected);
        }
    })?;
    Ok(())
}

/// A shear stress that friction holds moves nothing and is the traction; where it exceeds the strength slip
/// begins, in its direction.
#[test]
fn shear_stress_is_held_or_drives() -> Outcome {
    let space = P1::grid([2.0, 1.0], [8, 4])?;
    let bottom = space.trace(|x| x[1] == 0.0)?;
    let run = |shear: Vec<SVector<f64, 1>>| -> Outcome<_> {
        let contact = Contact::new(&bottom, COULOMB, 1e5).with_shear_stress(shear);
        let scene = Scene::new(antiplane(&space, 1e9)?)
            .with_mass(mass(&space, 2e3)?)
            .with_contact(contact);
        let mut body = Simulation::new(scene, Newmark::default(), Condensed::new())?;
        body.run(&Steps::constant(1e-4).count(20), |_| ())?;
        Ok(body)
    };
    let points = bottom.points();
    let held = run(points
        .iter()
        .map(|x| SVector::from([5e4 + 5e3 * x[0]]))
        .collect())?;
    let at = held.snapshot();
    assert_eq!(at.max_slip_rate(), 0.0);
    for (k, x) in points.iter().enumerate() {
        assert_eq!(at.displacement[bottom.vertices()[k]][0], 0.0);
        let traction = at.contact(0).traction(k)[0];
        assert!((traction - (5e4 + 5e3 * x[0])).abs() < 1e-6, "{traction}");
    }
    let high = |x: &Vector2<f64>| (x[0] - 1.0).abs() < 0.1;
    let driven = run(points
        .iter()
        .map(|x| SVector::from([if high(x) { -8e4 } else { -1e4 }]))
        .collect())?;
    let at = driven.snapshot();
    for (k, x) in points.iter().enumerate() {
        let moved = at.contact(0).slip_vector(k)[0];
        assert!(if high(x) { moved < 0.0 } else { moved <= 0.0 });
    }
    Ok(())
}

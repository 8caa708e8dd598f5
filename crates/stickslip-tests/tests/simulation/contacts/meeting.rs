//! Contacts that meet fixed or driven parts, and one another.

use stickslip::fem::{P1, antiplane, elasticity};
use stickslip::friction::Tresca;
use stickslip::problems::pipping_slider::{AGING, FRICTION, INITIAL_LOG_THETA};
use stickslip::state::LogTheta;
use stickslip::{
    BackwardEuler, BoundaryPart, Components, Condensed, Contact, Newmark, Scene, Simulation, Steps,
};

use crate::Outcome;
use crate::common::{body, distance};

/// The whole side is a contact, up to the top that is moved along: there the slip rate is that of the top.
#[test]
fn a_contact_that_meets_the_moved_top_slides_with_it() -> Outcome {
    let space = body(1).space()?;
    let side = space.trace(|x| x[0] == 0.0)?;
    let top = space.trace(|x| x[1] == 1.0)?;
    let bottom = space.trace(|x| x[1] == 0.0)?;
    let corner = space.vertex_at([0.0, 1.0]).ok_or("no corner")?;
    let start = LogTheta(INITIAL_LOG_THETA);
    let scene = Scene::new(elasticity(&space, &body(1).elastic)?)
        .fix(&bottom, Components::ALL)
        .prescribe_velocity(&top, Components::Y, |time| [0.0, 1e-4 * time])
        .with_contact(Contact::new(&side, FRICTION, 1e5).with_state(AGING, start));
    let mut body = Simulation::new(scene, Newmark::default(), Condensed::new())?;
    body.run(&Steps::constant(0.01).until(1.0), |at| {
        let contact = at.contact(0);
        let k = contact.position_of(corner).unwrap_or(0);
        assert!((contact.slip_rate(k) - 1e-4 * at.time).abs() < 1e-18);
    })?;
    let at = body.snapshot();
    let contact = at.contact(0);
    let k = contact.position_of(corner).ok_or("not in contact")?;
    // The trapezoidal rule integrates a linear rate exactly.
    assert!((contact.slip(k) - 0.5e-4).abs() < 1e-15);
    let aged = contact.state(k);
    assert!(aged < 0.0 && aged.is_finite(), "{aged}");
    assert!(contact.traction(k)[1] > 0.0);
    // The foot is held.
    let foot = space.vertex_at([0.0, 0.0]).ok_or("no foot")?;
    let k = contact.position_of(foot).ok_or("not in contact")?;
    assert_eq!((contact.slip_rate(k), contact.slip(k)), (0.0, 0.0));
    Ok(())
}

/// In space one tangential component may be moved while friction decides on the other: the pull across is
/// resisted by what the motion along leaves of the strength.
#[test]
fn friction_across_a_prescribed_motion_is_what_is_left_of_the_strength() -> Outcome {
    let space = P1::<3>::grid([1.0, 1.0, 1.0], [1, 1, 1])?;
    let bottom = space.trace(|x| x[2] == 0.0)?;
    let top = space.trace(|x| x[2] == 1.0)?;
    let sliding = |along: f64| -> Outcome<[f64; 2]> {
        let scene = Scene::new(elasticity(&space, &body(1).elastic)?)
            .with_contact(Contact::new(&bottom, Tresca { coefficient: 0.6 }, 1e4))
            .prescribe_velocity(&bottom, Components::X, move |_| [along, 0.0, 0.0])
            .prescribe_velocity(&top, Components::ALL, move |_| [along, 1e-3, 0.0]);
        let mut body = Simulation::new(scene, BackwardEuler, Condensed::new())?;
        body.run(&Steps::constant(0.05).count(200), |_| ())?;
        let at = body.snapshot();
        let contact = at.contact(0);
        let force = contact.force();
        for k in 0..contact.len() {
            let v = contact.slip_velocity(k);
            assert_eq!(v[0], along);
            assert!((v[1] - 1e-3).abs() < 1e-9, "{v}");
        }
        Ok([force[0], force[1]])
    };
    for along in [0.0, 5e-4, 3e-3] {
        // Steady sliding of both components: the strength lies along the velocity.
        let rate = f64::hypot(along, 1e-3);
        let [x, y] = sliding(along)?;
        assert!((x - 0.6e4 * along / rate).abs() < 1e-3, "{x}");
        assert!((y - 0.6e4 * 1e-3 / rate).abs() < 1e-3, "{y}");
    }
    Ok(())
}

/// Where contacts meet their tractions add: halves of a surface equal the whole of it.
#[test]
fn two_contacts_that_meet_are_one() -> Outcome {
    let space = P1::grid([2.0, 1.0], [8, 4])?;
    let top = space.trace(|x| x[1] == 1.0)?;
    let run = |parts: Vec<BoundaryPart>| -> Outcome<_> {
        let mut scene =
            Scene::new(antiplane(&space, 4e7)?)
                .prescribe_velocity(&top, Components::ALL, |time| [1e-3 * time]);
        for part in parts {
            let contact = Contact::new(part, FRICTION, 1e4).with_cohesion(100.0);
            scene = scene.with_contact(contact.with_state(AGING, LogTheta(0.0)));
        }
        let body = Simulation::new(scene, Newmark::default(), Condensed::new())?;
        let mut body = body.with_absolute_tolerance(1e-14)?;
        body.run(&Steps::constant(2e-3).until(1.0), |_| ())?;
        let at = body.snapshot();
        let force: f64 = at.contacts().map(|contact| contact.force()[0]).sum();
        assert!(at.max_slip_rate() > 1e-5);
        Ok((at.displacement.to_vec(), force))
    };
    let whole = space.trace(|x| x[1] == 0.0)?;
    let left = space.trace(|x| x[1] == 0.0 && x[0] <= 1.0)?;
    let right = space.trace(|x| x[1] == 0.0 && x[0] >= 1.0)?;
    let (one, force) = run(vec![(&whole).into()])?;
    let (two, sum) = run(vec![(&left).into(), (&right).into()])?;
    assert!(distance(&one, &two) < 1e-12 * 1e-3);
    assert!((force - sum).abs() < 1e-9 * force, "{force}, {sum}");
    Ok(())
}

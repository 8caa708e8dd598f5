//! The motion of a body after friction has arrested its contact, under the default scheme.

use stickslip::fem::{P1, antiplane, mass};
use stickslip::friction::{RegularizedDieterichRuina, Tresca};
use stickslip::nalgebra::Vector1;
use stickslip::problems::pipping_slider::{AGING, FRICTION};
use stickslip::record::EnergyLedger;
use stickslip::state::LogTheta;
use stickslip::{
    BlockMatrix, Condensed, Contact, GeneralizedAlpha, Newmark, RateScheme, Scene, Simulation,
    Snapshot,
};

use crate::Outcome;

type Body = Simulation<1>;

/// A free body in antiplane motion at 0.05 m/s that friction alone stops.
fn sliding(
    contact: impl FnOnce(&stickslip::fem::Trace<2>) -> Scene<BlockMatrix<1>, 1>,
    space: &P1<2>,
    scheme: impl RateScheme + 'static,
) -> Outcome<Body> {
    let bottom = space.trace(|x| x[1] == 0.0)?;
    let scene = contact(&bottom)
        .with_mass(mass(space, 2e3)?)
        .with_velocity(vec![Vector1::new(0.05); space.vertex_count()]);
    Ok(Simulation::new(scene, scheme, Condensed::new())?)
}

fn largest_acceleration(at: Snapshot<'_, 1>) -> f64 {
    let contact = at.contact(0);
    let at_contact = (0..contact.len()).map(|k| at.acceleration[contact.vertex(k)][0].abs());
    at_contact.fold(0.0, f64::max)
}

/// Steps until no vertex of the contact has slipped for some steps.
fn arrest(body: &mut Body, dt: f64) -> Outcome {
    let mut still = 0;
    for _ in 0..100_000 {
        body.step(dt)?;
        still = if body.snapshot().max_slip_rate() == 0.0 {
            still + 1
        } else {
            0
        };
        if still == 20 {
            return Ok(());
        }
    }
    Err("the body is not arrested".into())
}

#[test]
fn accelerations_and_reactions_of_an_arrested_contact_decay() -> Outcome {
    let space = P1::grid([1.0, 0.5], [8, 4])?;
    for (modulus, coefficient, share) in [(1e9, 0.6, 0.1), (1e8, 0.3, 0.25), (1e10, 1.0, 0.05)] {
        let scene = |bottom: &_| {
            let contact = Contact::new(bottom, Tresca { coefficient }, 1e6);
            Ok::<_, stickslip::SceneError>(
                Scene::new(antiplane(&space, modulus)?).with_contact(contact),
            )
        };
        let bottom = space.trace(|x| x[1] == 0.0)?;
        let scene = scene(&bottom)?;
        let mut body = sliding(|_| scene, &space, GeneralizedAlpha::default())?;
        let dt = share * (1.0 / 8.0) / (modulus / 2e3_f64).sqrt();
        arrest(&mut body, dt)?;
        let before = largest_acceleration(body.snapshot());
        // The waves inside go on; what the contact has of them is their traction, without inertia.
        for _ in 0..125 {
            body.step(dt)?;
            if body.snapshot().max_slip_rate() > 0.0 {
                arrest(&mut body, dt)?;
            }
        }
        let after = largest_acceleration(body.snapshot());
        assert!(
            after <= 1e-10 * before,
            "{modulus:e}: {before:e}, {after:e}"
        );
    }
    Ok(())
}

#[test]
fn energy_without_work_hardly_exceeds_the_initial_one() -> Outcome {
    // Steps resolve the waves of an element. Of coarser ones the scheme exceeds it without friction, too, by 3e-3 at
    // `omega dt = 2` (tests of the crate of the schemes).
    let share = 0.1;
    let space = P1::grid([1.0, 0.5], [8, 4])?;
    for modulus in [1e8, 1e9, 1e10] {
        for tresca in [true, false] {
            {
                let scene = |bottom: &stickslip::fem::Trace<2>| {
                    let scene = Scene::new(antiplane(&space, modulus)?);
                    let law = RegularizedDieterichRuina::from(FRICTION);
                    Ok::<_, stickslip::SceneError>(if tresca {
                        let law = Tresca { coefficient: 0.6 };
                        scene.with_contact(Contact::new(bottom, law, 1e6))
                    } else {
                        let contact = Contact::new(bottom, law, 1e6);
                        scene.with_contact(contact.with_state(AGING, LogTheta(2.0)))
                    })
                };
                let bottom = space.trace(|x| x[1] == 0.0)?;
                let scene = scene(&bottom)?;
                let mut body = sliding(|_| scene, &space, GeneralizedAlpha::default())?;
                let dt = share * (1.0 / 8.0) / (modulus / 2e3_f64).sqrt();
                let energy = |body: &Body| {
                    let at = body.snapshot();
                    let balance = EnergyLedger::new(&at).balance(&at);
                    balance.kinetic + balance.elastic
                };
                let start = energy(&body);
                for _ in 0..500 {
                    body.step(dt)?;
                    let now = energy(&body);
                    assert!(now <= (1.0 + 1e-4) * start, "{modulus:e}, {share}: {now:e}");
                }
            }
        }
    }
    Ok(())
}

/// Until the first arrest: behind it Newmark's accelerations alternate, and so does what the ledger counts.
#[test]
fn the_ledger_closes_under_newmark_until_the_first_arrest() -> Outcome {
    let space = P1::grid([1.0, 0.5], [8, 4])?;
    for modulus in [1e8, 1e9, 1e10] {
        let bottom = space.trace(|x| x[1] == 0.0)?;
        let contact = Contact::new(&bottom, Tresca { coefficient: 0.6 }, 1e4);
        let scene = Scene::new(antiplane(&space, modulus)?).with_contact(contact);
        let mut body = sliding(|_| scene, &space, Newmark::default())?.with_tolerance(1e-13)?;
        let mut ledger = EnergyLedger::new(&body.snapshot());
        let start = ledger.balance(&body.snapshot());
        let dt = 0.1 * (1.0 / 8.0) / (modulus / 2e3_f64).sqrt();
        let mut steps = 0;
        loop {
            body.step(dt)?;
            let at = body.snapshot();
            let contact = at.contact(0);
            if (0..contact.len()).any(|k| contact.slip_rate(k) == 0.0) {
                break;
            }
            ledger.record(&at);
            let balance = ledger.balance(&at);
            let left = balance.left_over.abs();
            assert!(left <= 1e-12 * start.kinetic, "{modulus:e}: {balance:?}");
            steps += 1;
        }
        assert!(steps > 10, "{steps}");
    }
    Ok(())
}

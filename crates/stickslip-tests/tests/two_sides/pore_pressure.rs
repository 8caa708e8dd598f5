//! Pore pressure on faults inside a body whose normal stress comes from the deformation.

use nalgebra::Vector2;
use stickslip::fem::{Elastic, GridDiagonal, Mesh, P1, body_force, elasticity, mass};
use stickslip::fields::GivenPressure;
use stickslip::friction::Tresca;
use stickslip::{
    BlockMatrix, Cholesky, Components, Condensed, Contact, GeneralizedAlpha, NormalStress, Scene,
    SceneError, Simulation,
};

use crate::{Outcome, largest};

const WEIGHT: f64 = 1e5;
const PRESSURE: f64 = 2e4;

/// A fault in a block under its weight, pulled at its side: with a normal stress beside that of the body, and a pore
/// pressure that grows to its value at time 1.
fn scene(
    beside: f64,
    pressure: Option<f64>,
    (inertia, opens): (bool, bool),
) -> Outcome<Scene<BlockMatrix<2>, 2>> {
    let mesh = Mesh::<2>::grid([2.0, 1.0], [6, 4], GridDiagonal::Rising)?
        .with_surface_where("fault", |x| x[1] == 0.5)?
        .split("fault")?;
    let space = P1::new(mesh);
    let elastic = Elastic {
        young_modulus: 3e7,
        poisson_ratio: 0.3,
    };
    let sides = (space.part("fault+")?, space.part("fault-")?);
    let count = sides.0.vertices().len();
    let law = Tresca { coefficient: 0.1 };
    let mut contact = Contact::between(&sides.0, &sides.1, law, NormalStress::from_body(beside));
    if let Some(pressure) = pressure {
        let shares = move |time: f64, own: &mut [f64]| {
            for (k, own) in own.iter_mut().enumerate() {
                *own += pressure * time * (1.0 + 0.1 * k as f64);
            }
        };
        contact = contact.with_field(GivenPressure::new(count, 0.0, shares));
    }
    if opens {
        contact = contact.allow_opening();
    }
    let scene = Scene::new(elasticity(&space, &elastic)?)
        .with_load(body_force(&space, |_| Vector2::new(0.3 * WEIGHT, -WEIGHT)))
        .in_equilibrium(Cholesky::new())
        .fix(&space.trace(|x| x[1] == 0.0)?, Components::ALL)
        .prescribe_velocity(
            &space.trace(|x| x[0] == 2.0 && x[1] > 0.6)?,
            Components::X,
            |time| [3e-3 * time, 0.0],
        )
        .with_contact(contact);
    Ok(if inertia {
        scene.with_mass(mass(&space, 2e3)?)
    } else {
        scene
    })
}

/// Without friction the pressure moves nothing: the total normal stress is that of the body, whatever the pressure.
/// With friction the effective one is less by the pressure, at every step.
#[test]
fn the_effective_normal_stress_is_that_of_the_body_less_the_pressure() -> Outcome {
    for inertia in [false, true] {
        let scheme = GeneralizedAlpha::default;
        let with = scene(3e4, Some(PRESSURE), (inertia, false))?;
        let mut with = Simulation::new(with, scheme(), Condensed::new())?.with_tolerance(1e-12)?;
        let mut slid = 0.0_f64;
        for _ in 0..20 {
            with.step(0.05)?;
            let at = with.snapshot();
            let contact = at.contact(0);
            // The total normal stress, by the reaction of the body on the minus side.
            for k in 0..contact.len() {
                let pressure = PRESSURE * at.time * (1.0 + 0.1 * k as f64);
                assert!((contact.pore_pressure(k) - pressure).abs() < 1e-9 * PRESSURE);
                let sum = contact.effective_normal_stress(k) + pressure;
                assert!((contact.normal_stress(k) / sum - 1.0).abs() < 1e-12);
                let reaction = at.reaction_at(contact.vertex(k))?;
                let normal = (reaction[1] / contact.weight(k)).abs();
                let body = contact.normal_stress(k) - 3e4;
                assert!(
                    (normal - body).abs() < 1e-6 * WEIGHT,
                    "{k}: {normal} {body}"
                );
                let strength = 0.1 * contact.effective_normal_stress(k);
                assert!((contact.strength(k) / strength - 1.0).abs() < 1e-12);
                slid = slid.max(contact.slip(k));
            }
        }
        assert!(slid > 0.0);
        // Less friction slips farther.
        let without = scene(3e4, None, (inertia, false))?;
        let mut without = Simulation::new(without, scheme(), Condensed::new())?;
        (0..20).try_for_each(|_| without.step(0.05).map(drop))?;
        let [a, b] = [&with, &without].map(|own| largest(own.snapshot().velocity.iter().copied()));
        assert!(a > b, "{a} {b}");
    }
    Ok(())
}

/// Sides that part under pressure are another problem: refused.
#[test]
fn pressure_on_sides_that_part_is_refused() -> Outcome {
    let scene = scene(3e4, Some(PRESSURE), (false, true))?;
    let refused = Simulation::new(scene, GeneralizedAlpha::default(), Condensed::new()).err();
    let told = matches!(refused, Some(SceneError::Unsupported { .. }));
    assert!(told, "{refused:?}");
    Ok(())
}

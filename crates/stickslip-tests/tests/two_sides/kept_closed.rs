//! Vertices of contacts that can open, kept closed by others that meet them.

use stickslip::fem::{Elastic, P1, elasticity};
use stickslip::friction::Tresca;
use stickslip::{
    Components, Condensed, Contact, GeneralizedAlpha, NormalStress, Scene, Simulation, StepError,
    Steps,
};

use crate::Outcome;
use crate::random_block::{Block, Random};

/// Where one of two contacts that meet must not open, and where they meet at a corner, the common vertex stays closed:
/// its tension is refused.
#[test]
fn a_vertex_that_not_all_contacts_open_refuses_tension() -> Outcome {
    for seed in 0..10 {
        let random = &mut Random(3000 + seed);
        let mut block = Block::<2>::new(random, |_| true)?;
        if block.feet.len() < 2 {
            continue;
        }
        let stress = 1e-4 * block.modulus();
        // That of the second contact is never used up.
        for (index, (_, own)) in block.feet.iter_mut().enumerate() {
            *own = if index == 0 { stress } else { 1e3 * stress };
        }
        let height = block.height;
        let mut body = block.simulation(|index| index == 0, move |_| [0.0, 1e-3 * height])?;
        let common = *block.feet[0]
            .0
            .vertices()
            .iter()
            .find(|p| block.feet[1].0.vertices().contains(p))
            .ok_or("met")?;
        let failure = body
            .run(&Steps::constant(0.02).until(1.0), |_| ())
            .err()
            .ok_or("refused")?;
        assert!(
            matches!(failure.cause, StepError::Tension { vertex, normal_stress } if vertex == common && normal_stress < 0.0),
            "{failure}"
        );
    }
    let space = P1::<2>::grid([1.0, 1.0], [4, 4])?;
    let corner = space.trace(|x| x[0] == 0.0)?.vertices()[0];
    let mut scene = Scene::new(elasticity(
        &space,
        &Elastic {
            young_modulus: 1e7,
            poisson_ratio: 0.2,
        },
    )?)
    .prescribe_velocity(&space.trace(|x| x[0] == 1.0)?, Components::ALL, |_| {
        [1e-3; 2]
    });
    for axis in 0..2 {
        let wall = space.trace(|x| x[axis] == 0.0)?;
        let law = Tresca { coefficient: 0.1 };
        let contact = Contact::new(&wall, law, NormalStress::from_body(1e2));
        scene = scene.with_contact(contact.allow_opening());
    }
    let mut body = Simulation::new(scene, GeneralizedAlpha::default(), Condensed::new())?;
    let failure = body
        .run(&Steps::constant(0.1).until(1.0), |_| ())
        .err()
        .ok_or("refused")?;
    assert!(
        matches!(failure.cause, StepError::Tension { vertex, .. } if vertex == corner),
        "{failure}"
    );
    Ok(())
}

//! A body whose contact is pulled on a part of it: refused with the vertex, or open there.

use nalgebra::SVector;
use stickslip::fem::{P1, elasticity};
use stickslip::friction::Tresca;
use stickslip::problems::pipping_slider::PippingSlider;
use stickslip::{BackwardEuler, BlockMatrix, Condensed, Contact, Scene, SceneError, Simulation};

use crate::Outcome;

const PRESSED: f64 = 1e5;
const PULLED: f64 = -1e4;

/// A box on friction, pressed on one half of its bottom and pulled on the other, whose top is moved.
fn check<const D: usize>() -> Outcome {
    let space = P1::<D>::grid([1.0; D], [2; D])?;
    let bottom = space.trace(|x| x[D - 1] == 0.0)?;
    let top = space.trace(|x| x[D - 1] == 1.0)?;
    let stresses = bottom.map(|x| if x[0] > 0.6 { PULLED } else { PRESSED });
    let contact = || Contact::new(&bottom, Tresca { coefficient: 0.5 }, stresses.clone());
    let scene = |contact: Contact<Tresca, (), D>| -> Outcome<Scene<BlockMatrix<D>, D>> {
        let pull = std::array::from_fn(|c| if c == 0 { 1e-3 } else { 0.0 });
        Ok(
            Scene::new(elasticity(&space, &PippingSlider::default().elastic)?)
                .with_contact(contact)
                .prescribe_velocity(&top, [true; D], move |_| pull),
        )
    };
    let refused = Simulation::new(scene(contact())?, BackwardEuler, Condensed::new()).err();
    let Some(SceneError::Value {
        position, value, ..
    }) = refused
    else {
        return Err(format!("{refused:?}").into());
    };
    assert!(
        value == PULLED && stresses[position] == PULLED,
        "{position}"
    );
    let mut body = Simulation::new(
        scene(contact().allow_opening())?,
        BackwardEuler,
        Condensed::new(),
    )?;
    for _ in 0..40 {
        body.step(0.1)?;
        let at = body.snapshot();
        let contact = at.contact(0);
        let mut force = SVector::<f64, D>::zeros();
        for (k, &stress) in stresses.iter().enumerate() {
            let traction = contact.traction(k);
            force += traction * bottom.weights()[k];
            let strength = 0.5 * stress.max(0.0);
            assert!(
                traction.norm() <= strength * (1.0 + 1e-9),
                "{k}: {traction}"
            );
        }
        // What friction takes up the top is pulled with.
        let pull = at.reaction(&top)?[0];
        assert!(
            (pull - force[0]).abs() < 1e-7 * pull.abs(),
            "{pull} {force}"
        );
    }
    // All that is pressed slides.
    assert!(body.snapshot().max_slip_rate() > 0.0);
    Ok(())
}

#[test]
fn what_is_pulled_is_open_in_the_plane_and_in_space() -> Outcome {
    check::<2>()?;
    check::<3>()
}

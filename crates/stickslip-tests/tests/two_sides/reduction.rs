//! A body that is reduced to the jump of its fault moves as the whole one.

use stickslip::fem::{elasticity, mass};
use stickslip::problems::pipping_slider::{
    AGING, END, FRICTION, INITIAL_LOG_THETA, NORMAL_STRESS, PippingSlider, load_velocity,
};
use stickslip::reduced::Reduced;
use stickslip::state::LogTheta;
use stickslip::{
    BlockMatrix, Components, Condensed, Contact, DenseNewton, Newmark, Scene, Simulation, Steps,
};

use crate::{Outcome, largest, mirrored};

/// The lower block held at its bottom, the upper one driven at its top; with or without inertia.
fn scene(inertia: bool) -> Outcome<Scene<BlockMatrix<2>, 2>> {
    let space = mirrored(2)?;
    let paper = PippingSlider::default();
    let [top, bottom] = [1.0, -1.0].map(|y| space.trace(move |x| x[1] == y));
    let [plus, minus] = ["plus", "minus"].map(|side| space.part(side));
    let contact = Contact::between(&plus?, &minus?, FRICTION, NORMAL_STRESS)
        .with_state(AGING, LogTheta(INITIAL_LOG_THETA));
    let scene = Scene::new(elasticity(&space, &paper.elastic)?)
        .prescribe_velocity(&top?, Components::ALL, |time| {
            [10.0 * load_velocity(time), 0.0]
        })
        .fix(&bottom?, Components::ALL)
        .with_contact(contact);
    Ok(if inertia {
        scene
            .with_mass(mass(&space, paper.density)?)
            .with_zero_acceleration()
    } else {
        scene
    })
}

/// With all of the modes the reduction is a change of unknowns.
#[test]
fn all_modes_are_the_whole_body() -> Outcome {
    let body = Reduced::new(&scene(true)?).up_to_frequency(1e9)?;
    let reduced = body.reduce(scene(true)?)?;
    let mut whole = Simulation::new(scene(true)?, Newmark::default(), Condensed::new())?;
    let mut small = Simulation::new(reduced, Newmark::default(), DenseNewton::new())?;
    let steps = Steps::constant(END / 1e4).count(3000);
    let mut peak = 0.0_f64;
    whole.run(&steps, |at| peak = peak.max(at.max_slip_rate()))?;
    small.run(&steps, |_| ())?;
    assert!(peak > 1e-3, "no event: {peak:e}");
    let (one, other) = (whole.snapshot(), small.snapshot());
    let (fault, jump) = (one.contact(0), other.contact(0));
    let scale = largest((0..fault.len()).map(|k| fault.slip_vector(k)));
    let apart = (0..fault.len()).map(|k| fault.slip_vector(k) - jump.slip_vector(k));
    assert!(largest(apart) < 1e-6 * scale);
    let recovered = body.displacement(&other)?;
    let apart = one.displacement.iter().zip(&recovered).map(|(a, b)| a - b);
    assert!(largest(apart) < 1e-6 * largest(one.displacement.iter().copied()));
    Ok(())
}

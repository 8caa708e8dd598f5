//! Antiplane shear: a layer against its mirror image moves as its half.

use nalgebra::SVector;
use stickslip::fem::{P1, antiplane, mass};
use stickslip::friction::DieterichRuina;
use stickslip::problems::pipping_slider::{AGING, FRICTION, INITIAL_LOG_THETA, NORMAL_STRESS};
use stickslip::state::{Dieterich, LogTheta};
use stickslip::{
    BlockMatrix, Components, Condensed, Contact, Newmark, NonsmoothSolver, Scene, Simulation, Tnnmg,
};

use crate::{Outcome, mirrored};

/// Moduli of the slider's material.
const SHEAR_MODULUS: f64 = 2e7;
const DENSITY: f64 = 5e3;
const STEP: f64 = 2e-3;
/// Through the first event.
const STEPS: usize = 5_200;

/// The body with its top driven, faster in its middle.
fn driven(space: &P1<2>) -> Outcome<Scene<BlockMatrix<1>, 1>> {
    let top = space.trace(|x| x[1] == 1.0)?;
    Ok(Scene::new(antiplane(space, SHEAR_MODULUS)?)
        .with_mass(mass(space, DENSITY)?)
        .with_zero_acceleration()
        .prescribe_velocity(&top, Components::ALL, |time| [2e-4 * time.min(1.0)]))
}

fn simulation(
    scene: Scene<BlockMatrix<1>, 1>,
    space: &P1<2>,
    multigrid: bool,
) -> Outcome<Simulation<1>> {
    let solver: Box<dyn NonsmoothSolver<BlockMatrix<1>, 1>> = if multigrid {
        Box::new(Tnnmg::new(space.transfers()))
    } else {
        Box::new(Condensed::new())
    };
    Ok(Simulation::new(scene, Newmark::default(), solver)?.with_tolerance(1e-12)?)
}

#[test]
fn a_layer_against_its_image_is_its_half() -> Outcome {
    let twice = |friction: DieterichRuina| DieterichRuina {
        reference_velocity: 2.0 * friction.reference_velocity,
        slip_distance: 2.0 * friction.slip_distance,
        ..friction
    };
    for multigrid in [false, true] {
        let space = P1::grid([5.0, 1.0], [5, 1])?.refined(2)?;
        // Strength that varies along the fault.
        let strength = |x: &SVector<f64, 2>| NORMAL_STRESS * (1.0 + 0.2 * (0.5 * x[0]).sin());
        let bottom = space.trace(|x| x[1] == 0.0)?;
        let stresses = bottom
            .vertices()
            .iter()
            .map(|&p| strength(&space.mesh().vertices()[p]));
        let contact = Contact::new(&bottom, FRICTION, stresses.collect::<Vec<_>>())
            .with_state(AGING, LogTheta(INITIAL_LOG_THETA));
        let mut half = simulation(driven(&space)?.with_contact(contact), &space, multigrid)?;

        let space = mirrored(2)?;
        let below = space.trace(|x| x[1] == -1.0)?;
        let [plus, minus] = ["plus", "minus"].map(|side| space.part(side));
        let plus = plus?;
        let stresses = plus
            .vertices()
            .iter()
            .map(|&p| strength(&space.mesh().vertices()[p]));
        let friction = twice(FRICTION);
        let aging = Dieterich {
            slip_distance: friction.slip_distance,
        };
        let contact = Contact::between(&plus, &minus?, friction, stresses.collect::<Vec<_>>())
            .with_state(aging, LogTheta(INITIAL_LOG_THETA));
        let scene = (driven(&space)?)
            .prescribe_velocity(&below, Components::ALL, |time| [-2e-4 * time.min(1.0)])
            .with_contact(contact);
        let mut whole = simulation(scene, &space, multigrid)?;

        let (mut apart, mut scale) = (0.0_f64, 0.0_f64);
        let (mut slip, mut most, mut state) = (0.0_f64, 0.0_f64, 0.0_f64);
        for _ in 0..STEPS {
            half.step(STEP)?;
            whole.step(STEP)?;
            let (one, two) = (half.snapshot(), whole.snapshot());
            let (one, two) = (one.contact(0), two.contact(0));
            for k in 0..one.len() {
                let difference = 2.0 * one.slip_velocity(k) - two.slip_velocity(k);
                apart = apart.max(difference[0].abs());
                scale = scale.max(one.slip_rate(k));
                most = most.max(two.slip_vector(k)[0].abs());
                slip = slip.max((2.0 * one.slip_vector(k) - two.slip_vector(k))[0].abs());
                state = state.max((one.state(k) - two.state(k)).abs());
            }
        }
        assert!(scale > 1e-3, "no event: {scale:e}");
        assert!(
            apart < 1e-9 * scale && slip < 1e-9 * most && state < 1e-9,
            "{apart:e} {slip:e} {state:e}"
        );
    }
    Ok(())
}

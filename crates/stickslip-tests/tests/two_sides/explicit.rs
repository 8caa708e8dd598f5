//! Central differences with a lumped mass: pairs are blocks of their own.

use stickslip::fem::{P1, elasticity, element_stiffness, lumped_mass};
use stickslip::problems::pipping_slider::{
    AGING, FRICTION, INITIAL_LOG_THETA, NORMAL_STRESS, PippingSlider, load_velocity,
};
use stickslip::solvers::IntoOperator;
use stickslip::state::LogTheta;
use stickslip::{
    BlockMatrix, CentralDifferences, Components, Condensed, Contact, Diagonal, NonsmoothSolver,
    NormalStress, Scene, Simulation, Staggered, StateUpdate, Steps,
};

use crate::{Outcome, largest, mirrored};

fn explicit(
    normal_stress: NormalStress,
    solver: Box<dyn NonsmoothSolver<BlockMatrix<2>, 2>>,
) -> Outcome<Simulation<2>> {
    let space = mirrored(2)?;
    let stiffness = elasticity(&space, &PippingSlider::default().elastic)?;
    with_stiffness(&space, stiffness, normal_stress, false, solver)
}

fn with_stiffness<S>(
    space: &P1<2>,
    stiffness: S,
    normal_stress: NormalStress,
    opens: bool,
    solver: Box<dyn NonsmoothSolver<S::Operator, 2>>,
) -> Outcome<Simulation<2>>
where
    S: IntoOperator<2, Operator: From<BlockMatrix<2>>>,
{
    let paper = PippingSlider::default();
    let [top, bottom] = [1.0, -1.0].map(|y| space.trace(move |x| x[1] == y));
    let contact = Contact::between(
        &space.part("plus")?,
        &space.part("minus")?,
        FRICTION,
        normal_stress,
    )
    .with_state(AGING, LogTheta(INITIAL_LOG_THETA));
    let contact = if opens {
        contact.allow_opening()
    } else {
        contact
    };
    let scene = Scene::new(stiffness)
        .with_mass(lumped_mass(space, paper.density)?)
        .prescribe_velocity(&top?, Components::ALL, |time| {
            [10.0 * load_velocity(time), 0.0]
        })
        .fix(&bottom?, Components::ALL)
        .with_contact(contact);
    Ok(Simulation::new(scene, CentralDifferences, solver)?
        .with_coupling(Staggered::default())
        .with_state_update(StateUpdate::Midpoint))
}

/// One block after the other is as good as a factorisation of all, through an event, and with the reaction of the body
/// known before the velocity, a second solution confirms it.
#[test]
fn pairs_are_solved_one_by_one() -> Outcome {
    for from_body in [false, true] {
        let stress = if from_body {
            NormalStress::from_body(NORMAL_STRESS)
        } else {
            NORMAL_STRESS.into()
        };
        let mut pairs = explicit(stress.clone(), Box::new(Diagonal::new()))?;
        let mut whole = explicit(stress, Box::new(Condensed::new()))?;
        let steps = Steps::constant(2e-4).until(4.5);
        let (mut peak, mut iterations) = (0.0_f64, 0);
        pairs.run(&steps, |at| {
            peak = peak.max(at.max_slip_rate());
            iterations = iterations.max(at.report.reaction_iterations);
        })?;
        whole.run(&steps, |_| ())?;
        assert!(peak > 1e-3, "no event: {peak:e}");
        assert!(iterations <= 2);
        let (one, other) = (pairs.snapshot(), whole.snapshot());
        let apart = one
            .displacement
            .iter()
            .zip(other.displacement)
            .map(|(a, b)| a - b);
        let scale = largest(other.displacement.iter().copied());
        assert!(largest(apart) < 1e-6 * scale, "{from_body}");
    }
    Ok(())
}

/// Both sides of a fault by elements, which knows jumps as the matrix does, closed and with walls that part.
#[test]
fn sides_by_elements_move_as_those_of_a_matrix() -> Outcome {
    let stresses = [
        (NORMAL_STRESS.into(), false),
        (NormalStress::from_body(NORMAL_STRESS), false),
        (NormalStress::from_body(NORMAL_STRESS), true),
    ];
    for (k, (stress, opens)) in stresses.into_iter().enumerate() {
        let space = mirrored(2)?;
        let elements = element_stiffness(&space, &PippingSlider::default().elastic)?;
        let mut own = with_stiffness(
            &space,
            elements,
            stress.clone(),
            opens,
            Box::new(Diagonal::new()),
        )?;
        let matrix = elasticity(&space, &PippingSlider::default().elastic)?;
        let mut whole = with_stiffness(&space, matrix, stress, opens, Box::new(Diagonal::new()))?;
        let steps = Steps::constant(2e-4).count(2000);
        own.run(&steps, |_| ())?;
        whole.run(&steps, |_| ())?;
        let (one, other) = (own.snapshot(), whole.snapshot());
        let apart = (one.displacement.iter().zip(other.displacement)).map(|(a, b)| a - b);
        let scale = largest(other.displacement.iter().copied());
        let apart = largest(apart);
        assert!(
            apart < 1e-9 * scale && scale > 0.0,
            "{k}: {apart:e}, {scale:e}"
        );
    }
    Ok(())
}

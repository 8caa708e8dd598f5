//! States of another scene.

use nalgebra::SMatrix;
use stickslip::integrate::Stepper;
use stickslip::problems::pipping_slider::PippingSlider;
use stickslip::{
    Contact, GeneralizedAlpha, Newmark, Point, RungeKutta, SceneError, Sdirk2, Simulation,
    StepState, Tnnmg,
};

use super::{COULOMB, aging, coulomb, free_spring, one_line, spring};
use crate::Outcome;
use crate::common::{Solver, bits, body, paper_slider};

type Spring = Simulation<1>;

/// The mismatch as the error names it; nothing of the state is taken over.
fn foreign<const C: usize>(
    stepper: &mut dyn Stepper<C>,
    state: &StepState<C>,
) -> Outcome<(&'static str, usize, usize)> {
    let before = stepper.snapshot().state().clone();
    let error = stepper.restore(state).err().ok_or("restored")?;
    assert_eq!(stepper.snapshot().state(), &before);
    match one_line(error)? {
        SceneError::Length {
            what,
            expected,
            found,
        } => Ok((what, expected, found)),
        other => Err(other.into()),
    }
}

/// Accelerations, algorithmic accelerations of a scheme, contacts, states.
const KINDS: [&str; 4] = ["accelerations", "algorithmic numbers", "contacts", "states"];

/// Springs that differ in how many there are of each kind. Where no friction grows with the rate a scheme without inertia
/// damps, by an algorithmic acceleration.
fn springs() -> Result<[([usize; 4], Spring); 5], SceneError> {
    let heavy = || spring().with_mass(SMatrix::from([[2.0]]));
    let newmark = Newmark::default();
    let damping = GeneralizedAlpha {
        spectral_radius: 0.5,
    };
    let twice = spring().with_contact(coulomb());
    let stateful = free_spring().with_contact(aging());
    Ok([
        ([0, 1, 1, 0], Simulation::new(spring(), newmark, Point)?),
        ([1, 0, 1, 0], Simulation::new(heavy(), newmark, Point)?),
        ([1, 1, 1, 0], Simulation::new(heavy(), damping, Point)?),
        ([0, 1, 2, 0], Simulation::new(twice, newmark, Point)?),
        ([0, 0, 1, 1], Simulation::new(stateful, newmark, Point)?),
    ])
}

/// The first kind of which there are more or fewer is named with its numbers.
#[test]
fn states_of_another_scene_are_named() -> Outcome {
    let mut springs = springs()?;
    let states = (springs.each_ref()).map(|(counts, spring)| (*counts, spring.state().clone()));
    for (expected, spring) in &mut springs {
        for (found, state) in &states {
            match (0..4).find(|&kind| found[kind] != expected[kind]) {
                None => spring.restore(state)?,
                Some(kind) => assert_eq!(
                    foreign(spring, state)?,
                    (KINDS[kind], expected[kind], found[kind])
                ),
            }
        }
        spring.step(0.1)?;
    }
    Ok(())
}

/// An explicit method refuses the same.
#[test]
fn an_explicit_method_names_states_of_another_scene() -> Outcome {
    // Coulomb friction has a slip rate by viscosity alone.
    let damped = || spring().with_viscosity(SMatrix::from([[1e3]]));
    let mut plain = RungeKutta::new(damped())?;
    let stateful = RungeKutta::new(free_spring().with_contact(aging()))?;
    let state = stateful.snapshot().state().clone();
    assert_eq!(foreign(&mut plain, &state)?, ("states", 0, 1));
    let state = Simulation::new(damped(), Sdirk2, Point)?.state().clone();
    plain.restore(&state)?;
    Ok(())
}

#[test]
fn states_of_another_mesh_are_named() -> Outcome {
    let (coarse, fine) = (body(1).space()?, body(2).space()?);
    let mut slider = paper_slider(&body(1), &coarse, Solver::Tnnmg, 1e-10)?;
    let other = paper_slider(&body(2), &fine, Solver::Tnnmg, 1e-10)?;
    let (expected, found) = (coarse.vertex_count(), fine.vertex_count());
    assert_eq!(
        foreign(&mut slider, other.state())?,
        ("displacements", expected, found)
    );
    // The same body with another contact.
    let part = coarse.trace(|x| x[1] == 0.0 && x[0] <= 2.5)?;
    let contact = Contact::new(&part, COULOMB, 1e5);
    let scene = body(1).scene(&coarse)?.with_contact(contact);
    let solver = Tnnmg::new(coarse.hierarchy().prolongations());
    let other = Simulation::new(scene, Newmark::default(), solver)?;
    let count = PippingSlider::bottom(&coarse)?.vertices().len();
    assert_eq!(foreign(&mut slider, other.state())?, ("states", count, 0));
    Ok(())
}

/// A state that was refused leaves no trace in the steps that follow.
#[test]
fn a_refused_state_leaves_no_trace() -> Outcome {
    let (coarse, fine) = (body(1).space()?, body(2).space()?);
    let mut disturbed = paper_slider(&body(1), &coarse, Solver::Tnnmg, 1e-10)?;
    let mut calm = paper_slider(&body(1), &coarse, Solver::Tnnmg, 1e-10)?;
    let other = paper_slider(&body(2), &fine, Solver::Tnnmg, 1e-10)?;
    for _ in 0..20 {
        assert!(disturbed.restore(other.state()).is_err());
        assert_eq!(disturbed.step(0.05)?, calm.step(0.05)?);
        assert_eq!(bits(&disturbed.snapshot()), bits(&calm.snapshot()));
    }
    Ok(())
}

//! The cost of multigrid with jumps as unknowns.

use nalgebra::SVector;
use stickslip::fem::{P1, elasticity, mass};
use stickslip::friction::{DieterichRuina, Tresca};
use stickslip::problems::pipping_slider::{
    AGING, END, FRICTION, INITIAL_LOG_THETA, NORMAL_STRESS, PippingSlider, load_velocity,
};
use stickslip::state::{Dieterich, LogTheta};
use stickslip::{
    BlockMatrix, Components, Contact, GeneralizedAlpha, Newmark, Scene, Simulation, Steps, Tnnmg,
};

use crate::{ELASTIC, Outcome, mirrored, square};

/// Cycles of the steps until 3 s, in which the body comes into sliding.
fn cycles(space: &P1<2>, scene: Scene<BlockMatrix<2>, 2>) -> Outcome<usize> {
    let mut body = Simulation::new(scene, Newmark::default(), Tnnmg::new(space.transfers()))?;
    let mut cycles = 0;
    body.run(&Steps::constant(END / 1e4).count(400), |at| {
        cycles += at.report.solver_iterations;
    })?;
    Ok(cycles)
}

fn driven(space: &P1<2>) -> Outcome<Scene<BlockMatrix<2>, 2>> {
    let paper = PippingSlider::default();
    let top = space
        .mesh()
        .vertices()
        .iter()
        .map(|x| x[1])
        .fold(0.0, f64::max);
    let top = space.trace(|x| x[1] == top)?;
    Ok(Scene::new(elasticity(space, &paper.elastic)?)
        .with_mass(mass(space, paper.density)?)
        .prescribe_velocity(&top, Components::ALL, |time| [load_velocity(time), 0.0]))
}

/// A body against its image takes the cycles of one with as many unknowns on a rigid surface: jump and mean do not
/// couple at a pair, so that the steps of the smoother along a jump are those of one side.
#[test]
fn two_sides_take_the_cycles_of_one() -> Outcome {
    for refinements in [2, 3] {
        let space = P1::grid([5.0, 2.0], [5, 2])?.refined(refinements)?;
        let contact = Contact::new(&space.trace(|x| x[1] == 0.0)?, FRICTION, NORMAL_STRESS)
            .with_state(AGING, LogTheta(INITIAL_LOG_THETA));
        let one = cycles(&space, driven(&space)?.with_contact(contact))?;

        let space = mirrored(refinements)?;
        let friction = DieterichRuina {
            reference_velocity: 2.0 * FRICTION.reference_velocity,
            slip_distance: 2.0 * FRICTION.slip_distance,
            ..FRICTION
        };
        let aging = Dieterich {
            slip_distance: friction.slip_distance,
        };
        let [plus, minus] = ["plus", "minus"].map(|side| space.part(side));
        let contact = Contact::between(&plus?, &minus?, friction, NORMAL_STRESS)
            .with_state(aging, LogTheta(INITIAL_LOG_THETA));
        let bottom = space.trace(|x| x[1] == -1.0)?;
        let scene = (driven(&space)?)
            .prescribe_velocity(&bottom, Components::ALL, |time| [-load_velocity(time), 0.0])
            .with_contact(contact);
        let two = cycles(&space, scene)?;
        assert!(5 * two <= 6 * one, "{two} cycles beside {one}");
    }
    Ok(())
}

/// The square held at its bottom and sheared at its top.
fn sheared(space: &P1<2>) -> Outcome<Scene<BlockMatrix<2>, 2>> {
    let mut load = vec![SVector::<f64, 2>::zeros(); space.vertex_count()];
    let top = space.trace(|x| x[1] == 2.0)?;
    for (&p, weight) in top.vertices().iter().zip(top.weights()) {
        load[p][0] += 1e-3 * weight;
    }
    let bottom = space.trace(|x| x[1] == -2.0)?;
    Ok(Scene::new(elasticity(space, &ELASTIC)?)
        .fix(&bottom, Components::ALL)
        .with_load_history(move |time, sum| {
            for (sum, load) in sum.iter_mut().zip(&load) {
                *sum += load * time;
            }
        }))
}

fn quasi_static(space: &P1<2>, scene: Scene<BlockMatrix<2>, 2>) -> Outcome<usize> {
    let solver = Tnnmg::new(space.transfers());
    let mut body = Simulation::new(scene, GeneralizedAlpha::default(), solver)?;
    let mut cycles = 0;
    body.run(&Steps::constant(0.25).count(4), |at| {
        cycles += at.report.solver_iterations;
    })?;
    Ok(cycles)
}

/// A fault that ends inside takes the cycles of the uncut square with friction on a side, stuck and sliding, and they
/// do not grow with the refinement.
#[test]
fn cycles_of_a_fault_that_ends_inside() -> Outcome {
    for coefficient in [1e3, 1e-9] {
        let mut coarser = usize::MAX;
        for refinements in [2, 3, 4] {
            let uncut = P1::new(square(8)?).refined(refinements)?;
            let side = uncut.trace(|x| x[0] == 2.0 && x[1].abs() <= 1.0)?;
            let contact = Contact::new(&side, Tresca { coefficient }, 2e-3);
            let one = quasi_static(&uncut, sheared(&uncut)?.with_contact(contact))?;

            let mesh = square(8)?
                .with_surface_where("fault", |x| x[1] == 0.0 && x[0].abs() <= 1.0)?
                .split("fault")?;
            let cut = P1::new(mesh).refined(refinements)?;
            let [plus, minus] = ["fault+", "fault-"].map(|side| cut.part(side));
            let contact = Contact::between(&plus?, &minus?, Tresca { coefficient }, 2e-3);
            let two = quasi_static(&cut, sheared(&cut)?.with_contact(contact))?;
            assert!(5 * two <= 6 * one, "{two} cycles beside {one}");
            assert!(two / 6 <= coarser / 5, "{two} cycles after {coarser}");
            coarser = two;
        }
    }
    Ok(())
}

//! The paper's slider on a mesh without any order.

use crate::common::onsets::Onsets;
use std::ops::ControlFlow;

use stickslip::fem::{P1, gmsh};
use stickslip::problems::pipping_slider::PippingSlider;
use stickslip::{Steps, Tnnmg};

use crate::Outcome;
use crate::common::reference::FOUR;
use crate::common::{STEP, Solver, body, centre, paper_slider};

/// Cycles and velocity problems of some steps.
type Work = (usize, usize);

const STEPS: usize = 20;

/// By multigrid while it sticks and where it begins to slip, and in between by condensation; the time of
/// `V = 1e-4` m/s.
fn slip(body: &PippingSlider, space: &P1<2>) -> Outcome<(f64, [Work; 2])> {
    let x0 = centre(space)?;
    let mut slider = paper_slider(body, space, Solver::Tnnmg, 1e-10)?;
    let mut works = [(0, 0); 2];
    let mut slips = Onsets::new(1e-4, 1e-4);
    slips.record(0.0, 0.0);
    for work in &mut works {
        slider.set_solver(Tnnmg::new(space.transfers()))?;
        slider.run(&Steps::constant(STEP).count(STEPS), |at| {
            work.0 += at.report.solver_iterations;
            work.1 += at.report.coupling_iterations;
        })?;
        slider.set_solver(stickslip::Condensed::new())?;
        slider.run(&Steps::constant(STEP).count(7000), |at| {
            slips.record(at.time, at.velocity[x0].norm());
            match slips.times().is_empty() {
                true => ControlFlow::Continue(()),
                false => ControlFlow::Break(()),
            }
        })?;
    }
    let first = slips.times().first().ok_or("it does not slip")?;
    Ok((*first, works))
}

/// The mesh has cells of the size of four refinements.
#[test]
fn a_mesh_from_a_file_slips_when_the_structured_one_does() -> Outcome {
    let path = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../../examples/meshes/slider.msh"
    );
    let body = body(FOUR.refinements);
    let space = P1::new(gmsh::read::<2>(path)?).with_auxiliary_levels()?;
    let (first, found) = slip(&body, &space)?;
    assert!((first - FOUR.first_slip).abs() < 3e-3, "{first}");
    let (_, expected) = slip(&body, &body.space()?)?;
    for (found, expected) in found.into_iter().zip(expected) {
        assert!(
            expected.0 > 0 && found.0 * expected.1 <= 2 * expected.0 * found.1,
            "{found:?} against {expected:?}"
        );
    }
    Ok(())
}

//! Bodies reduced to their surface.

use stickslip::fem::P1;
use stickslip::problems::{AGING, FRICTION, INITIAL_LOG_THETA, NORMAL_STRESS, Slider};
use stickslip::state::LogTheta;
use stickslip::{
    BlockMatrix, Condensed, Contact, DenseNewton, Newmark, Operator, Reduced, Scene, Simulation,
    Steps,
};

use crate::Outcome;
use crate::common::distance;

fn scene(slider: &Slider, space: &P1<2>) -> Outcome<Scene<BlockMatrix<2>, 2>> {
    let seam = Contact::new(&Slider::bottom(space)?, FRICTION, NORMAL_STRESS)
        .with_state(AGING, LogTheta(INITIAL_LOG_THETA));
    Ok(slider.scene(space)?.with_contact(seam))
}

/// All modes span the body.
#[test]
fn with_all_modes_nothing_is_left_out() -> Outcome {
    let slider = Slider {
        refinements: 2,
        ..Slider::default()
    };
    let space = slider.space()?;
    let body = Reduced::new(&scene(&slider, &space)?).up_to(f64::INFINITY)?;
    let mut full = Simulation::new(
        scene(&slider, &space)?,
        Newmark::default(),
        Condensed::new(),
    )?;
    let mut reduced = Simulation::new(
        body.reduce(scene(&slider, &space)?)?,
        Newmark::default(),
        DenseNewton::new(),
    )?;
    let steps = Steps::constant(1.5e-3).count(7000);
    let mut velocities = Vec::new();
    full.run(&steps, |at| velocities.push(at.contact(0).slip_rate(10)))?;
    let (mut k, mut largest, mut off) = (0, 0.0_f64, 0.0_f64);
    reduced.run(&steps, |at| {
        let v = at.contact(0).slip_rate(10);
        largest = largest.max(v);
        off = off.max((v - velocities[k]).abs());
        k += 1;
    })?;
    assert!(largest > 1e-2, "{largest:e}");
    assert!(off < 1e-9 * largest, "{off:e} of {largest:e}");
    let load = full_load(&slider, &space);
    let whole = body.displacement_under(&load, &reduced.snapshot())?;
    let at = full.snapshot();
    let size = at.displacement.iter().map(|u| u.norm()).fold(0.0, f64::max);
    assert!(distance(&whole, at.displacement) < 1e-9 * size);
    Ok(())
}

fn full_load(slider: &Slider, space: &P1<2>) -> Vec<nalgebra::SVector<f64, 2>> {
    let weight = nalgebra::SVector::from([0.0, -slider.density * slider.gravity]);
    stickslip::fem::body_force(space, |_| weight)
}

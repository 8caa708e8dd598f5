//! The paper's slider: what its modes are good for.

use crate::common::onsets::Onsets;
use std::ops::ControlFlow;
use stickslip::problems::pipping_slider::PippingSlider;
use stickslip::reduced::Reduced;
use stickslip::{
    Condensed, DenseNewton, FixedPoint, Newmark, NonsmoothSolver, Operator, Scene, Simulation,
    StateUpdate, Steps,
};

use super::slider;
use crate::Outcome;
use crate::common::{STEP, body, centre};

/// The first time at which the middle slips at 1e-4 m/s.
fn first_slip<Op: Operator<2> + 'static>(
    scene: Scene<Op, 2>,
    solver: impl NonsmoothSolver<Op, 2> + 'static,
    k: usize,
) -> Outcome<f64> {
    let run = Simulation::new(scene, Newmark::default(), solver)?;
    let mut run = run
        .with_coupling(FixedPoint::paper())
        .with_state_update(StateUpdate::BackwardEuler)
        .with_absolute_tolerance(1e-10)?;
    let mut events = Onsets::new(1e-4, 1e-4);
    run.run(&Steps::constant(STEP).count(7500), |at| {
        events.record(at.time, at.contact(0).slip_rate(k));
        match events.times() {
            [] => ControlFlow::Continue(()),
            _ => ControlFlow::Break(()),
        }
    })?;
    Ok(*events.times().first().ok_or("no event")?)
}

/// The error has a sign, and passes through zero: no more than half a microsecond is left with all modes up to 75 Hz, and
/// more without.
#[test]
fn modes_bring_the_first_event_to_its_time() -> Outcome {
    let paper = body(3);
    let space = paper.space()?;
    let at = centre(&space)?;
    let k = (PippingSlider::bottom(&space)?.vertices().iter()).position(|&vertex| vertex == at);
    let k = k.ok_or("not on the bottom")?;
    let expected = first_slip(slider(&paper, &space)?, Condensed::new(), k)?;
    let mut errors = Vec::new();
    for frequency in [35.0, 75.0, 150.0] {
        let body = Reduced::new(&slider(&paper, &space)?).up_to_frequency(frequency)?;
        let next = body.first_left_out().ok_or("all modes")?;
        assert!(next > frequency && body.frequencies().is_sorted());
        assert!(body.frequencies().all(|f| f <= frequency));
        let reduced = body.reduce(slider(&paper, &space)?)?;
        let found = first_slip(reduced, DenseNewton::new(), k)?;
        errors.push((found - expected).abs());
    }
    // With the modes that the step follows, too.
    let body = Reduced::new(&slider(&paper, &space)?).for_time_step(STEP)?;
    let reduced = body.reduce(slider(&paper, &space)?)?;
    let found = first_slip(reduced, DenseNewton::new(), k)?;
    errors.push((found - expected).abs());
    assert!(errors[0] > 5e-7, "{errors:?}");
    assert!(errors[1..].iter().all(|&error| error < 5e-7), "{errors:?}");
    Ok(())
}

/// A step of creep is one of Newton's method, with a product for the forces where it starts, one or two for its direction,
/// and none to see that this was enough.
#[test]
fn a_step_takes_few_products() -> Outcome {
    const STEPS: usize = 1000;
    let paper = body(3);
    let space = paper.space()?;
    let body = Reduced::new(&slider(&paper, &space)?).for_time_step(STEP)?;
    let reduced = body.reduce(slider(&paper, &space)?)?;
    let run = Simulation::new(reduced, Newmark::default(), DenseNewton::new())?;
    let mut run = run.with_absolute_tolerance(1e-10)?;
    let mut iterations = 0;
    run.run(&Steps::constant(STEP).count(STEPS), |at| {
        iterations += at.report.solver_iterations
    })?;
    assert!(iterations <= 12 * STEPS / 10, "{iterations} iterations");
    let products = run.counters().products;
    assert!(products <= 26 * STEPS / 10, "{products} products");
    Ok(())
}

/// The error of the reduction grows with the frequency of the load, as its square and more, and falls with modes.
#[test]
fn what_is_left_out_is_bounded() -> Outcome {
    let paper = body(2);
    let space = paper.space()?;
    let scene = slider(&paper, &space)?;
    let mut last = f64::INFINITY;
    for frequency in [35.0, 75.0, 150.0] {
        let body = Reduced::new(&scene).up_to_frequency(frequency)?;
        let [slow, faster] = [body.left_out(5.0)?, body.left_out(10.0)?];
        assert!(slow > 0.0 && faster >= 4.0 * slow * (1.0 - 1e-12));
        assert!(slow < last, "{slow:e}, {last:e}");
        last = slow;
        let next = body.first_left_out().ok_or("all modes")?;
        assert_eq!(body.left_out(next)?, f64::INFINITY);
    }
    Ok(())
}

#[test]
fn a_snapshot_of_another_body_is_refused() -> Outcome {
    let paper = body(2);
    let space = paper.space()?;
    let other = Reduced::new(&slider(&body(1), &body(1).space()?)?).up_to_frequency(100.0)?;
    let body = Reduced::new(&slider(&paper, &space)?).up_to_frequency(100.0)?;
    let run = Simulation::new(
        body.reduce(slider(&paper, &space)?)?,
        Newmark::default(),
        DenseNewton::new(),
    )?;
    assert!(body.displacement(&run.snapshot()).is_ok());
    assert!(other.displacement(&run.snapshot()).is_err());
    assert!(other.velocity(&run.snapshot()).is_err());
    Ok(())
}

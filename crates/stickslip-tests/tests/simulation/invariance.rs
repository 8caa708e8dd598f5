//! Invariance of the slider: under the diagonals of its squares, and gravity.
//!
//! Normal stress is prescribed, so gravity only adds a static displacement. The mirrored mesh,
//! pulled the other way, is the mirror image of the original one; and the laws know no direction.

use stickslip::Steps;
use stickslip::problems::pipping_slider::PippingSlider;

use crate::Outcome;
use crate::common::{STEP, Solver, body, centre, paper_slider, relative};

/// Displacement, velocity and state at `x0`.
type Motion = (f64, f64, f64);

/// Initial displacement and every 50th step into the first event, the last ones all.
fn history(body: &PippingSlider) -> Outcome<(f64, Vec<Motion>)> {
    let space = body.space()?;
    let x0 = centre(&space)?;
    let mut slider = paper_slider(body, &space, Solver::Tnnmg, 1e-10)?;
    let initial = slider.snapshot().displacement[x0][0];
    let mut samples = Vec::new();
    slider.run(&Steps::constant(STEP).count(6850), |at| {
        if at.step.is_multiple_of(50) || (at.step > 6700 && at.step.is_multiple_of(10)) {
            let contact = at.contact(0);
            let state = contact
                .position_of(x0)
                .map_or(f64::NAN, |k| contact.state(k));
            samples.push((at.displacement[x0][0], at.velocity[x0][0], state));
        }
    })?;
    Ok((initial, samples))
}

#[test]
fn diagonals_and_gravity_leave_rate_and_state_alone() -> Outcome {
    let paper = body(3);
    let (initial, samples) = history(&paper)?;
    let rates = || samples.iter().map(|s| s.1);
    assert!(rates().fold(0.0, f64::max) > 5e-3, "no event");
    assert!(rates().fold(1.0, f64::min) < 1e-22, "never stuck");
    assert!(initial.abs() > 1e-8, "gravity without effect");

    let mirrored = PippingSlider {
        mirrored: true,
        ..paper
    };
    let weightless = PippingSlider {
        gravity: 0.0,
        ..paper
    };
    for (what, other) in [("mirrored", mirrored), ("weightless", weightless)] {
        let (other_initial, others) = history(&other)?;
        // The mirror image has the opposite initial displacement.
        let expected = if other.mirrored { -initial } else { 0.0 };
        assert!((other_initial - expected).abs() < 1e-10 * initial.abs());
        for (n, (s, o)) in samples.iter().zip(&others).enumerate() {
            let logarithm = (s.1.abs() / o.1.abs()).ln().abs();
            assert!(logarithm < 1e-7, "{what}, sample {n}: {s:?}, {o:?}");
            assert!((s.2 - o.2).abs() < 1e-7, "{what}, sample {n}: {s:?}, {o:?}");
            // Slip from 1e-18 to 2e-4 m beside an initial displacement of 2e-7 m.
            let (slip, other_slip) = (s.0 - initial, o.0 - other_initial);
            assert!(
                (slip - other_slip).abs() < 1e-18 || relative(slip, other_slip) < 1e-7,
                "{what}, sample {n}: {slip:e}, {other_slip:e}"
            );
        }
    }
    Ok(())
}

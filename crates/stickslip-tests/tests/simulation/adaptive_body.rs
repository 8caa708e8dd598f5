//! The elastic slider with steps that are quantised: one factor a size, kept.

use stickslip::problems::pipping_slider::{
    AGING, FRICTION, INITIAL_LOG_THETA, NORMAL_STRESS, PippingSlider,
};
use stickslip::state::LogTheta;
use stickslip::{Condensed, Contact, ErrorControl, Sdirk2, Simulation, Steps};

use crate::Outcome;
use crate::common::body;

/// Factorisations and accepted and rejected steps up to the first event.
fn cost(adaptive: Steps) -> Outcome<(usize, usize)> {
    let body = body(2);
    let space = body.space()?;
    let contact = Contact::new(&PippingSlider::bottom(&space)?, FRICTION, NORMAL_STRESS);
    let scene = body
        .scene(&space)?
        .with_contact(contact.with_state(AGING, LogTheta(INITIAL_LOG_THETA)));
    let solver = Condensed::new().with_cached_factors(24);
    let mut slider = Simulation::new(scene, Sdirk2, solver)?;
    let mut peak = 0_f64;
    let report = slider.run(&adaptive.until(10.2), |at| {
        peak = peak.max(at.max_slip_rate())
    })?;
    assert!(peak > 5e-3, "no event: {peak:e}");
    let factorizations = slider.counters().factorizations;
    Ok((factorizations, report.accepted + report.rejected))
}

#[test]
fn quantised_steps_share_their_factors() -> Outcome {
    let adaptive = Steps::adaptive(1e-2)
        .with_first_step(1e-3)
        .with_error_control(ErrorControl {
            slip_rate_floor: 1e-12,
            ..ErrorControl::default()
        });
    let (many, steps) = cost(adaptive.clone())?;
    let (few, quantised) = cost(adaptive.in_powers_of_two())?;
    // A whole and two halves: at most two operators a step, and both where none is kept.
    assert!(many > steps / 2, "{many} of {steps}");
    assert!(few <= 24 && few < many / 4, "{few} of {quantised}");
    Ok(())
}

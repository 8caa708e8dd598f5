//! The times of events, against the exact solution of the layer and the extrapolated slider.

use crate::common::onsets::Onsets;
use stickslip::problems::antiplane_layer::{
    AGING, AntiplaneLayer, END, FRICTION, INITIAL_LOG_THETA, NORMAL_STRESS,
};
use stickslip::state::LogTheta;
use stickslip::{Condensed, Contact, Monolithic, Newmark, Simulation, StateUpdate};

use crate::Outcome;
use crate::common::{Solver, body, centre, slide};

/// The first time of 1e-3 m/s at the base of the layer, `END/steps` a step.
fn layer_slips(steps: usize) -> Outcome<f64> {
    let layer = AntiplaneLayer::default();
    let space = layer.space()?;
    let base = AntiplaneLayer::base(&space)?;
    let contact =
        Contact::new(&base, FRICTION, NORMAL_STRESS).with_state(AGING, LogTheta(INITIAL_LOG_THETA));
    let scene = layer.scene(&space)?.with_contact(contact);
    let mut layer = Simulation::new(scene, Newmark::default(), Condensed::new())?;
    let vertex = base.vertices()[0];
    let mut events = Onsets::new(1e-3, 2e-4);
    let dt = END / steps as f64;
    while events.times().is_empty() {
        assert!(!layer.step(dt)?.fell_back);
        let at = layer.snapshot();
        assert!(at.time < 10.2, "no event");
        events.record(at.time, at.velocity[vertex][0]);
    }
    Ok(events.times()[0])
}

/// The exact time is 10.06626 s. Measured with another code: -4.2e-5 s at `N = 1e4`, -5.4e-6 at
/// 3e4.
#[test]
fn the_layer_slips_on_time() -> Outcome {
    let mut exact = Onsets::new(1e-3, 2e-4);
    let initial = LogTheta(INITIAL_LOG_THETA);
    AntiplaneLayer::default().exact(&FRICTION, &AGING, initial, 1600, |at| {
        exact.record(at.time, at.slip_rate);
    })?;
    let exact = exact.times()[0];
    assert!((exact - 10.06626).abs() < 1e-5, "{exact}");
    let times = [
        layer_slips(10_000)?,
        layer_slips(20_000)?,
        layer_slips(40_000)?,
    ];
    let errors = times.map(|time| time - exact);
    assert!(errors[0].abs() <= 1e-4, "{errors:?}");
    // Free of the error in space, which is the same for all.
    let ratio = (times[1] - times[0]) / (times[2] - times[1]);
    assert!((3.5..4.5).contains(&ratio), "{times:?}, {ratio}");
    // What is left of the error is that of the mesh.
    let limit = times[2] + (times[2] - times[1]) / 3.0;
    assert!((limit - exact).abs() < 1e-5, "{limit}, {exact}");
    Ok(())
}

/// The first time of 1e-4 m/s at the middle of the elastic slider with four refinements.
fn slider_slips(steps: usize, state_update: StateUpdate) -> Outcome<f64> {
    let body = body(4);
    let space = body.space()?;
    let laws = (FRICTION, AGING, LogTheta(INITIAL_LOG_THETA));
    let scheme = Newmark::default();
    let mut slider = slide(&body, &space, laws, scheme, Solver::Condensed, 1e-10)?
        .with_coupling(Monolithic::default())
        .with_state_update(state_update);
    let x0 = centre(&space)?;
    let mut slips = Onsets::new(1e-4, 1e-4);
    let dt = END / steps as f64;
    while slips.times().is_empty() {
        slider.step(dt)?;
        let at = slider.snapshot();
        assert!(at.time < 10.2, "no event");
        slips.record(at.time, at.velocity[x0][0]);
    }
    Ok(slips.times()[0])
}

/// 10.010765 s is what the first-order results extrapolate to, which are themselves those of an
/// independent code: 10.009699 s at `N = 1e4`.
#[test]
fn the_slider_slips_on_time() -> Outcome {
    let coarse = slider_slips(10_000, StateUpdate::BackwardEuler)?;
    assert!((coarse - 10.009699449).abs() < 1e-6, "{coarse}");
    let fine = slider_slips(20_000, StateUpdate::BackwardEuler)?;
    let extrapolated = 2.0 * fine - coarse;
    let midpoint = slider_slips(10_000, StateUpdate::Midpoint)?;
    assert!((midpoint - 10.010765).abs() < 2e-5, "{midpoint}");
    assert!(
        (midpoint - extrapolated).abs() < 2e-5,
        "{midpoint}, {extrapolated}"
    );
    Ok(())
}

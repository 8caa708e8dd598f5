//! Two layers of different stiffness and density against their solution by waves.

use stickslip::problems::antiplane_layer::{
    AGING, END, FRICTION, INITIAL_LOG_THETA, NORMAL_STRESS,
};
use stickslip::problems::two_layers::{ExactSlip, Layer, TwoLayers};
use stickslip::state::LogTheta;
use stickslip::{Condensed, Contact, Newmark, Simulation, Steps};

use crate::Outcome;

/// The first time of 1e-3 m/s [s] and the slip at the end [m], by an independent program.
const FIRST: f64 = 12.931529;
const SLIP: f64 = 6.41025e-4;

/// The time between two samples at which a rate passes 1e-3 m/s, by its logarithm.
fn passing((before, rate): (f64, f64), (time, next): (f64, f64)) -> Option<f64> {
    let share = (1e-3 / rate).ln() / (next / rate).ln();
    (rate < 1e-3 && next >= 1e-3).then_some(before + share * (time - before))
}

#[test]
fn the_exact_solution_agrees_with_an_independent_one() -> Outcome {
    let (mut last, mut first, mut end) = ((0.0, 1e-30), None, 0.0);
    let initial = LogTheta(INITIAL_LOG_THETA);
    let observe = |at: ExactSlip| {
        first = first.or_else(|| passing(last, (at.time, at.slip_rate)));
        last = (at.time, at.slip_rate);
        if at.time <= END {
            end = at.slip + at.slip_rate * (END - at.time);
        }
    };
    TwoLayers::default().exact(&FRICTION, &AGING, initial, 1600, observe)?;
    let first = first.ok_or("no event")?;
    assert!((first - FIRST).abs() < 1e-5, "{first}");
    assert!((end - SLIP).abs() < 1e-8, "{end:e}");
    Ok(())
}

/// The first time and the peak of the first event by finite elements.
fn first_event(cells: [usize; 2]) -> Outcome<[f64; 2]> {
    let default = TwoLayers::default();
    let layers = TwoLayers {
        upper: Layer {
            cells: cells[0],
            ..default.upper
        },
        lower: Layer {
            cells: cells[1],
            ..default.lower
        },
    };
    let space = layers.space()?;
    let [plus, minus] = TwoLayers::sides(&space)?;
    let contact = Contact::between(plus, minus, FRICTION, NORMAL_STRESS)
        .with_state(AGING, LogTheta(INITIAL_LOG_THETA));
    let scene = layers
        .scene(&space)?
        .with_contact(contact)
        .with_zero_acceleration();
    let mut body = Simulation::new(scene, Newmark::default(), Condensed::new())?;
    let (mut last, mut first, mut peak) = ((0.0, 1e-30), None, 0.0_f64);
    let start = body.run(&Steps::constant(1.5e-4).until(12.8), |_| ());
    start?;
    body.run(&Steps::constant(7.5e-5).until(13.1), |at| {
        let now = (at.time, at.max_slip_rate());
        first = first.or_else(|| passing(last, now));
        last = now;
        peak = peak.max(now.1);
    })?;
    Ok([first.ok_or("no event")?, peak])
}

#[test]
fn finite_elements_converge_with_second_order() -> Outcome {
    let exact = [FIRST, 2.09662e-2];
    let [coarse, fine] = [first_event([16, 11])?, first_event([32, 22])?];
    for k in 0..2 {
        let errors = [coarse, fine].map(|event| (event[k] - exact[k]).abs());
        // The time is exact to 1e-6 s, the peak to 1e-7 m/s.
        let floor = [2e-6, 2e-7][k];
        assert!(errors[1] < 0.35 * errors[0] + floor, "{errors:?}");
        assert!(errors[0] < [1e-4, 5e-5][k], "{errors:?}");
    }
    Ok(())
}

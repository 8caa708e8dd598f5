//! A slider in one to four processes, and in none but this one.

use stickslip::problems::pipping_slider::{
    AGING, END, FRICTION, INITIAL_LOG_THETA, NORMAL_STRESS, PippingSlider,
};
use stickslip::state::LogTheta;
use stickslip::{Condensed, Contact, FixedPoint, Newmark, Simulation, StateUpdate, Steps};

use super::{agree, distances, history, run};

const STEPS: usize = 200;

#[test]
fn processes_and_the_serial_library_see_the_same_slider() {
    let share = (STEPS as f64 / 10_000.0).to_string();
    let arguments = ["--refinements", "3", "--until", &share];
    let one = history("slider", 1, &arguments);
    assert_eq!(one.len(), STEPS);
    for processes in 2..=4 {
        let several = history("slider", processes, &arguments);
        let distances = distances(&one, &several);
        // Time, displacement, state. Where the body sticks its velocity is what rounding leaves of none.
        for c in [1, 2, 4] {
            assert!(distances[c] <= 1e-8, "{processes}: {distances:?}");
        }
    }
    let body = PippingSlider {
        refinements: 3,
        ..PippingSlider::default()
    };
    let space = body.space().expect("a mesh");
    let bottom = PippingSlider::bottom(&space).expect("a bottom");
    let contact = Contact::new(&bottom, FRICTION, NORMAL_STRESS)
        .with_state(AGING, LogTheta(INITIAL_LOG_THETA));
    let scene = body.scene(&space).expect("a scene").with_contact(contact);
    let mut serial = Simulation::new(scene, Newmark::default(), Condensed::new())
        .and_then(|simulation| {
            simulation
                .with_coupling(FixedPoint::paper())
                .with_state_update(StateUpdate::BackwardEuler)
                .with_absolute_tolerance(1e-10)
        })
        .expect("a simulation");
    let vertex = PippingSlider::centre(&space).expect("a middle");
    let mut rows = Vec::new();
    let steps = Steps::constant(END / 10_000.0).count(STEPS);
    let ended = serial.run(&steps, |at| {
        let contact = at.contact(0);
        let place = contact.position_of(vertex).expect("a frictional vertex");
        rows.push(vec![
            at.time,
            at.displacement[vertex][0],
            contact.state(place),
        ]);
    });
    ended.expect("steps that can be taken");
    let one: Vec<Vec<f64>> = one.iter().map(|row| vec![row[1], row[2], row[4]]).collect();
    let distances = distances(&rows, &one);
    assert!(
        distances.iter().all(|&distance| distance <= 1e-8),
        "{distances:?}"
    );
}

/// Steps of 0.15 s fail in events, first in the process that owns the vertex: no process waits for one that takes
/// another part. Where they end is not the question, since such steps have several solutions.
#[test]
fn steps_that_fail_are_split_by_all_processes_together() {
    let arguments = ["--refinements", "1", "--steps", "100", "--until", "0.7"];
    for processes in [1, 2] {
        let rows = history("slider", processes, &arguments);
        assert!(rows.len() > 70, "{processes}: no step was split");
    }
}

#[test]
fn a_block_in_space_is_the_same_in_any_number_of_processes() {
    let arguments = ["--refinements", "1", "--steps", "1000", "--until", "0.75"];
    let one = history("slider3d", 1, &arguments);
    let fastest = one.iter().map(|row| row[6]).fold(0.0, f64::max);
    assert!(fastest > 1e-3, "nothing slides: {fastest:e}");
    for processes in 2..=4 {
        let several = history("slider3d", processes, &arguments);
        let columns: Vec<usize> = (0..one[0].len()).collect();
        agree(&one, &several, &columns, 1e-8);
    }
}

#[test]
fn the_failure_of_a_process_ends_all_with_its_message() {
    let ended = run(
        "slider",
        2,
        &[
            "--refinements",
            "1",
            "--until",
            "0.01",
            "--out",
            "/dev/null/x",
        ],
    );
    assert!(!ended.status.success());
    let said = String::from_utf8_lossy(&ended.stderr);
    assert!(said.contains("error in process"), "{said}");
}

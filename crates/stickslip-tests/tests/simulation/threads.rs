//! Simulations move between threads, and run there to the same bits.

use std::thread;

use stickslip::friction::{DieterichRuina, Sliding, Tresca};
use stickslip::problems::pipping_slider::{
    AGING, FRICTION, INITIAL_LOG_THETA, NORMAL_STRESS, PippingSlider,
};
use stickslip::state::{Dieterich, LogTheta};
use stickslip::{
    BlockMatrix, Contact, FixedPoint, Monolithic, Newmark, RungeKutta, Scene, SceneError,
    Simulation, StepFailure, StepState, Steps,
};

use crate::Outcome;
use crate::common::{Solver, bits, body};

fn is_send<T: Send>() {}
fn is_sync<T: Sync>() {}

#[test]
fn what_is_kept_can_be_sent() {
    is_send::<Simulation<2>>();
    is_send::<Scene<BlockMatrix<3>, 3>>();
    is_send::<RungeKutta<1>>();
    is_send::<StepState<2>>();
    is_sync::<StepState<2>>();
    is_sync::<Contact<DieterichRuina, Dieterich, 2>>();
    is_sync::<Sliding<Tresca, 2>>();
    is_send::<StepFailure>();
    is_sync::<StepFailure>();
    is_send::<SceneError>();
    is_sync::<SceneError>();
}

/// The slider under one of eight normal stresses, by all solvers in turn.
fn slid(number: usize) -> Result<Vec<u64>, String> {
    let run = || -> Outcome<Vec<u64>> {
        let space = body(1).space()?;
        let stress = NORMAL_STRESS * (0.02 + 0.002 * number as f64);
        let contact = Contact::new(&PippingSlider::bottom(&space)?, FRICTION, stress);
        let scene = body(1)
            .scene(&space)?
            .with_contact(contact.with_state(AGING, LogTheta(INITIAL_LOG_THETA)));
        let solver = Solver::ALL[number % 3].on(&space);
        let body = Simulation::new(scene, Newmark::default(), solver)?;
        let mut body = if number.is_multiple_of(2) {
            body.with_coupling(FixedPoint::default())
        } else {
            body.with_coupling(Monolithic::default())
        };
        body.run(&Steps::constant(5e-3).until(2.0), |_| ())?;
        Ok(bits(&body.snapshot()))
    };
    run().map_err(|error| error.to_string())
}

#[test]
fn eight_simulations_in_two_threads_give_the_same_bits() -> Outcome {
    let alone: Vec<_> = (0..8).map(slid).collect();
    let halves =
        [0, 1].map(|half| thread::spawn(move || (0..4).map(|k| slid(2 * k + half)).collect()));
    for (half, handle) in halves.into_iter().enumerate() {
        let together: Vec<_> = handle.join().map_err(|_| "a thread panicked")?;
        for (k, result) in together.into_iter().enumerate() {
            assert!(result.is_ok(), "{result:?}");
            assert_eq!(alone[2 * k + half], result);
        }
    }
    Ok(())
}

/// A simulation that has begun goes on in another thread.
#[test]
fn a_simulation_moves_into_a_thread_and_back() -> Outcome {
    let space = body(1).space()?;
    let make = || crate::common::paper_slider(&body(1), &space, Solver::Condensed, 1e-10);
    let (mut moving, mut staying) = (make()?, make()?);
    let steps = Steps::constant(1e-2).count(50);
    moving.run(&steps, |_| ())?;
    staying.run(&steps, |_| ())?;
    let handle = thread::spawn(move || {
        let result = moving.run(&Steps::constant(1e-2).count(50), |_| ());
        result.map(|_| moving)
    });
    let moved = handle.join().map_err(|_| "the thread panicked")??;
    staying.run(&steps, |_| ())?;
    assert_eq!(bits(&moved.snapshot()), bits(&staying.snapshot()));
    Ok(())
}

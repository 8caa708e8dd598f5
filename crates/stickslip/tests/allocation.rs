//! After the first step the time loop takes no memory: neither solver, coupling nor recorders.
#![cfg(all(feature = "fem", feature = "tnnmg"))]

mod common;

use stickslip::{Events, History};

use common::{Outcome, STEP, Solver, body, centre, paper_slider};

/// Allocations during `steps` steps of the paper's size, the first one apart, and the largest slip rate.
fn allocations(
    refinements: usize,
    solver: Solver,
    steps: usize,
) -> Result<(u64, f64, f64), Box<dyn std::error::Error>> {
    let body = body(refinements);
    let space = body.space()?;
    let mut slider = paper_slider(&body, &space, solver, 1e-10)?;
    let mut history = History::new(centre(&space)?, 0, steps);
    let mut events = Events::new(1e-4, 1e-4);
    let (mut slowest, mut fastest) = (f64::INFINITY, 0_f64);
    slider.step(STEP)?;
    let mut outcome = Ok(());
    let info = allocation_counter::measure(|| {
        outcome = slider.run(steps - 1, STEP, &mut |at| {
            let sample = history.record(&at);
            events.record(sample.time, sample.velocity);
            slowest = slowest.min(sample.max_slip_rate);
            fastest = fastest.max(sample.max_slip_rate);
        });
    });
    outcome?;
    assert_eq!(history.samples().len(), steps - 1);
    assert!(!events.times().is_empty());
    Ok((info.count_total, slowest, fastest))
}

/// The counter itself works.
#[test]
fn the_counter_counts() -> Outcome {
    let mut made = Vec::new();
    let info = allocation_counter::measure(|| made = vec![1.0; 1000]);
    assert_eq!((info.count_total, made.len()), (1, 1000));
    Ok(())
}

#[test]
fn multigrid_allocates_nothing_in_stick_and_slip() -> Outcome {
    let (count, slowest, fastest) = allocations(3, Solver::Tnnmg, 6800)?;
    assert!(
        slowest < 1e-20 && fastest > 5e-3,
        "{slowest:e}, {fastest:e}"
    );
    assert_eq!(count, 0);
    Ok(())
}

#[test]
fn gauss_seidel_allocates_nothing_in_stick_and_slip() -> Outcome {
    let (count, slowest, fastest) = allocations(1, Solver::GaussSeidel, 6800)?;
    assert!(
        slowest < 1e-20 && fastest > 5e-3,
        "{slowest:e}, {fastest:e}"
    );
    assert_eq!(count, 0);
    Ok(())
}

//! Recorders take no memory in the loop.

use std::io;
use std::ops::ControlFlow;

use stickslip::Steps;
use stickslip::record::{
    EnergyLedger, EventCatalogue, PointHistories, Quantity, TraceMemory, TraceWriter, Tracing,
};

use crate::Outcome;
use crate::common::{STEP, Solver, body, centre, paper_slider};

/// Through stick and slip, the writers' own buffers aside.
#[test]
fn recorders_allocate_nothing_in_stick_and_slip() -> Outcome {
    const STEPS: usize = 6900;
    let body = body(2);
    let space = body.space()?;
    let mut slider = paper_slider(&body, &space, Solver::Condensed, 1e-10)?;
    slider.step(STEP)?;
    let at = slider.snapshot();
    let all = [
        Quantity::Slip,
        Quantity::SlipRate,
        Quantity::State,
        Quantity::Traction,
    ];
    let tracing = Tracing::of(0, &all).every(50).on_change(3.0, 1e-9);
    let mut points = PointHistories::new(&at, &[centre(&space)?, 0], 10, io::sink())?;
    let mut writer = TraceWriter::new(&at, tracing.clone(), io::sink())?;
    let mut memory = TraceMemory::new(&at, tracing, 64)?;
    let mut catalogue = EventCatalogue::new(&at, 0, [1e-3, 1e-4], 2e7, 16)?;
    let mut ledger = EnergyLedger::new(&at);
    let mut outcome = None;
    let mut left_over = 0_f64;
    let info = allocation_counter::measure(|| {
        outcome = Some(slider.run(&Steps::constant(STEP).count(STEPS), |at| {
            points.record(&at)?;
            writer.record(&at)?;
            memory.record(&at);
            catalogue.record(&at);
            ledger.record(&at);
            if at.step % 1000 == 0 {
                left_over = ledger.balance(&at).left_over;
            }
            ControlFlow::Continue(())
        }));
    });
    outcome.ok_or("not run")??;
    assert_eq!(info.count_total, 0);
    assert!(!catalogue.events().is_empty() && !memory.times().is_empty());
    assert!(left_over.abs() < 1e-6);
    Ok(())
}

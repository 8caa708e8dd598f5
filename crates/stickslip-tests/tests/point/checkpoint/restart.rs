//! Pieces, each begun from a file by another simulation, are the whole run, bit for bit.

use std::fs;

use stickslip::integrate::{Stepper, StopReason};
use stickslip::problems::spring_slider::{AGING, FRICTION, LoadPath, SpringSlider};
use stickslip::record::{EnergyLedger, EventCatalogue, Quantity, TraceMemory, Tracing};
use stickslip::time::QuasiStatic;
use stickslip::{
    BackwardEuler, Checkpoint, FixedPoint, GeneralizedAlpha, Newmark, Point, RateScheme, Run,
    RungeKutta, Sdirk2, Simulation, Snapshot, StateUpdate, Steps,
};

use super::Place;
use crate::Outcome;

/// Every recorder that has something to remember.
type Records = (EventCatalogue<1>, EnergyLedger<1>, TraceMemory);

fn records(at: &Snapshot<'_, 1>) -> Outcome<Records> {
    let tracing = Tracing::of(0, &[Quantity::Slip, Quantity::State]).on_change(1.5, 1e-12);
    Ok((
        EventCatalogue::new(at, 0, [1e-5, 1e-6], 3e10, 0)?,
        EnergyLedger::new(at),
        TraceMemory::new(at, tracing, 16)?,
    ))
}

fn record(records: &mut Records, at: &Snapshot<'_, 1>) {
    records.0.record(at);
    records.1.record(at);
    records.2.record(at);
}

/// Runs a plan in one piece and in pieces of so many steps, and compares the files at the ends.
fn same<S: Stepper<1>>(make: &dyn Fn() -> Outcome<S>, plan: &Steps, piece: usize) -> Outcome {
    let place = Place::new("restart")?;
    let file = |name: &str| Checkpoint::at(place.file(name));
    let mut whole = make()?;
    let mut kept = records(&whole.snapshot())?;
    let mut peak = 0.0_f64;
    let report = whole.run(plan, |at| {
        peak = peak.max(at.max_slip_rate());
        record(&mut kept, &at);
    })?;
    file("whole").save(&whole.snapshot(), &kept)?;
    assert!(peak > 1e-5, "sticks: {report:?}");

    let start = make()?;
    file("piece").save(&start.snapshot(), &records(&start.snapshot())?)?;
    let (mut pieces, mut accepted) = (0, 0);
    loop {
        let mut next = make()?;
        let mut kept: Records = file("piece").restore(&mut next)?;
        let report = next.run(&plan.clone().count(piece), |at| record(&mut kept, &at))?;
        file("piece").save(&next.snapshot(), &kept)?;
        (pieces, accepted) = (pieces + 1, accepted + report.accepted);
        if report.ended == StopReason::Time {
            break;
        }
    }
    assert!(pieces > 3, "{pieces} pieces");
    assert_eq!(accepted, report.accepted);
    let bytes = |name: &str| fs::read(place.file(name));
    assert!(bytes("whole")? == bytes("piece")?, "other bits");
    Ok(())
}

/// Through stick-slip cycles.
fn cycles(mass: f64) -> SpringSlider {
    SpringSlider {
        stiffness: 2.5e8,
        normal_stress: 1e6,
        mass,
        damping: 5e6,
        load: LoadPath::steady(1e-6).then(40.0, 3e-6),
    }
}

fn schemes() -> [Box<dyn RateScheme>; 5] {
    [
        Box::new(Newmark::default()),
        Box::new(GeneralizedAlpha {
            spectral_radius: 0.6,
        }),
        Box::new(Sdirk2),
        Box::new(BackwardEuler),
        Box::new(QuasiStatic(Newmark::default())),
    ]
}

#[test]
fn adaptive_steps_go_on_with_the_same_bits() -> Outcome {
    let steps = Steps::adaptive(1e-3).until(150.0).stopping_at([40.0, 77.7]);
    for k in 0..schemes().len() {
        let make = || -> Outcome<_> {
            let scene = cycles(5e3).steady(FRICTION, AGING, 1.01e-6)?;
            let scheme = schemes().into_iter().nth(k).ok_or("no scheme")?;
            Ok(Simulation::new(scene, scheme, Point)?)
        };
        same(&make, &steps, 31)?;
        same(&make, &steps.clone().in_powers_of_two(), 37)?;
    }
    let explicit = || -> Outcome<_> {
        let scene = cycles(0.0).steady(FRICTION, AGING, 1.01e-6)?;
        Ok(RungeKutta::new(scene)?)
    };
    same(&explicit, &steps, 13)
}

#[test]
fn constant_steps_go_on_with_the_same_bits() -> Outcome {
    let steps = Steps::constant(0.05).until(60.0).stopping_at([40.0, 50.01]);
    for k in 0..schemes().len() {
        let make = || -> Outcome<_> {
            let scene = cycles(5e3).steady(FRICTION, AGING, 1.01e-6)?;
            let scheme = schemes().into_iter().nth(k).ok_or("no scheme")?;
            Ok(Simulation::new(scene, scheme, Point)?)
        };
        same(&make, &steps, 171)?;
    }
    Ok(())
}

/// A piece never ends within a step that is split.
#[test]
fn split_steps_go_on_with_the_same_bits() -> Outcome {
    let slider = SpringSlider {
        stiffness: 2e7,
        normal_stress: 1e6,
        mass: 5e3,
        damping: 0.0,
        load: LoadPath::steady(1e-4),
    };
    let make = || -> Outcome<_> {
        let scene = slider.steady(FRICTION, AGING, 1.1e-4)?;
        Ok(Simulation::new(scene, Newmark::default(), Point)?
            .with_coupling(FixedPoint::paper().with_max_iterations(12))
            .with_state_update(StateUpdate::BackwardEuler)
            .with_tolerance(1e-13)?)
    };
    let plan = Steps::constant(0.02).until(10.0).with_substeps();
    let report = make()?.run(&plan, |_| ())?;
    assert!(report.substepped > 3, "{report:?}");
    for piece in [9, 100] {
        same(&make, &plan, piece)?;
    }
    Ok(())
}

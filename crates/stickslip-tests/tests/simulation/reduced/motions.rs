//! With all modes nothing is left out: the reduced body moves as the whole one.

use stickslip::fem::{Viscous, viscosity};
use stickslip::integrate::Stepper;
use stickslip::problems::pipping_slider::PippingSlider;
use stickslip::record::EnergyLedger;
use stickslip::reduced::Reduced;
use stickslip::{Condensed, DenseNewton};
use stickslip::{ErrorControl, Newmark, Run, Simulation, Steps};

use super::{Full, Pair, gravity, slider};
use crate::Outcome;
use crate::common::{STEP, body, centre};

/// Slip rates at the middle and in all steps, with their times.
fn rates<S: Stepper<2>>(run: &mut S, k: usize, steps: &Steps) -> Outcome<Vec<[f64; 2]>> {
    let mut rates = Vec::new();
    run.run(steps, |at| {
        rates.push([at.time, at.contact(0).slip_rate(k)])
    })?;
    Ok(rates)
}

/// Through stick and a first event.
#[test]
fn with_all_modes_constant_steps_are_those_of_the_whole_body() -> Outcome {
    let paper = body(2);
    let space = paper.space()?;
    let scene = || slider(&paper, &space);
    let mut pair = Pair::new(&scene, f64::INFINITY)?;
    assert_eq!(pair.body.first_left_out(), None);
    assert_eq!(pair.body.left_out(1e3)?, 0.0);
    let at = pair.full.snapshot();
    let k = at
        .contact(0)
        .position_of(centre(&space)?)
        .ok_or("no vertex")?;
    let steps = Steps::constant(STEP).count(7000);
    let full = rates(&mut pair.full, k, &steps)?;
    let reduced = rates(&mut pair.reduced, k, &steps)?;
    let largest = full.iter().map(|[_, rate]| *rate).fold(0.0, f64::max);
    assert!(largest > 5e-3, "no event: {largest:e}");
    for (full, reduced) in full.iter().zip(&reduced) {
        assert_eq!(full[0], reduced[0]);
        assert!(
            (full[1] - reduced[1]).abs() < 1e-9 * largest,
            "{full:?}, {reduced:?}"
        );
    }
    assert!(pair.apart(Some(&gravity(&paper, &space)))? < 1e-9);
    Ok(())
}

#[test]
fn with_all_modes_adaptive_steps_are_nearly_those_of_the_whole_body() -> Outcome {
    let paper = PippingSlider {
        recurrent: false,
        ..body(2)
    };
    let space = paper.space()?;
    let scene = || slider(&paper, &space);
    let mut pair = Pair::new(&scene, f64::INFINITY)?;
    let k = 10;
    // Sizes are powers of two times the first: rounding moves no time. By default rest is told by the fastest motion, which is that of a vertex here and of a coordinate there.
    let control = ErrorControl {
        slip_rate_floor: 1e-9,
        relative_slip_rate_floor: 0.0,
        motion_floor: 0.0,
        ..ErrorControl::default()
    };
    let steps = Steps::adaptive(1e-3)
        .with_error_control(control)
        .in_powers_of_two()
        .with_first_step(STEP)
        .until(10.5);
    let full = rates(&mut pair.full, k, &steps)?;
    let reduced = rates(&mut pair.reduced, k, &steps)?;
    let largest = full.iter().map(|[_, rate]| *rate).fold(0.0, f64::max);
    assert!(largest > 5e-3, "no event: {largest:e}");
    // What counts as rest is summed over nodes there and over coordinates here.
    let [most, more] = [full.len(), full.len().abs_diff(reduced.len())];
    assert!(100 * more <= most, "{most}, {}", reduced.len());
    let peak = reduced.iter().map(|[_, rate]| *rate).fold(0.0, f64::max);
    assert!((peak / largest - 1.0).abs() < 1e-2, "{peak:e}, {largest:e}");
    Ok(())
}

/// The slider with viscosity in all of it.
fn viscous(paper: &PippingSlider) -> Outcome<Full<2>> {
    let space = paper.space()?;
    let damping = Viscous {
        shear_viscosity: 1e4,
        bulk_viscosity: 2e4,
    };
    Ok(slider(paper, &space)?.with_viscosity(viscosity(&space, &damping)?))
}

#[test]
fn with_all_modes_viscosity_is_that_of_the_whole_body() -> Outcome {
    let paper = body(1);
    let space = paper.space()?;
    let mut pair = Pair::new(&|| viscous(&paper), f64::INFINITY)?;
    for _ in 0..2000 {
        pair.step(5.0 * STEP)?;
    }
    assert!(pair.apart(Some(&gravity(&paper, &space)))? < 1e-9);
    Ok(())
}

/// Whatever is left out, nothing is lost on the way.
#[test]
fn energy_is_kept_account_of() -> Outcome {
    let paper = body(2);
    let space = paper.space()?;
    for scene in [slider(&paper, &space)?, viscous(&paper)?] {
        let viscous = !scene.viscosity().is_empty();
        let body = Reduced::new(&scene).up_to_frequency(100.0)?;
        let reduced = Simulation::new(body.reduce(scene)?, Newmark::default(), DenseNewton::new())?;
        let mut reduced = reduced.with_absolute_tolerance(1e-13)?;
        let mut ledger = EnergyLedger::new(&reduced.snapshot());
        let mut peak = 0.0_f64;
        reduced.run(&Steps::constant(STEP).count(7000), |at| {
            ledger.record(&at);
            peak = peak.max(at.max_slip_rate());
        })?;
        assert!(peak > 1e-3, "no event: {peak:e}");
        let balance = ledger.balance(&reduced.snapshot());
        assert!(
            balance.friction > 0.1 && (balance.viscosity > 1e-6) == viscous,
            "{balance:?}"
        );
        assert!(
            balance.left_over.abs() < 1e-10 * balance.moved,
            "{balance:?}"
        );
    }
    Ok(())
}

/// Elastic energy, kinetic energy and what friction takes are those of the whole body.
#[test]
fn with_all_modes_the_account_is_that_of_the_whole_body() -> Outcome {
    let paper = body(1);
    let space = paper.space()?;
    let mut full = Simulation::new(
        slider(&paper, &space)?,
        Newmark::default(),
        Condensed::new(),
    )?
    .with_absolute_tolerance(1e-13)?;
    let reduced = Reduced::new(&slider(&paper, &space)?).up_to_frequency(f64::INFINITY)?;
    let reduced = reduced.reduce(slider(&paper, &space)?)?;
    let mut reduced = Simulation::new(reduced, Newmark::default(), DenseNewton::new())?
        .with_absolute_tolerance(1e-13)?;
    let steps = Steps::constant(STEP).count(7000);
    let mut ledgers = [
        EnergyLedger::new(&full.snapshot()),
        EnergyLedger::new(&reduced.snapshot()),
    ];
    full.run(&steps, |at| ledgers[0].record(&at))?;
    reduced.run(&steps, |at| ledgers[1].record(&at))?;
    let full = ledgers[0].balance(&full.snapshot());
    let reduced = ledgers[1].balance(&reduced.snapshot());
    for (full, reduced) in [
        (full.stored, reduced.stored),
        (full.friction, reduced.friction),
        (full.moved, reduced.moved),
        (full.loads, reduced.loads),
    ] {
        assert!(
            (full - reduced).abs() < 1e-8 * balance_scale(&[full, reduced]),
            "{full:e}, {reduced:e}"
        );
    }
    Ok(())
}

fn balance_scale(values: &[f64]) -> f64 {
    values
        .iter()
        .fold(1e-3, |scale: f64, value| scale.max(value.abs()))
}

//! Steps that may have several solutions, by every solver and coupling.

use stickslip::problems::pipping_slider::{AGING, END, FRICTION, INITIAL_LOG_THETA};
use stickslip::state::LogTheta;
use stickslip::{Coupling, FixedPoint, Monolithic, Newmark, StepError, Steps};

use crate::Outcome;
use crate::common::{STEP, Sliding, Solver, body, distance, slide};

/// The paper's slider shortly before its first event, by a solver and a coupling.
fn before_the_event(solver: Solver, coupling: Box<dyn Coupling>) -> Outcome<Sliding> {
    let body = body(1);
    let space = body.space()?;
    let laws = (FRICTION, AGING, LogTheta(INITIAL_LOG_THETA));
    let slider = slide(&body, &space, laws, Newmark::default(), solver, 1e-11)?;
    let mut slider = slider.with_coupling(coupling);
    slider.run(&Steps::constant(STEP).until(9.9), |_| ())?;
    Ok(slider)
}

/// One by every solver and coupling, each of which solves all that has a solution.
fn all() -> Outcome<Vec<Sliding>> {
    let mut sliders = Vec::new();
    for solver in Solver::ALL {
        let patient = FixedPoint::accelerated().with_max_iterations(2000);
        sliders.push(before_the_event(solver, Box::new(Monolithic::default()))?);
        sliders.push(before_the_event(solver, Box::new(patient))?);
    }
    Ok(sliders)
}

/// Ten times the paper's step through an event.
const LARGE: f64 = END / 1000.0;

/// All of them refuse the same steps, and agree on the others.
#[test]
fn every_solver_and_coupling_takes_the_same_steps() -> Outcome {
    let mut sliders = all()?;
    let (mut refused, mut peak) = (0, 0_f64);
    for _ in 0..60 {
        let results: Vec<_> = sliders
            .iter_mut()
            .map(|slider| slider.step(LARGE).map_err(|failure| failure.cause))
            .collect();
        if results[0].is_err() {
            let same = |result: &Result<_, StepError>| matches!(result, Err(StepError::NotUnique { shorter: true, dt, .. }) if *dt == LARGE);
            assert!(results.iter().all(same), "{results:?}");
            refused += 1;
            for slider in &mut sliders {
                slider.run(&Steps::constant(LARGE / 10.0).count(10), |_| ())?;
            }
        } else {
            assert!(results.iter().all(Result::is_ok), "{results:?}");
        }
        let at: Vec<_> = sliders.iter().map(|slider| slider.snapshot()).collect();
        let largest = at[0].velocity.iter().map(|v| v.amax()).fold(0.0, f64::max);
        peak = peak.max(largest);
        for other in &at[1..] {
            let apart = distance(at[0].velocity, other.velocity);
            assert!(apart < 1e-6 * largest, "{}: {apart:e}", other.time);
        }
    }
    assert!(peak > 5e-3, "no event: {peak:e}");
    assert!(refused > 0);
    Ok(())
}

/// A run of such steps passes the event in substeps, the same ones for all, and ends with the error without them.
#[test]
fn substeps_pass_an_event() -> Outcome {
    let plan = Steps::constant(LARGE).count(60);
    let mut first = None;
    for mut slider in all()? {
        let from = slider.state().clone();
        let failure = slider
            .run(&plan.clone().without_substeps(), |_| ())
            .err()
            .ok_or("no step is refused")?;
        assert!(
            matches!(failure.cause, StepError::NotUnique { shorter: true, .. }),
            "{failure}"
        );
        slider.restore(&from)?;
        let mut times = Vec::new();
        let mut peak = 0_f64;
        let report = slider.run(&plan, |at| {
            times.push(at.time);
            peak = peak.max(at.max_slip_rate());
        })?;
        assert!(peak > 5e-3, "no event: {peak:e}");
        assert_eq!(report.accepted, 60);
        assert!(report.substepped > 0 && report.substeps >= 2 * report.substepped);
        // The last substep is the step's own end.
        assert_eq!(times.len(), 60 + report.substeps - report.substepped);
        assert!((slider.snapshot().time - from.clock.time() - 60.0 * LARGE).abs() < 1e-12);
        let taken = (report.substepped, times);
        let first = first.get_or_insert_with(|| taken.clone());
        assert_eq!(*first, taken);
    }
    Ok(())
}
